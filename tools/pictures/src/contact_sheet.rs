use crate::limb_capsules::limb_capsules;
use crate::view::{ARM, HAND, Silhouette, THINGS, View, paint};
use coact_drawing::{Anchor, DISTINCT, Lettering, Mark, Place, RGBColor, Sheet};
use coact_joint_task::{Fixture, Kind, Task};
use coact_messages::ARM_JOINTS;
use coact_motion::{Capsule, CollisionModel, Mechanism};
use coact_robot::{HAND_JOINTS, Robot, RobotError};
use coact_run_records::{SeenPart, Snapshot};
use nalgebra::{Isometry3, Point3, Quaternion, UnitQuaternion, Vector3};

/// The snapshots of a run on one sheet: a picture of each, with what had happened.
pub struct ContactSheet<'a> {
    /// The snapshots, in order of time.
    pub snapshots: &'a [Snapshot],
    /// The task that was worked at.
    pub task: &'a Task,
    /// The robot that worked.
    pub robot: &'a Robot,
}

/// Why snapshots could not be drawn.
#[derive(Debug, thiserror::Error)]
pub enum ContactSheetError {
    /// There are none.
    #[error("there is no snapshot: the run was too short")]
    Empty,
    /// They are of another task.
    #[error(
        "the snapshots show a part \"{0}\", which the task \"{1}\" does not have; name the task of the run"
    )]
    Part(String, String),
    /// What is wrong with the robot's collision model.
    #[error(transparent)]
    Robot(#[from] RobotError),
}

/// Pictures on a sheet at most: with more, nobody finds the one that matters. Chosen by hand.
const MOST: usize = 24;
/// Pictures side by side.
const COLUMNS: usize = 4;
/// Size of a picture, pixels: four of them fill the width of a screen.
const PICTURE: [i32; 2] = [420, 330];
/// Height of the three lines under each picture, pixels.
const CAPTION: i32 = 74;
/// Height of the lines above all pictures, pixels.
const HEAD: i32 = 84;
/// Room between pictures, pixels.
const GAP: i32 = 16;
/// Direction towards the eye: beside the two, where parts change hands, and above. The person is on the left.
const TOWARDS: Vector3<f64> = Vector3::new(-0.12, -0.8, 0.55);
const TABLE: RGBColor = RGBColor(232, 224, 210);
const PERSON: RGBColor = RGBColor(225, 165, 130);
const FRAME: RGBColor = RGBColor(200, 200, 200);

/// A snapshot, and the robot in its posture then.
struct Picture<'a> {
    snapshot: &'a Snapshot,
    collision_model: CollisionModel,
    capsules: Vec<Capsule>,
}

impl ContactSheet<'_> {
    /// Draws the sheet: all snapshots, or 24 of them, evenly chosen.
    ///
    /// # Errors
    /// [`ContactSheetError`].
    pub fn draw(&self, letters: &Lettering) -> Result<Sheet, ContactSheetError> {
        let mechanism = Mechanism::of(self.robot)?;
        let chosen = evenly(self.snapshots).map(|snapshot| self.picture(snapshot, &mechanism));
        let pictures = chosen.collect::<Result<Vec<_>, _>>()?;
        if pictures.is_empty() {
            return Err(ContactSheetError::Empty);
        }
        let columns = COLUMNS.min(pictures.len()) as i32;
        let mut sheet = Sheet::new((GAP + columns.max(3) * (PICTURE[0] + GAP)) as u32);
        self.head(&mut sheet, pictures.len(), letters);
        let view = self.view(&pictures);
        for (index, picture) in pictures.iter().enumerate() {
            let (column, row) = ((index % COLUMNS) as i32, (index / COLUMNS) as i32);
            let corner = [GAP + column * (PICTURE[0] + GAP), HEAD + row * (PICTURE[1] + CAPTION)];
            let middle = [corner[0] + PICTURE[0] / 2, corner[1] + PICTURE[1] / 2];
            self.paint(&mut sheet, picture, &view.moved_to(middle))?;
            sheet.frame(corner, [corner[0] + PICTURE[0], corner[1] + PICTURE[1]], FRAME);
            caption(&mut sheet, picture.snapshot, [corner[0] + 4, corner[1] + PICTURE[1]], letters);
        }
        let rows = pictures.len().div_ceil(COLUMNS) as i32;
        sheet.height = (HEAD + rows * (PICTURE[1] + CAPTION)) as u32;
        Ok(sheet)
    }

    fn picture<'a>(&self, snapshot: &'a Snapshot, mechanism: &Mechanism) -> Result<Picture<'a>, RobotError> {
        let (arm, hand) = snapshot.joints.split_at(ARM_JOINTS);
        let fingers: [f64; HAND_JOINTS] = std::array::from_fn(|joint| hand[joint]);
        let collision_model = mechanism.with_fingers(&self.robot.hand, &fingers)?;
        let capsules = collision_model.bounding_capsules(mechanism, &std::array::from_fn(|joint| arm[joint]));
        Ok(Picture { snapshot, collision_model, capsules })
    }

    /// What is shown, and the colour of each kind of part.
    fn head(&self, sheet: &mut Sheet, shown: usize, letters: &Lettering) {
        let all = self.snapshots.len();
        let title = format!("{}: {shown} of {all} snapshots of the run", self.task.name);
        sheet.text(title, [GAP, 26], 22, Anchor::Start);
        let mut x = GAP;
        for (index, kind) in self.task.kinds.iter().enumerate() {
            sheet.marks.push(Mark::Disc([x + 8, 58], 8, colour(index)));
            sheet.text(kind.name.as_str(), [x + 22, 58], 16, Anchor::Start);
            x += 46 + letters.width(&kind.name, 16);
        }
    }

    /// One view for all pictures: of the table, and of all that robot and person reach.
    fn view(&self, pictures: &[Picture]) -> View {
        let point = |at: [f64; 3]| Capsule { start: at.into(), end: at.into(), radius: 0.0 };
        let scene = &self.task.scene;
        let corners = [(-0.5, -0.5), (-0.5, 0.5), (0.5, -0.5), (0.5, 0.5)].map(|(across, along)| {
            let ([depth, width], [x, y]) = (scene.table_size, scene.table_centre);
            point([x + across * depth, y + along * width, scene.table_height])
        });
        let people =
            pictures.iter().flat_map(|picture| picture.snapshot.keypoints.iter().flat_map(limb_capsules));
        let capsules = pictures.iter().flat_map(|picture| picture.capsules.iter().copied());
        let all: Vec<Capsule> = corners.into_iter().chain(capsules).chain(people).collect();
        View::of(&all, TOWARDS, PICTURE)
    }

    fn paint(&self, sheet: &mut Sheet, picture: &Picture, view: &View) -> Result<(), ContactSheetError> {
        // What stands still is below all that moves; foot and axles are below the base.
        let (tables, others): (Vec<_>, Vec<_>) = coact_workplace::fixtures(self.task)
            .into_iter()
            .partition(|fixture| fixture.name == Fixture::TABLE);
        tables.iter().for_each(|table| paint(sheet, view.solid(table, TABLE)));
        others.iter().rev().for_each(|other| paint(sheet, view.solid(other, THINGS)));
        let links = picture.collision_model.links().iter().zip(&picture.capsules);
        let mut silhouettes: Vec<Silhouette> =
            links.map(|(link, capsule)| view.capsule(capsule, if link.hand { HAND } else { ARM })).collect();
        silhouettes.extend(
            picture.snapshot.keypoints.iter().flat_map(limb_capsules).map(|limb| view.capsule(&limb, PERSON)),
        );
        for part in &picture.snapshot.parts {
            let (index, kind) = self.kind(part)?;
            let thing = coact_workplace::upright(&kind.name, kind.shape, &frame(part));
            silhouettes.extend(view.solid(&thing, colour(index)));
        }
        paint(sheet, silhouettes);
        Ok(())
    }

    fn kind(&self, part: &SeenPart) -> Result<(usize, &Kind), ContactSheetError> {
        let mut kinds = self.task.kinds.iter().enumerate();
        kinds
            .find(|(_, kind)| kind.name == part.kind)
            .ok_or_else(|| ContactSheetError::Part(part.kind.clone(), self.task.name.clone()))
    }
}

/// All of them, or as many as fit on a sheet: the first, the last, and as evenly as may be between.
fn evenly(snapshots: &[Snapshot]) -> impl Iterator<Item = &Snapshot> {
    let (all, shown) = (snapshots.len(), snapshots.len().min(MOST));
    let steps = shown.saturating_sub(1).max(1);
    (0..shown).map(move |index| &snapshots[(index * (all - 1) + steps / 2) / steps])
}

/// When, what had happened, and what the two were doing.
fn caption(sheet: &mut Sheet, snapshot: &Snapshot, [x, y]: Place, letters: &Lettering) {
    let at_s = snapshot.at_ms as f64 / 1e3;
    let nothing = || "\u{2013}".to_owned();
    let lines = [
        (format!("{at_s:.1} s   {}", snapshot.what), 17, 15),
        (format!("robot   {}", snapshot.robot_does.clone().unwrap_or_else(nothing)), 14, 35),
        (format!("person  {}", snapshot.person_does.clone().unwrap_or_else(nothing)), 14, 53),
    ];
    for (line, size, below) in lines {
        sheet.text(fitting(line, size, letters), [x, y + below], size, Anchor::Start);
    }
}

/// A line that fits below a picture; the end of one that is too long is replaced by an ellipsis.
fn fitting(line: String, size: u32, letters: &Lettering) -> String {
    let fits = |line: &str| letters.width(line, size) <= PICTURE[0] - 8;
    if fits(&line) {
        return line;
    }
    let shortened = line.char_indices().rev().map(|(end, _)| format!("{}\u{2026}", line[..end].trim_end()));
    shortened.into_iter().find(|line| fits(line)).unwrap_or_default()
}

fn frame(part: &SeenPart) -> Isometry3<f64> {
    let [x, y, z, w] = part.orientation;
    let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    Isometry3::from_parts(Point3::from(part.position).into(), turn)
}

fn colour(kind: usize) -> RGBColor {
    DISTINCT[kind % DISTINCT.len()]
}
