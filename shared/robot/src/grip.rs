use crate::finger_closure::{OPEN_GAP, closed, nearest, pinching};
use crate::{Graspable, GripKind, GripSide, HAND_JOINTS, Hand, NextUse, grip_height};

/// One way in which the hand can grasp something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grip {
    /// What of the hand holds it.
    pub kind: GripKind,
    /// From where the hand comes.
    pub side: GripSide,
    /// Height above the object's underside at which the palm's axis meets it, m.
    pub height: f64,
    /// Distance from the palm frame's origin to there (from the side: to the object's middle), m.
    pub depth: f64,
    /// From which to which height above the object's underside the hand is beside it or on it, m.
    pub covers: [f64; 2],
}

/// Distance between the hand and what it must not touch, m: the palm and the part, the hand and the ground. Chosen by hand.
const FREE: f64 = 0.005;
/// Step in which the depth of a grip with the whole hand is looked for, m. Chosen by hand.
const DEPTH_STEP: f64 = 0.002;

impl Grip {
    /// Angles of the hand's joints, rad, in message order, with `gap` m between the fingers and the object. With a negative
    /// gap they are commanded to close so far into it, which makes them press.
    pub fn fingers(&self, hand: &Hand, object: &Graspable, gap: f64) -> [f64; HAND_JOINTS] {
        match (self.kind, self.side) {
            (GripKind::WholeHand, _) => hand.posture(closed(hand, object, self.depth, gap).base),
            (GripKind::Precision, GripSide::Above) => hand.grasp(object.width, gap).angles,
            (GripKind::Precision, GripSide::Beside) => pinching(hand, object.width, gap),
        }
    }

    /// Angles of the hand's joints, rad, in message order, of a hand that is open enough to come to the object.
    pub fn open(&self, hand: &Hand, object: &Graspable) -> [f64; HAND_JOINTS] {
        match self.side {
            GripSide::Above => hand.grasp(object.width, OPEN_GAP).angles,
            GripSide::Beside => pinching(hand, object.width, OPEN_GAP),
        }
    }

    /// By the finger ends, from the top.
    pub(crate) fn from_above(hand: &Hand, object: &Graspable) -> Option<Self> {
        let depth = hand.grasp(object.width, 0.0).depth;
        let height = grip_height(object.height).max(object.height - (depth - hand.palm_face - FREE));
        let covers = [height - hand.pad[1], object.height];
        let (kind, side) = (GripKind::Precision, GripSide::Above);
        (height < object.height).then_some(Self { kind, side, height, depth, covers })
    }

    /// By the finger ends, from the side.
    pub(crate) fn from_beside(hand: &Hand, object: &Graspable) -> Option<Self> {
        let height = beside(hand, object, grip_height(object.height))?;
        let depth = hand.ends(&pinching(hand, object.width, 0.0))[2].z;
        let covers = [height - hand.reach_aside(), height + hand.reach_aside()];
        let room = depth - object.half_length() - hand.palm_face;
        let (kind, side) = (GripKind::Precision, GripSide::Beside);
        (room > FREE).then_some(Self { kind, side, height, depth, covers })
    }

    /// With the whole hand, from the side: as deep in the hand as the fingers still close on it.
    pub(crate) fn enclosing(hand: &Hand, object: &Graspable) -> Option<Self> {
        let height = beside(hand, object, 0.5 * object.height)?;
        let open = pinching(hand, object.width, OPEN_GAP)[3];
        let deepest = hand.palm_face + object.half_length() + FREE;
        let steps = ((hand.grasp_distance - deepest) / DEPTH_STEP).max(0.0) as u32;
        let holds = |depth: &f64| {
            let closure = closed(hand, object, *depth, 0.0);
            let [.., end] = hand.finger(closure.base);
            let is_behind = end[1] > *depth + object.half_length() && end[0] < 0.5 * object.width;
            let is_around = is_behind && nearest(hand, object, *depth, closure.base).along > *depth;
            !closure.meets && is_around && nearest(hand, object, *depth, open).gap > 0.5 * OPEN_GAP
        };
        let depth = (0..=steps).map(|step| deepest + f64::from(step) * DEPTH_STEP).find(holds)?;
        let covers = [height - hand.half_breadth, height + hand.half_breadth];
        Some(Self { kind: GripKind::WholeHand, side: GripSide::Beside, height, depth, covers })
    }

    /// Whether it may be used among these: the next use can be made with it, or with none of them.
    pub(crate) fn suits(&self, all: &[Self], object: &Graspable, next: NextUse) -> bool {
        self.serves(object, next) || !all.iter().any(|grip| grip.serves(object, next))
    }

    /// Whether the next use can be made with it.
    fn serves(&self, object: &Graspable, next: NextUse) -> bool {
        let [from, to] = self.covers;
        match next {
            NextUse::Anything => true,
            NextUse::Insert { depth } => from >= depth,
            NextUse::HandOver { room } => from >= room || object.height - to >= room,
        }
    }
}

/// The height nearest to `wanted` at which a hand beside the object is clear of the ground and all fingers are on it.
fn beside(hand: &Hand, object: &Graspable, wanted: f64) -> Option<f64> {
    let (lowest, highest) = (hand.half_breadth + FREE, object.height - hand.reach_aside());
    (lowest <= highest).then(|| wanted.clamp(lowest, highest))
}
