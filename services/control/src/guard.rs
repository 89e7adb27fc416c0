use crate::course::Course;
use crate::person::PersonArm;
use coact_motion::{Body, Capsule, Mechanism};
use coact_robot::Posture;

/// Keeps arm, hand and held part clear of the person: says how fast the movement under way may go on.
#[derive(Debug)]
pub(crate) struct Guard {
    mechanism: Mechanism,
    /// Bodies with an empty hand, then with a part in it in each of the holds.
    bodies: Vec<Body>,
    hulls: Vec<Capsule>,
}

/// Distance that is kept, m.
const MARGIN: f64 = 0.04;
/// How far ahead the movement is looked at, s, and in how many steps.
const AHEAD: (f64, u32) = (0.4, 8);
/// Time within which the arm stands, s: with less to go it may not move on.
const STANDING: f64 = 0.1;
/// Pace at which the arm may get away from somebody who is too near.
const ESCAPE: f64 = 0.4;
/// A distance that grows by at least this in a step is one of getting away, m.
const GROWS: f64 = 1e-3;

impl Guard {
    pub fn new(mechanism: Mechanism, bodies: Vec<Body>) -> Self {
        let hulls = Vec::with_capacity(bodies.iter().map(|body| body.bones().len()).max().unwrap_or(0));
        Self { mechanism, bodies, hulls }
    }

    /// Share of its own speed at which the movement may go on, 0 to 1. `meets`: hand and person shall touch each other
    /// now, so that only the rest of the arm is watched.
    pub fn pace(
        &mut self,
        course: &Course,
        t: f64,
        hold: Option<usize>,
        person: &PersonArm,
        meets: bool,
    ) -> f64 {
        let (horizon, steps) = AHEAD;
        let step = horizon / f64::from(steps);
        let now = self.distance(&course.posture(t), hold, &person.after(0.0), meets);
        if now < MARGIN {
            let next = self.distance(&course.posture(t + step), hold, &person.after(step), meets);
            return if next > now + GROWS { ESCAPE } else { 0.0 };
        }
        let blocked = (1..=steps).map(|index| step * f64::from(index)).find(|ahead| {
            let posture = course.posture(t + ahead);
            self.distance(&posture, hold, &person.after(*ahead), meets) < MARGIN
        });
        blocked.map_or(1.0, |ahead| ((ahead - STANDING) / (horizon - STANDING)).clamp(0.0, 1.0))
    }

    /// Distance of the robot from the person, m.
    fn distance(
        &mut self,
        posture: &Posture,
        hold: Option<usize>,
        person: &[Capsule; 3],
        meets: bool,
    ) -> f64 {
        let body = &self.bodies[hold.map_or(0, |hold| hold + 1).min(self.bodies.len() - 1)];
        body.hulls_into(&self.mechanism, posture, &mut self.hulls);
        let watched = body
            .bones()
            .iter()
            .zip(&self.hulls)
            .filter(|(bone, _)| bone.carriers > 0 && !(meets && bone.hand));
        let pairs = watched.flat_map(|(_, hull)| person.iter().map(move |capsule| (hull, capsule)));
        pairs.fold(f64::INFINITY, |nearest, (hull, capsule)| {
            // Most pairs are certainly farther apart than the nearest one so far.
            if hull.least_distance(capsule) < nearest { nearest.min(hull.distance(capsule)) } else { nearest }
        })
    }
}
