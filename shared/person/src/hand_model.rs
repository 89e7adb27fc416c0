use crate::HandPose;
use crate::fingers::Fingers;
use crate::movement_planning::GRASPING;
use coact_joint_task::Scene;
use coact_messages::{ArmSide, KeypointName};
use glam::DVec3;

/// Upper arm and forearm of an adult, m (Winter 2009, for 1.70 m of stature).
pub(crate) const UPPER_ARM: f64 = 0.31;
/// Elbow to wrist of the same adult, m; recordings are scaled to this length.
pub const FOREARM: f64 = 0.26;
/// How far the index finger is beside the line from the wrist to the middle finger, and how long it is, m; and how far the tips of folded
/// fingers are from the wrist: of the same adult's hand.
const INDEX_ASIDE: f64 = 0.025;
const INDEX_LENGTH: f64 = 0.095;
const FOLDED: f64 = 0.07;
/// How much of the arm's length people reach with before they lean. Chosen by hand: elbows do not lock.
const LEANS: f64 = 0.9;
/// Pitch of the hand that lies on the table, rad: 20 degrees down. Chosen by hand.
const REST_PITCH: f64 = -0.35;

/// One of the person's arms and its hand: from a pose to the nine keypoints that a tracker finds.
///
/// Thumb and fingers oppose each other horizontally, whatever the hand's pitch.
#[derive(Debug, Clone)]
pub struct HandModel {
    shoulder: DVec3,
    rest: DVec3,
    /// 1 for the right arm, -1 for the left one, which is its mirror image.
    hand: f64,
    /// Direction on the table plane in which the person faces: from the shoulder to where parts change hands, rad.
    facing: f64,
}

impl HandModel {
    /// The right arm of the person who sits at this scene.
    pub fn new(scene: &Scene) -> Self {
        Self::of(scene, ArmSide::Right)
    }

    /// One of the arms of the person who sits at this scene.
    pub fn of(scene: &Scene, side: ArmSide) -> Self {
        let ahead = DVec3::from(scene.handover) - DVec3::from(scene.person_rest);
        let (shoulder, rest) = (scene.shoulder(side).into(), scene.rest(side).into());
        let hand = if side == ArmSide::Right { 1.0 } else { -1.0 };
        Self { shoulder, rest, hand, facing: ahead.y.atan2(ahead.x) }
    }

    /// The hand at rest: flat, the fingers half bent, thumb near index.
    pub fn rest(&self) -> HandPose {
        let wrist = self.rest.into();
        HandPose { wrist, pitch: REST_PITCH, aperture: 0.03, extension: 0.14, ..HandPose::default() }
    }

    /// The keypoints of an arm whose finger tips have `centre` (m) in their middle and are `aperture` (m) apart, while the hand points
    /// `pitch` (rad) above the table plane. For those who show a hand ([`HandPoints`](coact_messages::HandPoints)) and have no arm.
    ///
    /// Wherever it is: who reaches for a place that is farther away than the arm is long leans after it.
    pub fn reaching(&self, centre: DVec3, pitch: f64, aperture: f64) -> [DVec3; 9] {
        self.keypoints(&self.grasping(centre, pitch, aperture, (GRASPING, 0.0)))
    }

    /// The keypoints of an arm whose index finger points at a place (m), with the wrist there (m); the other fingers are folded.
    pub fn pointing(&self, wrist: DVec3, at: DVec3) -> [DVec3; 9] {
        let line = at - wrist;
        let thumb = self.hand * DVec3::new(-line.y, line.x, 0.0).normalize_or(DVec3::Y);
        let ahead = (line - INDEX_ASIDE * thumb).normalize_or(DVec3::X);
        let folded = HandPose { aperture: 0.03, extension: FOLDED, ..HandPose::default() };
        let mut points = hand_points(wrist, ahead, thumb, &folded);
        points[KeypointName::IndexTip as usize] =
            points[KeypointName::IndexKnuckle as usize] + INDEX_LENGTH * ahead;
        self.with_arm(points, thumb)
    }

    /// The pose that comes nearest to these keypoints.
    pub(crate) fn pose_of(&self, points: &[DVec3; 9]) -> HandPose {
        let at = |name: KeypointName| points[name as usize];
        let (wrist, Fingers { middle, aperture, pitch, .. }) = (at(KeypointName::Wrist), Fingers::of(points));
        let ahead = at(KeypointName::IndexKnuckle).midpoint(at(KeypointName::LittleKnuckle)) - wrist;
        let turn = ahead.y.atan2(ahead.x) - self.facing;
        let heading = turn.sin().atan2(turn.cos());
        let flat = HandPose { wrist: wrist.into(), heading, pitch, aperture, ..HandPose::default() };
        let (extension, aside) =
            ((middle - wrist).dot(self.direction(&flat)), (middle - wrist).dot(self.thumb_side(&flat)));
        HandPose { extension, aside, ..flat }
    }

    /// Heading of a hand that reaches to `point`, rad: along the line from the shoulder.
    pub(crate) fn heading_to(&self, point: DVec3) -> f64 {
        let line = point - self.shoulder;
        let turn = line.y.atan2(line.x) - self.facing;
        turn.sin().atan2(turn.cos()).clamp(-1.0, 1.0)
    }

    /// The pose that has `point` in the middle between the finger tips, which is (`extension`, `aside`) from the wrist.
    pub(crate) fn grasping(
        &self,
        point: DVec3,
        pitch: f64,
        aperture: f64,
        (extension, aside): (f64, f64),
    ) -> HandPose {
        let heading = self.heading_to(point);
        let mut pose = HandPose { wrist: [0.0; 3], heading, pitch, aperture, extension, aside };
        pose.wrist = (point - extension * self.direction(&pose) - aside * self.thumb_side(&pose)).into();
        pose
    }

    /// Unit vector from wrist to knuckles.
    pub(crate) fn direction(&self, pose: &HandPose) -> DVec3 {
        let yaw = self.facing + pose.heading;
        DVec3::new(yaw.cos() * pose.pitch.cos(), yaw.sin() * pose.pitch.cos(), pose.pitch.sin())
    }

    /// Horizontal unit vector towards the thumb's side: the left of a right hand.
    pub(crate) fn thumb_side(&self, pose: &HandPose) -> DVec3 {
        let yaw = self.facing + pose.heading;
        self.hand * DVec3::new(-yaw.sin(), yaw.cos(), 0.0)
    }

    /// 1 for the right hand, -1 for the left one: what a recorded hand did aside is mirrored so.
    pub(crate) fn mirror(&self) -> f64 {
        self.hand
    }

    /// Distance of a place from where the hand rests, m.
    pub(crate) fn away_from_rest(&self, place: DVec3) -> f64 {
        place.distance(self.rest)
    }

    /// Unit vector from a place to the shoulder: the direction in which the person draws something nearer.
    pub(crate) fn towards_shoulder(&self, place: DVec3) -> DVec3 {
        (self.shoulder - place).normalize_or_zero()
    }

    /// The middle between the finger tips, m: what the hand grasps lies there.
    pub fn centre(&self, pose: &HandPose) -> DVec3 {
        pose.wrist() + pose.extension * self.direction(pose) + pose.aside * self.thumb_side(pose)
    }

    /// All keypoints in the order of [`KeypointName`], m.
    pub fn keypoints(&self, pose: &HandPose) -> [DVec3; 9] {
        let (thumb, wrist) = (self.thumb_side(pose), pose.wrist());
        self.with_arm(hand_points(wrist, self.direction(pose), thumb, pose), thumb)
    }

    /// Unit vector on the table plane in which the person faces.
    pub(crate) fn ahead(&self) -> DVec3 {
        DVec3::new(self.facing.cos(), self.facing.sin(), 0.0)
    }

    /// Direction on the table plane in which the person faces, rad.
    pub(crate) fn facing(&self) -> f64 {
        self.facing
    }

    /// The same keypoints, with the arm that the wrist is at the end of.
    fn with_arm(&self, mut points: [DVec3; 9], thumb_side: DVec3) -> [DVec3; 9] {
        let wrist = points[KeypointName::Wrist as usize];
        let shoulder = self.leaning(wrist);
        points[KeypointName::Shoulder as usize] = shoulder;
        points[KeypointName::Elbow as usize] = elbow(shoulder, wrist, thumb_side);
        points
    }

    /// The shoulder of an arm that ends at `wrist`: who reaches far leans after the hand, the more the farther, and never has the arm quite
    /// straight.
    fn leaning(&self, wrist: DVec3) -> DVec3 {
        let line = self.shoulder - wrist;
        let (bent, rest) = (LEANS * (UPPER_ARM + FOREARM), (1.0 - LEANS) * (UPPER_ARM + FOREARM));
        let beyond = line.length() - bent;
        if beyond <= 0.0 {
            return self.shoulder;
        }
        wrist + (bent + rest * (1.0 - (-beyond / rest).exp())) * line.normalize()
    }
}

/// The elbow of an arm of two links, bent downwards and outwards.
fn elbow(shoulder: DVec3, wrist: DVec3, thumb_side: DVec3) -> DVec3 {
    let line = wrist - shoulder;
    let distance = line.length().max(1e-6);
    let along = line / distance;
    let foot = (UPPER_ARM * UPPER_ARM - FOREARM * FOREARM + distance * distance) / (2.0 * distance);
    let bend = (UPPER_ARM * UPPER_ARM - foot * foot).max(0.0).sqrt();
    let pull = DVec3::NEG_Z - 0.4 * thumb_side;
    shoulder + foot * along + bend * pull.reject_from_normalized(along).normalize_or_zero()
}

/// The keypoints of a hand whose knuckles are `ahead` of the wrist and whose thumb is on the side `thumb`; shoulder and elbow are
/// left to the caller.
pub(crate) fn hand_points(wrist: DVec3, ahead: DVec3, thumb: DVec3, pose: &HandPose) -> [DVec3; 9] {
    let on_hand = |along: f64, aside: f64| wrist + along * ahead + aside * thumb;
    let (thumb_tip, index_tip) = (pose.aside + pose.aperture / 2.0, pose.aside - pose.aperture / 2.0);
    let mut points = [DVec3::ZERO; 9];
    points[KeypointName::Wrist as usize] = wrist;
    points[KeypointName::PalmBase as usize] = on_hand(0.020, 0.020);
    points[KeypointName::ThumbTip as usize] = on_hand(pose.extension, thumb_tip);
    points[KeypointName::IndexKnuckle as usize] = on_hand(0.092, INDEX_ASIDE);
    points[KeypointName::IndexTip as usize] = on_hand(pose.extension, index_tip);
    points[KeypointName::MiddleTip as usize] =
        on_hand(pose.extension + 0.012, index_tip - 0.08 * pose.aperture);
    points[KeypointName::LittleKnuckle as usize] = on_hand(0.080, -0.040);
    points
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use coact_joint_task::Task;
    use std::path::Path;

    #[test]
    fn arms_keep_their_lengths_wherever_the_hand_goes() {
        let task = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
        let scene = Task::load(&task).unwrap().scene;
        for arm in ArmSide::BOTH.map(|side| HandModel::of(&scene, side)) {
            for centre in [scene.handover, scene.person_rest, [-0.2, -0.4, 0.9], [-1.2, 0.3, 0.85]] {
                let points = arm.reaching(centre.into(), -0.3, 0.05);
                let at = |name: KeypointName| points[name as usize];
                let [shoulder, elbow, wrist] =
                    [KeypointName::Shoulder, KeypointName::Elbow, KeypointName::Wrist].map(at);
                assert!(
                    (shoulder.distance(elbow) - UPPER_ARM).abs() < 1e-6,
                    "{centre:?}: {shoulder} {elbow}"
                );
                assert!((elbow.distance(wrist) - FOREARM).abs() < 1e-6, "{centre:?}: {elbow} {wrist}");
            }
        }
    }
}
