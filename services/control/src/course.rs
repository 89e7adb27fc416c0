use bytemuck::{Pod, Zeroable};
use coact_motion::{Knot, Plan, SegmentKind, state_at};
use coact_robot::{MotionState, Posture};

/// A planned movement of the arm in memory of fixed size: zero-copy, and a restarted control goes on with it.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub(crate) struct Course {
    /// Its knots, the first `count` of them.
    knots: [Knot; Plan::KNOTS],
    count: u64,
    /// When leaving has ended, when the fingers begin to take their shape for the goal, and when the approach begins, s.
    pub left: f64,
    pub preshapes: f64,
    pub approaches: f64,
}

impl Course {
    /// Standing.
    pub fn resting(posture: Posture) -> Self {
        let mut course = Self { count: 1, ..Self::zeroed() };
        course.knots[0].states = posture.map(MotionState::at_rest);
        course
    }

    /// From a plan; none when it has too many knots.
    pub fn of(plan: &Plan) -> Option<Self> {
        let mut course = Self { count: plan.knots.len() as u64, ..Self::zeroed() };
        course.knots.get_mut(..plan.knots.len())?.copy_from_slice(&plan.knots);
        let end_of = |kind: SegmentKind| {
            plan.segments.iter().rev().find(|(segment, _)| *segment == kind).map(|(_, end)| *end)
        };
        course.left = end_of(SegmentKind::Leave).unwrap_or(0.0);
        course.preshapes = course.left;
        course.approaches = match end_of(SegmentKind::Approach) {
            Some(_) => end_of(SegmentKind::Reach).unwrap_or(course.left),
            None => plan.duration(),
        };
        Some(course)
    }

    /// Whether the words are a movement.
    pub fn is_sound(&self) -> bool {
        let finite = |knot: &Knot| {
            bytemuck::cast_slice::<Knot, f64>(std::slice::from_ref(knot)).iter().all(|v| v.is_finite())
        };
        (1..=Plan::KNOTS as u64).contains(&self.count) && self.knots().iter().all(finite)
    }

    /// State of the arm `t` s after the start.
    pub fn at(&self, t: f64) -> [MotionState; 7] {
        state_at(self.knots(), t)
    }

    /// Posture `t` s after the start, rad.
    pub fn posture(&self, t: f64) -> Posture {
        self.at(t).map(|state| state.position)
    }

    /// Time of the whole movement, s.
    pub fn duration(&self) -> f64 {
        self.knots().last().map_or(0.0, |knot| knot.t)
    }

    /// Share of the way out of, or into, a narrow place: 1 where the hand is in it, 0 on the reach.
    pub fn inside(&self, t: f64) -> f64 {
        if t < self.left {
            1.0 - t / self.left
        } else if self.is_approach(t) {
            ((t - self.approaches) / (self.duration() - self.approaches)).min(1.0)
        } else {
            0.0
        }
    }

    /// Whether the hand goes straight to its goal `t` s after the start, or is there.
    pub fn is_approach(&self, t: f64) -> bool {
        t > self.approaches && self.approaches < self.duration()
    }

    fn knots(&self) -> &[Knot] {
        &self.knots[..(self.count as usize).min(Plan::KNOTS)]
    }
}
