use super::{Out, robot, task};
use crate::{Partner, World};
use coact_messages::KeypointName;
use coact_pipeline::WorldMode;
use std::fmt::Write as _;

/// Motion capture of a right arm that reaches ahead and comes back, three seconds of it.
fn file() -> tempfile::NamedTempFile {
    let bodies = ["right_shoulder", "right_elbow", "right_hand"];
    let mut text = String::from("t_s");
    bodies.iter().for_each(|body| write!(text, ",{body}.x_mm,{body}.y_mm,{body}.z_mm").unwrap());
    for frame in 0..300 {
        let time = f64::from(frame) * 0.01;
        let reach = 200.0 * (1.0 - (2.0 * time).cos());
        write!(text, "\n{time:.2},200,0,500,300,{:.1},300,250,{:.1},250", 0.5 * reach, 200.0 + reach)
            .unwrap();
    }
    let file = tempfile::NamedTempFile::new().unwrap();
    std::fs::write(file.path(), text + "\n").unwrap();
    file
}

fn load(side: &str, file: &tempfile::NamedTempFile) -> Result<Partner, crate::WorldError> {
    Partner::load(&format!("{side}-arm:{}", file.path().display()), &task(), 7)
}

#[test]
fn the_arm_moves_as_it_was_recorded_and_the_tracker_shows_it_late_and_scattered() {
    let partner = load("right", &file()).unwrap();
    let settings = super::settings(7, partner, WorldMode::Kinematic);
    let (mut world, mut out) = (World::new(&task(), &robot(), settings).unwrap(), Out::new());
    let (mut path, mut off, mut frames) = (Vec::new(), Vec::new(), 0);
    for tick in 1..2_500 {
        world.step(tick, None, &mut out.sample, &mut out.truth, &mut out.state);
        let wrist = glam::DVec3::from(out.truth.arms[0][2]);
        path.push(wrist);
        let view = &out.sample.hands[0];
        let shown = view.keypoints[KeypointName::Wrist as usize];
        if view.frame > frames && shown.confidence > 0.0 {
            frames = view.frame;
            assert!(tick - view.captured_cycle >= 16, "a frame is one frame time old when it comes");
            off.push(path[view.captured_cycle as usize - 1].distance(shown.position.into()));
        }
    }
    let (first, farthest) = (path[0], path.iter().map(|place| place.distance(path[0])).fold(0.0, f64::max));
    assert!((farthest - 0.4).abs() < 1e-3, "{farthest} m from {first}");
    let mean = off.iter().sum::<f64>() / off.len() as f64;
    assert!(off.len() > 130 && (0.002..0.006).contains(&mean), "{} frames, off by {mean} m", off.len());
    assert_eq!(out.truth.held, [0, 0]);
}

#[test]
fn an_arm_that_was_not_recorded_is_refused_with_the_file() {
    let file = file();
    let message = load("left", &file).unwrap_err().to_string();
    assert!(message.contains("left_shoulder.x_mm") && message.contains(":1"), "{message}");
    let message = Partner::load("right-arm:/nowhere.csv", &task(), 1).unwrap_err().to_string();
    assert!(message.contains("/nowhere.csv"), "{message}");
}
