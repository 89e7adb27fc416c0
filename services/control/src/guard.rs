use crate::body::{self, Fingers};
use crate::memory::Memory;
use crate::person::PersonArm;
use crate::places::Places;
use crate::planner::Planner;
use coact_motion::{Capsule, CollisionModel, Mechanism};
use coact_robot::{JointLimits, NextUse, RobotError};
use nalgebra::Isometry3;

/// Keeps arm, hand and held part clear of the person: says how fast the movement under way may go on.
#[derive(Debug)]
pub(crate) struct Guard {
    mechanism: Mechanism,
    /// Bodies with an empty hand, the fingers ever farther closed; then with a part in it in each of the holds.
    bodies: Vec<CollisionModel>,
    /// Limits of the fingers' bases.
    bases: JointLimits,
    /// Where the person is at the moment looked at.
    person: Vec<Capsule>,
}

/// Distance that is kept, m.
pub(crate) const MARGIN: f64 = 0.04;
/// Shapes of the empty hand.
const SHAPES: usize = 13;
/// How far ahead the movement is looked at, s, and in how many steps.
const AHEAD: (f64, u32) = (0.4, 8);
/// Time within which the arm stands, s: with less to go it may not move on.
const STANDING: f64 = 0.1;
/// Pace at which the arm may get away from somebody who is too near.
const ESCAPE: f64 = 0.4;
/// It gets away if it is at last farther from the person than if it stood, by this, and on the way hardly nearer, m.
const GAIN: f64 = 1e-3;
const LOSS: f64 = 1e-5;

impl Guard {
    /// # Errors
    /// [`RobotError`] when the robot's collision geometry cannot be used.
    pub fn new(own: &body::Body, places: &Places, planner: &Planner) -> Result<Self, RobotError> {
        let (hand, bases) = (&own.robot.hand, own.robot.hand.joints[1].limits);
        let base =
            |shape: usize| bases.lower + (bases.upper - bases.lower) * shape as f64 / (SHAPES - 1) as f64;
        let empty = (0..SHAPES).map(|shape| planner.figure(&[hand.posture(base(shape))], None));
        let holding = own.holds.all().iter().enumerate().map(|(index, hold)| {
            let mut goals = places.takes(hold.kind, NextUse::Anything, &Isometry3::identity()).into_iter();
            let goal = goals.find(|(_, of)| *of == Some(index)).map(|(goal, _)| goal);
            let palm = goal.map(|goal| hand.palm_at(&goal.point, &goal.approach, &goal.closing_axis, 0.0));
            let in_palm = palm.map_or_else(Isometry3::identity, |palm| palm.inverse());
            planner.figure(&[own.fingers(Fingers::On(index))], Some((hold.kind, in_palm)))
        });
        let bodies: Vec<CollisionModel> = empty.chain(holding).collect::<Result<_, _>>()?;
        let person = Vec::with_capacity(PersonArm::CAPSULES);
        Ok(Self { mechanism: planner.mechanism().clone(), bodies, bases, person })
    }

    /// Share of its own speed at which the movement under way may go on, 0 to 1, with a part in `hold`, or with the
    /// fingers' bases of an empty hand at `closing` rad.
    pub fn pace(&mut self, memory: &Memory, hold: Option<usize>, closing: f64, person: &PersonArm) -> f64 {
        let shape = hold.map_or_else(|| self.shape(closing), |hold| SHAPES + hold);
        let body = &self.bodies[shape.min(self.bodies.len() - 1)];
        let (horizon, steps) = AHEAD;
        let ahead = |step: u32| horizon / f64::from(steps) * f64::from(step);
        // Distance after this time when the movement goes on, or stops, now, without the hand where the hands shall meet;
        // `most` when it is more.
        let mut distance = |ahead: f64, goes_on: bool, most: f64| {
            let t = memory.elapsed + if goes_on { ahead } else { 0.0 };
            self.person.clear();
            self.person.extend(person.after(ahead));
            body.distance(&self.mechanism, &memory.course.posture(t), &self.person, !memory.meets(t), most)
        };
        if distance(0.0, true, MARGIN) < MARGIN {
            let gains = [1, 2, 4, steps]
                .map(ahead)
                .map(|ahead| distance(ahead, true, f64::INFINITY) - distance(ahead, false, f64::INFINITY));
            let (least, last) =
                gains.into_iter().fold((0.0, 0.0), |(least, _): (f64, f64), gain| (least.min(gain), gain));
            return if least > -LOSS && last > GAIN { ESCAPE } else { 0.0 };
        }
        let blocked = (1..=steps).map(ahead).find(|ahead| distance(*ahead, true, MARGIN) < MARGIN);
        blocked.map_or(1.0, |ahead| ((ahead - STANDING) / (horizon - STANDING)).clamp(0.0, 1.0))
    }

    /// The body with an empty hand that is most like one with the fingers' bases at this angle, rad.
    fn shape(&self, closing: f64) -> usize {
        let share = (closing - self.bases.lower) / (self.bases.upper - self.bases.lower);
        (share * (SHAPES - 1) as f64).round().clamp(0.0, (SHAPES - 1) as f64) as usize
    }
}
