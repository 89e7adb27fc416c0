use crate::PersonError;
use crate::arm_course::ArmCourse;
use crate::hand_model::{FOREARM, HandModel, UPPER_ARM, hand_points};
use crate::hand_pose::HandPose;
use coact_joint_task::{Agent, Scene};
use coact_messages::KeypointName;
use coact_period::seconds;
use coact_random::{RandomStreams, Stream};
use coact_recordings::{ArmRecording, ArmSide};
use glam::{DQuat, DVec3};
use rand::{Rng, RngExt};
use std::f64::consts::FRAC_PI_2;
use std::ops::Range;
use std::path::Path;

/// The arm of a real person, moving in the scene as it was recorded, whatever the robot does.
///
/// Shoulder, elbow and wrist are the recorded ones. The hand was not recorded: it goes on along the forearm, its fingers
/// half bent.
#[derive(Debug, Clone)]
pub struct RecordedArm {
    course: ArmCourse,
    side: ArmSide,
    turn: DQuat,
    shift: DVec3,
}

/// How the person is turned against the direction in which the scene's person faces, rad. Chosen by hand, as are the next
/// two: people stand obliquely, and reach high or low.
const TURNED: Range<f64> = -0.5..0.5;
/// Height of the wrist above the table where it is lowest, m.
const LOWEST: Range<f64> = 0.02..0.15;
/// Which places of the wrist may come to lie in the robot's workspace: those so near to the foremost one, m. So the arm reaches
/// there, and the person does not walk on through the robot.
const FOREMOST: f64 = 0.15;
/// How often the recording is looked at to place it, s.
const LOOK: f64 = 0.05;
/// How the fingers are bent: wrist to their tips, and thumb to index, m: as those of a hand at rest.
const HAND: HandPose =
    HandPose { wrist: [0.0; 3], heading: 0.0, pitch: 0.0, aperture: 0.03, extension: 0.14, aside: 0.0 };
/// Distance of an adult's shoulders, m. Chosen by hand.
const SHOULDERS: f64 = 0.36;
/// How much of a fixed sideways direction is in that of the thumb, so that a forearm that hangs down has one. Chosen by hand.
const HANGING: f64 = 0.3;

impl RecordedArm {
    /// Reads an arm from a file of motion capture, and places it by the seed so that it reaches into the robot's workspace.
    ///
    /// # Errors
    /// [`PersonError::Recording`] for what cannot be read or holds no arm.
    pub fn load(file: &Path, side: ArmSide, scene: &Scene, seed: u64) -> Result<Self, PersonError> {
        Ok(Self::new(&ArmRecording::read(file, side)?, side, scene, seed))
    }

    /// The arm of a recording, placed by the seed so that it reaches into the robot's workspace.
    pub fn new(recording: &ArmRecording, side: ArmSide, scene: &Scene, seed: u64) -> Self {
        let course = ArmCourse::of(recording);
        let mut rng = RandomStreams::new(seed).at(Stream::Placement, 0);
        // Recorded people look along y.
        let facing = HandModel::new(scene).facing() - FRAC_PI_2;
        let turn = DQuat::from_rotation_z(facing + rng.random_range(TURNED));
        let shift = shift(&course, turn, scene, &mut rng);
        Self { course, side, turn, shift }
    }

    /// How long it lasts until it begins again, s.
    pub fn duration(&self) -> f64 {
        self.course.duration()
    }

    /// All keypoints at `tick`, in the order of [`KeypointName`], m.
    pub fn keypoints(&self, tick: u64) -> [DVec3; 9] {
        let [shoulder, elbow, wrist] =
            self.course.at(seconds(tick)).map(|joint| self.turn * joint + self.shift);
        self.with_hand(self.side, [shoulder, elbow, wrist])
    }

    /// Those of the other arm, which was not read: it hangs down beside the body.
    pub(crate) fn other_arm(&self, tick: u64) -> [DVec3; 9] {
        let [shoulder, ..] = self.course.at(seconds(tick)).map(|joint| self.turn * joint + self.shift);
        let to_the_left = if self.side == ArmSide::Right { SHOULDERS } else { -SHOULDERS };
        let shoulder = shoulder + self.turn * DVec3::NEG_X * to_the_left;
        let elbow = shoulder + UPPER_ARM * DVec3::NEG_Z;
        self.with_hand(self.side.other(), [shoulder, elbow, elbow + FOREARM * DVec3::NEG_Z])
    }

    /// Which arm was recorded.
    pub(crate) fn side(&self) -> ArmSide {
        self.side
    }

    /// All keypoints of an arm whose hand goes on along the forearm.
    fn with_hand(&self, side: ArmSide, [shoulder, elbow, wrist]: [DVec3; 3]) -> [DVec3; 9] {
        let ahead = (wrist - elbow).normalize_or(DVec3::NEG_Z);
        let left = (DVec3::Z.cross(ahead) + HANGING * (self.turn * DVec3::NEG_X)).reject_from(ahead);
        let left = left.normalize_or(self.turn * DVec3::NEG_X);
        let thumb = match side {
            ArmSide::Left => -left,
            ArmSide::Right => left,
        };
        let mut points = hand_points(wrist, ahead, thumb, &HAND);
        points[KeypointName::Shoulder as usize] = shoulder;
        points[KeypointName::Elbow as usize] = elbow;
        points
    }
}

/// Brings one of the foremost places of the wrist somewhere into the robot's workspace, and its lowest one a little above the
/// table.
fn shift<R: Rng>(course: &ArmCourse, turn: DQuat, scene: &Scene, rng: &mut R) -> DVec3 {
    let looks = course.recorded().flat_map(|(begin, end)| {
        (0..=((end - begin) / LOOK) as usize).map(move |look| begin + LOOK * look as f64)
    });
    let wrists: Vec<DVec3> = looks.map(|time| course.at(time)[2]).collect();
    let foremost = wrists.iter().map(|wrist| wrist.y).fold(f64::NEG_INFINITY, f64::max);
    let lowest = wrists.iter().map(|wrist| wrist.z).fold(f64::INFINITY, f64::min);
    let places: Vec<DVec3> = wrists.into_iter().filter(|wrist| wrist.y >= foremost - FOREMOST).collect();
    let place = places.get(rng.random_range(0..places.len().max(1))).copied().unwrap_or_default();
    let [least, most] = scene.workspace[Agent::Robot.index()];
    let [x, y] = std::array::from_fn(|axis| rng.random_range(least[axis]..=most[axis]));
    let mut shift = DVec3::new(x, y, 0.0) - turn * place;
    shift.z = scene.table_height + rng.random_range(LOWEST) - lowest;
    shift
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use coact_joint_task::Task;
    use coact_recordings::ArmSample;

    /// An arm that reaches 0.4 m ahead and comes back.
    fn recording() -> ArmRecording {
        let at = |time: f64| {
            let reach = 0.2 * (1.0 - (time * 1.5).cos());
            [[0.2, 0.0, 0.5], [0.3, 0.1 + 0.5 * reach, 0.3], [0.25, 0.2 + reach, 0.25]]
        };
        let times = (0..500).map(|index| 0.01 * f64::from(index));
        let stretch = times.map(|time| ArmSample { time, joints: at(time) }).collect();
        ArmRecording { stretches: vec![stretch], duration: 4.99 }
    }

    fn scene() -> Scene {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
        Task::load(&file).unwrap().scene
    }

    fn wrists(arm: &RecordedArm) -> Vec<DVec3> {
        (0..4_990).map(|tick| arm.keypoints(tick)[KeypointName::Wrist as usize]).collect()
    }

    #[test]
    fn it_reaches_into_the_robots_workspace_above_the_table_elsewhere_for_each_seed() {
        let scene = scene();
        let [least, most] = scene.workspace[Agent::Robot.index()];
        let mut shoulders = Vec::new();
        for seed in 0..20 {
            let arm = RecordedArm::new(&recording(), ArmSide::Right, &scene, seed);
            let inside = |wrist: &DVec3| (0..2).all(|axis| (least[axis]..=most[axis]).contains(&wrist[axis]));
            let wrists = wrists(&arm);
            assert!(wrists.iter().any(inside), "seed {seed}");
            assert!(wrists.iter().all(|wrist| wrist.z > scene.table_height + 0.01), "seed {seed}");
            shoulders.push(arm.keypoints(0)[KeypointName::Shoulder as usize]);
        }
        let apart = |one: usize, other: usize| shoulders[one].distance(shoulders[other]) > 1e-3;
        assert!((1..20).all(|seed| apart(seed, seed - 1)));
    }

    #[test]
    fn the_arm_keeps_its_recorded_shape_and_the_hand_goes_on_along_the_forearm() {
        let arm = RecordedArm::new(&recording(), ArmSide::Left, &scene(), 3);
        let points = arm.keypoints(1_000);
        let at = |name: KeypointName| points[name as usize];
        let recorded = recording().stretches[0][100].joints.map(DVec3::from);
        let length = at(KeypointName::Elbow).distance(at(KeypointName::Wrist));
        assert!((length - recorded[1].distance(recorded[2])).abs() < 1e-6);
        let forearm = (at(KeypointName::Wrist) - at(KeypointName::Elbow)).normalize();
        let hand = (at(KeypointName::MiddleTip) - at(KeypointName::Wrist)).normalize();
        assert!(forearm.dot(hand) > 0.98);
    }

    #[test]
    fn it_moves_no_faster_from_tick_to_tick_than_it_was_recorded() {
        let wrists = wrists(&RecordedArm::new(&recording(), ArmSide::Right, &scene(), 1));
        let fastest = wrists.windows(2).map(|pair| pair[0].distance(pair[1])).fold(0.0, f64::max);
        assert!(fastest < 0.31e-3, "{fastest} m in a tick; 0.3 m/s was recorded");
    }
}
