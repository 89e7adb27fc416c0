use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_messages::ArmPath;
use coact_motion::{Plan, SegmentKind};
use coact_robot::{Knot, MotionState, Posture, state_at};
use coact_stage_state::{Flag, Implausible, bounded, ensure, finite};

/// A planned trajectory of the arm, of fixed size, so that it is part of the state: a restarted control goes on with it.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct ArmTrajectory {
    /// Its knots, the first `count` of them.
    knots: [Knot; Plan::KNOTS],
    count: u64,
    /// When its segment of leaving ends, s.
    leave_ends: f64,
    /// When the fingers begin to take their shape for the goal, s.
    pub fingers_begin: f64,
    /// When its segment of approach begins, s.
    pub approach_begins: f64,
    /// The shortest time in which its path could be followed, whatever the jerk, s; 0: not known.
    shortest: f64,
    /// Whether it only withdraws the hand from where it is: the skill's own movement is planned at its end.
    pub withdraws: Flag,
}

/// No time, angle, speed or acceleration of an arm is greater; s, rad, rad/s, rad/s².
const MOST: f64 = 1e4;

impl ArmTrajectory {
    /// Standing still.
    pub fn resting(posture: Posture) -> Self {
        let mut trajectory = Self { count: 1, ..Self::zeroed() };
        trajectory.knots[0].states = posture.map(MotionState::at_rest);
        trajectory
    }

    /// From a plan; none when it has too many knots.
    pub fn of(plan: &Plan) -> Option<Self> {
        let mut trajectory = Self { count: plan.knots.len() as u64, ..Self::zeroed() };
        trajectory.knots.get_mut(..plan.knots.len())?.copy_from_slice(&plan.knots);
        let end_of = |kind: SegmentKind| {
            plan.segments.iter().rev().find(|(segment, _)| *segment == kind).map(|(_, end)| *end)
        };
        trajectory.leave_ends = end_of(SegmentKind::Leave).unwrap_or(0.0);
        trajectory.fingers_begin = trajectory.leave_ends;
        trajectory.shortest = if plan.shortest.is_finite() { plan.shortest } else { 0.0 };
        trajectory.approach_begins = match end_of(SegmentKind::Approach) {
            Some(_) => end_of(SegmentKind::Reach).unwrap_or(trajectory.leave_ends),
            None => plan.duration(),
        };
        Some(trajectory)
    }

    pub fn check(&self, field: &'static str) -> Result<(), Implausible> {
        ensure((1..=Plan::KNOTS as u64).contains(&self.count), field, "as many knots as a plan may have")?;
        bounded(field, bytemuck::cast_slice(self.knots()), MOST)?;
        finite(field, &[self.leave_ends, self.fingers_begin, self.approach_begins, self.shortest])
    }

    /// State of the arm `t` s after the start.
    pub fn at(&self, t: f64) -> [MotionState; 7] {
        state_at(self.knots(), t)
    }

    /// Whether the arm stands at its start.
    pub fn begins_at_rest(&self) -> bool {
        self.knots[0].states.iter().all(MotionState::is_at_rest)
    }

    /// Posture `t` s after the start, rad.
    pub fn posture(&self, t: f64) -> Posture {
        self.at(t).map(|state| state.position)
    }

    /// Its duration, s.
    pub fn duration(&self) -> f64 {
        self.knots().last().map_or(0.0, |knot| knot.t)
    }

    /// Fraction of the way out of, or into, a narrow place: 1 where the hand is in it, 0 on the reach.
    pub fn enclosed(&self, t: f64) -> f64 {
        if t < self.leave_ends {
            1.0 - t / self.leave_ends
        } else if self.is_approach(t) {
            ((t - self.approach_begins) / (self.duration() - self.approach_begins)).min(1.0)
        } else {
            0.0
        }
    }

    /// Whether the hand is on its way out of a narrow place `t` s after the start.
    pub fn is_leaving(&self, t: f64) -> bool {
        t < self.leave_ends
    }

    /// Whether the hand goes straight to its goal `t` s after the start, or is there.
    pub fn is_approach(&self, t: f64) -> bool {
        t > self.approach_begins && self.approach_begins < self.duration()
    }

    /// Writes the knots into the path of a command.
    pub fn write(&self, path: &mut ArmPath) {
        let knots = self.knots();
        (path.count, path.shortest) = (knots.len() as u64, self.shortest);
        path.knots[..knots.len()].copy_from_slice(bytemuck::cast_slice(knots));
    }

    /// Its knots.
    pub fn knots(&self) -> &[Knot] {
        &self.knots[..(self.count as usize).min(Plan::KNOTS)]
    }
}
