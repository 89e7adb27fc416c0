//! The ways in which a hand can take something: by the finger ends or enclosed, from above or from the side.

use crate::grip::grip_height;
use crate::{Graspable, HAND_JOINTS, Hand, HandGoal};
use nalgebra::{Isometry3, Point3, Vector3};
use std::f64::consts::TAU;

/// The grips of a hand that suit a object, and the hand that opens around it for any of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Grips {
    /// What is gripped.
    pub object: Graspable,
    /// Angles of the hand's joints before the grasp, open enough for any of the grips, in message order, rad.
    pub open: [f64; HAND_JOINTS],
    /// The grips; none where the hand does not open wide enough.
    pub all: Vec<Grip>,
    /// Distance of the hand's grasp point from the palm, m.
    grasp_distance: f64,
}

/// One way to take something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grip {
    /// What of the hand holds it.
    pub kind: GripKind,
    /// From where the hand comes.
    pub side: GripSide,
    /// Height above its underside at which the palm's axis meets it, m.
    pub height: f64,
    /// Distance from the palm frame's origin to there (from the side: to its middle), m.
    pub depth: f64,
    /// From which to which height above its underside the hand is beside it or on it, m.
    pub covers: [f64; 2],
}

/// What of the hand holds something.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GripKind {
    /// The ends of the fingers.
    Precision,
    /// The fingers around it, deep in the hand: it cannot get out towards their ends.
    WholeHand,
}

/// From where a hand comes to something that stands upright.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GripSide {
    /// From its top.
    Above,
    /// Across its axis.
    Beside,
}

/// What is done next with something that is gripped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NextUse {
    /// Nothing that asks for a grip of its own.
    Anything,
    /// Its underside goes into something, `depth` m deep.
    Insert {
        /// m.
        depth: f64,
    },
    /// A person takes it, and needs so much of its height, m, for the own fingers.
    HandOver {
        /// m.
        room: f64,
    },
}

/// Gap between an open finger and what it opens around, m.
const GAP: f64 = 0.01;
/// Room between the hand and what it shall not touch: the palm and the part, the hand and the ground, m.
const ROOM: f64 = 0.005;
/// Sides from which something round is gripped.
const SIDES: u32 = 12;
/// Steps in which the place in the hand is looked for, m, and in which fingers are closed, rad.
const DEEPER: f64 = 0.002;
const CLOSER: f64 = 0.005;
/// Points on each link of a finger.
const POINTS: u32 = 16;

impl Grips {
    /// All grips of a form that serve what follows; where none serves it, all.
    pub fn of(hand: &Hand, object: Graspable, next: NextUse) -> Self {
        let fits = object.width + 2.0 * GAP <= hand.width(hand.joints[1].limits.lower);
        let found =
            [Grip::from_above(hand, &object), Grip::pinching(hand, &object), Grip::enclosing(hand, &object)];
        let found: Vec<Grip> = found.into_iter().flatten().filter(|_| fits).collect();
        let all: Vec<Grip> = found.iter().filter(|grip| grip.suits(&found, &object, next)).copied().collect();
        let opened = all.iter().map(|grip| grip.open(hand, &object));
        let wider = |one: [f64; HAND_JOINTS], other: [f64; HAND_JOINTS]| {
            std::array::from_fn(|joint| one[joint].min(other[joint]))
        };
        let open = opened.reduce(wider).unwrap_or_else(|| hand.grasp(object.width, GAP).angles);
        Self { object, open, all, grasp_distance: hand.grasp_distance }
    }

    /// Whether one of these grips may be used where this follows: it serves that, or none of them does.
    pub fn suits(&self, grip: &Grip, next: NextUse) -> bool {
        grip.suits(&self.all, &self.object, next)
    }

    /// Goals of the hand for all grips, each with the index of its grip, for a form whose frame (centre of its underside,
    /// z up) is `frame`. `back` m before it the approach begins; shoulder, elbow and wrist stay above `floor` m.
    pub fn goals(&self, frame: &Isometry3<f64>, back: f64, floor: f64) -> Vec<(usize, HandGoal)> {
        let mut goals = Vec::new();
        for (index, grip) in self.all.iter().enumerate() {
            let of = |approach: Vector3<f64>, closing_axis: Vector3<f64>, rolls: u32| {
                let (approach, closing_axis) = (frame.rotation * approach, frame.rotation * closing_axis);
                let middle = frame * Point3::new(0.0, 0.0, grip.height);
                let point = middle + approach * (self.grasp_distance - grip.depth);
                (index, HandGoal { point, approach, closing_axis, rolls, along: approach, back, floor })
            };
            let about = |turn: f64| Vector3::new(turn.cos(), turn.sin(), 0.0);
            let turn = self.object.flat.map_or(0.0, |flat| flat.turn);
            match (grip.side, self.object.flat) {
                (GripSide::Above, flat) => {
                    goals.push(of(-Vector3::z(), about(turn), if flat.is_some() { 2 } else { 0 }));
                }
                (GripSide::Beside, flat) => {
                    let sides = if flat.is_some() { 2 } else { SIDES };
                    goals.extend((0..sides).map(|side| {
                        let closing_axis = about(turn + TAU * f64::from(side) / f64::from(sides));
                        of(closing_axis.cross(&Vector3::z()), closing_axis, 2)
                    }));
                }
            }
        }
        goals
    }
}

impl Grip {
    /// Angles of the hand's joints, rad, in message order, with `gap` m between the fingers and the form; below zero they
    /// are told to close so far into it, which makes them press.
    pub fn fingers(&self, hand: &Hand, object: &Graspable, gap: f64) -> [f64; HAND_JOINTS] {
        match (self.kind, self.side) {
            (GripKind::WholeHand, _) => {
                let (base, _) = closed(hand, object, self.depth, gap);
                hand.posture(base)
            }
            (GripKind::Precision, GripSide::Above) => hand.grasp(object.width, gap).angles,
            (GripKind::Precision, GripSide::Beside) => pinching(hand, object.width, gap),
        }
    }

    /// Angles of the hand's joints, rad, in message order, that is open enough to come to the form in this grip.
    pub fn open(&self, hand: &Hand, object: &Graspable) -> [f64; HAND_JOINTS] {
        match self.side {
            GripSide::Above => hand.grasp(object.width, GAP).angles,
            GripSide::Beside => pinching(hand, object.width, GAP),
        }
    }

    /// By the finger ends, from the top.
    fn from_above(hand: &Hand, object: &Graspable) -> Option<Self> {
        let depth = hand.grasp(object.width, 0.0).depth;
        let height = grip_height(object.height).max(object.height - (depth - hand.palm_face - ROOM));
        let covers = [height - hand.pad[1], object.height];
        (height < object.height).then_some(Self {
            kind: GripKind::Precision,
            side: GripSide::Above,
            height,
            depth,
            covers,
        })
    }

    /// By the finger ends, from the side.
    fn pinching(hand: &Hand, object: &Graspable) -> Option<Self> {
        let height = beside(hand, object, grip_height(object.height))?;
        let depth = hand.ends(&pinching(hand, object.width, 0.0))[2].z;
        let covers = [height - hand.reach_aside(), height + hand.reach_aside()];
        let room = depth - object.half_length() - hand.palm_face;
        (room > ROOM).then_some(Self {
            kind: GripKind::Precision,
            side: GripSide::Beside,
            height,
            depth,
            covers,
        })
    }

    /// With the whole hand, from the side: as deep in the hand as the fingers still close on it.
    fn enclosing(hand: &Hand, object: &Graspable) -> Option<Self> {
        let height = beside(hand, object, 0.5 * object.height)?;
        let open = pinching(hand, object.width, GAP)[3];
        let deepest = hand.palm_face + object.half_length() + ROOM;
        let steps = ((hand.grasp_distance - deepest) / DEEPER).max(0.0) as u32;
        let holds = |depth: &f64| {
            let (base, meet) = closed(hand, object, *depth, 0.0);
            let [.., end] = hand.finger(base);
            let is_behind = end[1] > *depth + object.half_length() && end[0] < 0.5 * object.width;
            let is_around = is_behind && nearest(hand, object, *depth, base).along > *depth;
            !meet && is_around && nearest(hand, object, *depth, open).gap > 0.5 * GAP
        };
        let depth = (0..=steps).map(|step| deepest + f64::from(step) * DEEPER).find(holds)?;
        let covers = [height - hand.half_breadth, height + hand.half_breadth];
        Some(Self { kind: GripKind::WholeHand, side: GripSide::Beside, height, depth, covers })
    }

    /// Whether it may be used among these: what follows can be done with it, or with none of them.
    fn suits(&self, all: &[Self], object: &Graspable, next: NextUse) -> bool {
        self.serves(object, next) || !all.iter().any(|grip| grip.serves(object, next))
    }

    /// Whether what follows can be done with it.
    fn serves(&self, object: &Graspable, next: NextUse) -> bool {
        let [from, to] = self.covers;
        match next {
            NextUse::Anything => true,
            NextUse::Insert { depth } => from >= depth,
            NextUse::HandOver { room } => from >= room || object.height - to >= room,
        }
    }
}

/// The height nearest to `wanted` at which a hand beside the form is clear of the ground and all fingers are on it.
fn beside(hand: &Hand, object: &Graspable, wanted: f64) -> Option<f64> {
    let (lowest, highest) = (hand.half_breadth + ROOM, object.height - hand.reach_aside());
    (lowest <= highest).then(|| wanted.clamp(lowest, highest))
}

/// The hand with the ends of all fingers `gap` m from something `width` m wide that lies across all of them.
fn pinching(hand: &Hand, width: f64, gap: f64) -> [f64; HAND_JOINTS] {
    let [.., middle, _, _, _] = hand.grasp(width, gap).angles;
    hand.posture(middle)
}

/// The base angle at which a finger is `gap` m from the object, whose middle is `depth` m in front of the palm's frame, rad;
/// and whether the fingers meet each other before.
fn closed(hand: &Hand, object: &Graspable, depth: f64, gap: f64) -> (f64, bool) {
    let limit = hand.joints[1].limits.upper;
    let mut base = pinching(hand, object.width, GAP.max(gap))[3];
    while base < limit && nearest(hand, object, depth, base).gap > gap {
        let [.., end] = hand.finger(base + CLOSER);
        if end[0] < hand.pad[1] && !hand.interlaces {
            return (base, true);
        }
        base += CLOSER;
    }
    (base, base >= limit)
}

/// Where a finger comes nearest to something, m.
#[derive(Clone, Copy)]
struct Nearest {
    /// Gap between them.
    gap: f64,
    /// Distance of that point from the palm's frame.
    along: f64,
}

/// Where a finger with this base angle, rad, comes nearest to the object.
fn nearest(hand: &Hand, object: &Graspable, depth: f64, base: f64) -> Nearest {
    let links = hand.finger(base);
    let points = links.windows(2).flat_map(|link| {
        (0..=POINTS).map(|point| {
            let share = f64::from(point) / f64::from(POINTS);
            let [across, along] =
                std::array::from_fn(|axis| link[0][axis] + share * (link[1][axis] - link[0][axis]));
            Nearest { gap: object.distance(across, along - depth) - hand.pad[1], along }
        })
    });
    let farthest = Nearest { gap: f64::INFINITY, along: 0.0 };
    points.fold(farthest, |best, point| if point.gap < best.gap { point } else { best })
}
