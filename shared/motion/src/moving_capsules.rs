use crate::collision_geometry::{self, FingerChain};
use crate::frames::Frames;
use crate::{Capsule, Mechanism};
use coact_robot::{HAND_JOINTS, Hand, Joint, Posture, RobotError};
use nalgebra::Isometry3;

/// Bounding capsules of all links that the joints of arm and hand move, for any angles of both.
///
/// The fingers are put in place once, and then the arm as often as needed: a hand keeps its shape while the arm brakes. Nothing
/// is allocated where there is room.
#[derive(Debug, Clone)]
pub struct MovingCapsules {
    /// Links that arm joints alone move: of each, how many, and its capsule in the frame of the last of them.
    arm: Vec<(usize, Capsule)>,
    fingers: Vec<FingerLink>,
    /// Of each link: whether it belongs to the hand. The hand's own come after those of the arm.
    of_hand: Vec<bool>,
}

/// A link of a finger.
#[derive(Debug, Clone)]
struct FingerLink {
    /// The joints between the palm and it.
    joints: Vec<FingerJoint>,
    /// Its capsule in the frame of the last of them.
    capsule: Capsule,
}

#[derive(Debug, Clone)]
struct FingerJoint {
    joint: Joint,
    /// The hand's joint (message order) that turns it, and its angle: so much for each rad of that, and so much more.
    source: Option<usize>,
    factor: f64,
    offset: f64,
}

impl MovingCapsules {
    /// Of the mechanism's arm and this hand.
    ///
    /// # Errors
    /// [`RobotError`] when the collision geometry of a link cannot be used.
    pub fn of(mechanism: &Mechanism, hand: &Hand) -> Result<Self, RobotError> {
        let links = collision_geometry::arm_links(mechanism)?;
        let moving = links.iter().filter(|link| link.carriers > 0);
        let mut of_hand: Vec<bool> = moving.clone().map(|link| link.hand).collect();
        let arm = moving.map(|link| (link.carriers, link.bounding_capsule)).collect();
        let mut fingers = Vec::new();
        for FingerChain { joints, links } in collision_geometry::finger_chains(mechanism)? {
            let joints: Vec<_> = joints.iter().map(|joint| FingerJoint::of(mechanism, hand, joint)).collect();
            fingers.extend(
                links
                    .iter()
                    .map(|link| FingerLink { joints: joints.clone(), capsule: link.bounding_capsule }),
            );
        }
        of_hand.resize(of_hand.len() + fingers.len() + 1, true);
        Ok(Self { arm, fingers, of_hand })
    }

    /// Most capsules: of all links and of what is held.
    pub fn most(&self) -> usize {
        self.of_hand.len()
    }

    /// Of each capsule that [`place`](Self::place) makes: whether it belongs to the hand, or to what that holds.
    pub fn of_hand(&self) -> &[bool] {
        &self.of_hand
    }

    /// Links of the fingers at these angles (message order, rad), in the frame of the arm's last joint, into `out`.
    pub fn close(&self, fingers: &[f64; HAND_JOINTS], out: &mut Vec<Capsule>) {
        out.clear();
        out.extend(self.fingers.iter().map(|link| {
            let chain = link.joints.iter();
            let place = chain.fold(Isometry3::identity(), |place, joint| place * joint.transform(fingers));
            link.capsule.within(&place)
        }));
    }

    /// All links in the world, for a posture of the arm, into `out`; `hand`: what [`close`](Self::close) has made, and perhaps one
    /// more capsule around what is held.
    pub fn place(&self, mechanism: &Mechanism, posture: &Posture, hand: &[Capsule], out: &mut Vec<Capsule>) {
        let frames = Frames::of(mechanism, posture);
        out.clear();
        out.extend(self.arm.iter().map(|(carriers, link)| link.within(&frames.pose[carriers - 1])));
        let last = &frames.pose[mechanism.joints() - 1];
        out.extend(hand.iter().map(|link| link.within(last)));
    }
}

impl FingerJoint {
    fn of(mechanism: &Mechanism, hand: &Hand, joint: &Joint) -> Self {
        let mimicked = mechanism.urdf.mimicked(&joint.name);
        let (name, factor, offset) = mimicked.unwrap_or_else(|| (joint.name.clone(), 1.0, 0.0));
        let source = hand.joints.iter().position(|own| own.name == name);
        Self { joint: joint.clone(), source, factor, offset }
    }

    /// From the frame of the joint before to its own.
    fn transform(&self, fingers: &[f64; HAND_JOINTS]) -> Isometry3<f64> {
        let angle = self.factor * self.source.map_or(0.0, |source| fingers[source]) + self.offset;
        self.joint.transform(angle.clamp(self.joint.limits.lower, self.joint.limits.upper))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use coact_robot::Robot;
    use std::path::Path;

    #[test]
    fn each_finger_is_where_the_collision_model_of_that_shape_has_it() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/robots/aros.toml");
        let robot = Robot::load(&file).unwrap();
        let mechanism = Mechanism::of(&robot).unwrap();
        let capsules = MovingCapsules::of(&mechanism, &robot.hand).unwrap();
        let (mut hand, mut placed, mut expected) = (Vec::new(), Vec::new(), Vec::new());
        for (shape, turn) in [([0.0; HAND_JOINTS], 0.0), ([0.3, 0.2, 1.1, 2.0, 0.4, 0.1, 0.6], 0.4)] {
            let posture = robot.park.map(|angle| angle + turn);
            capsules.close(&shape, &mut hand);
            capsules.place(&mechanism, &posture, &hand, &mut placed);
            let model = mechanism.with_fingers(&robot.hand, &shape).unwrap();
            model.moving_bounding_capsules(&mechanism, &posture, &mut expected);
            assert_eq!((placed.len(), capsules.most()), (expected.len(), expected.len() + 1));
            for (own, expected) in placed.iter().zip(&expected) {
                let off = (own.start - expected.start).norm().max((own.end - expected.end).norm());
                assert!(off < 1e-9 && own.radius == expected.radius, "{own:?}, {expected:?}");
            }
            assert!(capsules.of_hand()[placed.len() - hand.len()..].iter().all(|of_hand| *of_hand));
            assert!(!capsules.of_hand()[0]);
        }
    }
}
