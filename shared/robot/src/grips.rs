use crate::finger_closure::OPEN_GAP;
use crate::{Graspable, Grip, GripSide, HAND_JOINTS, Hand, HandGoal, NextUse};
use nalgebra::{Isometry3, Point3, Vector3};
use std::f64::consts::TAU;

/// The grips of a hand that suit an object, by the finger ends or with the whole hand, from above or from the side, and
/// the hand that is open enough for any of them.
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

/// Sides from which something round is gripped: every 30 degrees. A trade-off with the time of planning.
const SIDES: u32 = 12;

impl Grips {
    /// All grips of an object that serve its next use; where none serves it, all.
    pub fn of(hand: &Hand, object: Graspable, next: NextUse) -> Self {
        let fits = object.width + 2.0 * OPEN_GAP <= hand.width(hand.joints[1].limits.lower);
        let found = [
            Grip::from_above(hand, &object),
            Grip::from_beside(hand, &object),
            Grip::enclosing(hand, &object),
        ];
        let found: Vec<Grip> = found.into_iter().flatten().filter(|_| fits).collect();
        let all: Vec<Grip> = found.iter().filter(|grip| grip.suits(&found, &object, next)).copied().collect();
        let opened = all.iter().map(|grip| grip.open(hand, &object));
        let wider = |one: [f64; HAND_JOINTS], other: [f64; HAND_JOINTS]| {
            std::array::from_fn(|joint| one[joint].min(other[joint]))
        };
        let open = opened.reduce(wider).unwrap_or_else(|| hand.grasp(object.width, OPEN_GAP).angles);
        Self { object, open, all, grasp_distance: hand.grasp_distance }
    }

    /// Whether one of these grips may be used before this next use: it serves it, or none of them does.
    pub fn suits(&self, grip: &Grip, next: NextUse) -> bool {
        grip.suits(&self.all, &self.object, next)
    }

    /// Goals of the hand for all grips, each with the index of its grip, for an object whose frame (centre of its
    /// underside, z up) is `frame`. `back` m before it the approach begins; shoulder, elbow and wrist stay above `floor` m.
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
