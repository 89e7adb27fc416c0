//! Sheets of snapshots that are made up here.
#![allow(clippy::unwrap_used)]

use coact_drawing::{Lettering, Mark, RGBColor, Sheet};
use coact_joint_task::Task;
use coact_pictures::{ContactSheet, ContactSheetError};
use coact_robot::Robot;
use coact_run_records::{JOINTS, SeenPart, Snapshot};
use std::path::{Path, PathBuf};

fn configuration(file: &str) -> PathBuf {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config")).join(file)
}

fn snapshot(at_ms: u64, what: &str) -> Snapshot {
    let wheel =
        SeenPart { kind: "wheel".into(), position: [-0.98, 0.02, 0.8], orientation: [0.0, 0.0, 0.0, 1.0] };
    Snapshot {
        at_ms,
        what: what.into(),
        robot_does: Some("steady the base".into()),
        person_does: None,
        robot_holds: Vec::new(),
        person_holds: vec!["wheel".into()],
        in_place: Vec::new(),
        joints: [0.0; JOINTS],
        parts: vec![wheel],
        keypoints: [0.1, 0.4].map(|y| {
            std::array::from_fn(|point| (point != 3).then_some([-1.2 + 0.03 * point as f64, y, 0.9]))
        }),
    }
}

fn draw(snapshots: &[Snapshot]) -> Result<Sheet, ContactSheetError> {
    let task = Task::load(&configuration("tasks/toy-vehicle.toml")).unwrap();
    let robot = Robot::load(&configuration("robots/aros.toml")).unwrap();
    ContactSheet { snapshots, task: &task, robot: &robot }.draw(&Lettering::new().unwrap())
}

fn texts(sheet: &Sheet) -> Vec<&str> {
    let texts = sheet.marks.iter().filter_map(|mark| match mark {
        Mark::Text(text) => Some(text.text.as_str()),
        _ => None,
    });
    texts.collect()
}

fn areas(sheet: &Sheet) -> impl Iterator<Item = (&[[i32; 2]], RGBColor)> {
    sheet.marks.iter().filter_map(|mark| match mark {
        Mark::Area(places, colour) => Some((places.as_slice(), *colour)),
        _ => None,
    })
}

#[test]
fn captions_say_when_what_happened_and_what_robot_and_person_were_doing() {
    let sheet = draw(&[snapshot(204, "the beginning"), snapshot(2089, "person takes wheel")]).unwrap();
    let found = texts(&sheet);
    assert!(found.contains(&"toy vehicle: 2 of 2 snapshots of the run"), "{found:?}");
    for kind in ["wheel", "nut", "top floor"] {
        assert!(found.contains(&kind), "{kind} is not in {found:?}");
    }
    let below = found.iter().skip_while(|text| !text.starts_with("2.1 s")).copied().collect::<Vec<_>>();
    assert_eq!(below, ["2.1 s   person takes wheel", "robot   steady the base", "person  \u{2013}"]);
}

#[test]
fn parts_are_filled_and_move_with_what_the_snapshots_say() {
    let (mut here, mut there) = (snapshot(0, "here"), snapshot(1, "there"));
    there.parts[0].position[0] += 0.5;
    let blue = |RGBColor(red, green, blue): RGBColor| red == 0 && blue > green && blue > 100;
    let places = |snapshots: &[Snapshot]| -> Vec<Vec<[i32; 2]>> {
        let sheet = draw(snapshots).unwrap();
        areas(&sheet).filter(|(_, colour)| blue(*colour)).map(|(places, _)| places.to_vec()).collect()
    };
    let drawn = places(&[here.clone(), there]);
    assert_eq!(drawn.len(), 4, "a lid and a side in each picture");
    // Half a metre to the right, and in the next picture.
    assert!(drawn[2][0][0] - drawn[0][0][0] > 436 + 50, "{drawn:?}");
    here.parts.clear();
    assert_eq!(places(&[here]).len(), 0);
}

#[test]
fn the_picture_shows_something_in_every_frame() {
    let sheet = draw(&[snapshot(0, "one"), snapshot(1, "two"), snapshot(2, "three")]).unwrap();
    let file = sheet.png(&Lettering::new().unwrap()).unwrap();
    let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!((info.width, info.height), (sheet.width, sheet.height));
    for column in 0..3 {
        let left = (column * info.width / 3) as usize;
        let inside = |row: usize| &pixels[3 * (row * info.width as usize + left)..][..info.width as usize];
        let inked = (100..400).filter(|row| inside(*row).iter().any(|value| *value < 255)).count();
        assert!(inked > 250, "column {column}: {inked} rows");
        let shades: std::collections::BTreeSet<_> = (100..400).flat_map(inside).collect();
        assert!(shades.len() > 20, "column {column}: {} shades", shades.len());
    }
}

#[test]
fn of_a_long_log_two_dozen_snapshots_are_shown_from_the_first_to_the_last() {
    let snapshots: Vec<_> = (0..70).map(|index| snapshot(1000 * index, "something")).collect();
    let sheet = draw(&snapshots).unwrap();
    let shown: Vec<_> = texts(&sheet).into_iter().filter(|text| text.ends_with("something")).collect();
    assert_eq!(shown.len(), 24);
    assert_eq!(
        (shown[0], shown[1], shown[23]),
        ("0.0 s   something", "3.0 s   something", "69.0 s   something")
    );
}

#[test]
fn a_caption_that_is_too_long_is_cut() {
    let sheet = draw(&[snapshot(0, &"robot takes wheel; ".repeat(9))]).unwrap();
    let letters = Lettering::new().unwrap();
    let cut = texts(&sheet).into_iter().find(|text| text.starts_with("0.0 s")).unwrap();
    assert!(cut.ends_with('\u{2026}') && (300..=420).contains(&letters.width(cut, 17)), "{cut}");
}

#[test]
fn a_log_of_nothing_or_of_another_task_is_refused() {
    assert!(matches!(draw(&[]), Err(ContactSheetError::Empty)));
    let mut foreign = snapshot(0, "one");
    foreign.parts[0].kind = "saucer".into();
    let error = draw(&[foreign]).unwrap_err().to_string();
    assert!(error.contains("\"saucer\"") && error.contains("toy vehicle"), "{error}");
}
