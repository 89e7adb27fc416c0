use crate::blend::Blend;
use crate::budget::Budget;
use crate::line_constraint::LineConstraint;
use crate::segment::{self, Segment};
use crate::smoothing::{self, Change};
use crate::waypoints::Waypoints;
use crate::{Clearance, HandSpeedLimits, MinClearance, Plan, Refusal, SegmentKind, time_scaling};
use coact_robot::{JointLimits, MotionState, Posture};
use nalgebra::Vector3;

/// One attempt at a movement: from the start to one target, through given waypoints. It makes the movement's segments,
/// directly or with a bounce, smooths them, checks them and makes a plan of them.
pub(crate) struct Attempt<'a> {
    /// Clearance on the reach.
    pub clearance: Clearance<'a>,
    pub limits: [JointLimits; 7],
    pub waypoints: Waypoints,
    pub min_clearance: MinClearance,
    pub hand_speeds: HandSpeedLimits,
    /// Lines to which the hand keeps, m, world: out of where it is, and outwards from where it goes.
    pub lines: [Vector3<f64>; 2],
    pub budget: &'a Budget,
}

/// Postures that smoothing counts for in the budget: about eight evaluations of 37 postures each.
const SMOOTHING_POSTURES: u32 = 300;
/// Clearance that is added where a movement is made, m: between the points that are looked at it may come nearer. Chosen
/// by hand: on a reach of half a metre the sparse points are 2 cm apart.
pub(crate) const BETWEEN_POINTS: f64 = 0.004;
/// By how much a plan may come nearer than its segments, m: between its knots it differs a little from them. Chosen by
/// hand: a quarter of what is added where they are made.
const BETWEEN_KNOTS: f64 = 0.001;
/// How far from where it leaves or arrives the hand keeps to its speed of contact, m: for half of it at least, whatever the steps of a path.
/// Chosen by hand: fingers that come down beside a part are as near to it.
const CONTACT: f64 = 0.01;

impl<'a> Attempt<'a> {
    /// The direct movement.
    ///
    /// # Errors
    /// [`Refusal::TooFast`] when the start is too fast for the rest.
    pub fn direct(&self) -> Result<Vec<Segment>, Refusal> {
        self.timed([0.0; 7])
    }

    /// The movement with this bounce on the reach.
    pub(crate) fn timed(&self, bounce: Posture) -> Result<Vec<Segment>, Refusal> {
        let waypoints = Waypoints { bounce, ..self.waypoints.clone() };
        waypoints.timed(&self.limits).map_err(|joint| self.too_fast(joint))
    }

    /// That this joint is too fast for the movement.
    pub fn too_fast(&self, joint: usize) -> Refusal {
        let joint = self.clearance.mechanism.arm.joints.get(joint).map_or("", |joint| &joint.name);
        Refusal::TooFast { joint: joint.to_owned() }
    }

    /// These segments, changed so that hand and joints move more smoothly, if they are clear then.
    pub fn smooth(&self, segments: &[Segment]) -> Option<Vec<Segment>> {
        let required = |t: f64| {
            let (clearance, required) = self.required(segments, t);
            (clearance, required + BETWEEN_POINTS)
        };
        if !self.budget.spend(SMOOTHING_POSTURES) {
            return None;
        }
        let lines: Vec<LineConstraint> = self.line_constraints(segments).collect();
        let is_free = self.waypoints.blend == Blend::MinimumJerk;
        let mechanism = self.clearance.mechanism;
        let change = smoothing::smoothest(mechanism, segments, is_free, &required, &lines);
        let segments = self.changed(segments, &change).timed(&self.limits).ok()?;
        self.check(&segments).is_ok().then_some(segments)
    }

    /// The waypoints with a change of these segments, their own.
    fn changed(&self, segments: &[Segment], change: &Change) -> Waypoints {
        let reach = segments.iter().find(|segment| segment.kind == SegmentKind::Reach);
        let bounce = reach.map_or([0.0; 7], |reach| reach.motion.bounce);
        let bounce = std::array::from_fn(|joint| bounce[joint] + change.bounce[joint]);
        let mut waypoints = Waypoints { bounce, ..self.waypoints.clone() };
        if waypoints.blend == Blend::MinimumJerk {
            let total = segment::duration(segments);
            let pairs = segments.iter().zip(&change.passed);
            let given = pairs.map(|(segment, [position, velocity, acceleration])| {
                let end = segment.motion.end;
                std::array::from_fn(|joint| MotionState {
                    position: end[joint].position + position[joint],
                    velocity: end[joint].velocity * total + velocity[joint],
                    acceleration: end[joint].acceleration * total.powi(2) + acceleration[joint],
                })
            });
            waypoints.blend = Blend::Given(given.collect());
        }
        waypoints
    }

    /// The segments as the fastest plan that is clear.
    ///
    /// # Errors
    /// [`Refusal::TooFast`].
    pub fn plan(&self, segments: &[Segment]) -> Result<Plan, Refusal> {
        let keeps = |t: f64, posture: &Posture| {
            let (clearance, required) = self.required(segments, t);
            clearance.is_clear(posture, required - BETWEEN_KNOTS)
        };
        let near = [CONTACT, self.lines[1].norm().max(CONTACT)];
        let mechanism = self.clearance.mechanism;
        let plan = time_scaling::plan(mechanism, segments, &self.limits, (&self.hand_speeds, near), &keeps);
        plan.map_err(|joint| self.too_fast(joint))
    }

    /// The lines to which the hand keeps in these segments.
    pub(crate) fn line_constraints(
        &self,
        segments: &[Segment],
    ) -> impl Iterator<Item = LineConstraint> + use<> {
        let (mechanism, [out, into]) = (self.clearance.mechanism, self.lines);
        let leaving = LineConstraint::of_leaving(mechanism, segments, out);
        leaving.into_iter().chain(LineConstraint::of_approach(mechanism, segments, into))
    }

    /// The clearance at an instant of these segments, and how much of it is required there, m.
    fn required(&self, segments: &[Segment], t: f64) -> (Clearance<'a>, f64) {
        let Some((segment, t)) = segment::during(segments, t) else {
            return (self.clearance, self.min_clearance.path);
        };
        let s = t / segment.motion.duration;
        match segment.kind {
            SegmentKind::Reach => (self.clearance, self.required_on_reach(segments, segment, s)),
            kind => (self.clearance.at(kind), self.required_on_straight(kind, s)),
        }
    }

    /// What is required on a reach, m: less where the first one begins and the last one ends, not where they meet.
    pub(crate) fn required_on_reach(&self, segments: &[Segment], segment: &Segment, s: f64) -> f64 {
        let mut reaches = segments.iter().filter(|segment| segment.kind == SegmentKind::Reach);
        let end = if s < 0.5 { reaches.next() } else { reaches.next_back() };
        let is_end = end.is_some_and(|end| std::ptr::eq(end, segment));
        if is_end { self.min_clearance.at(s) } else { self.min_clearance.path }
    }

    /// What is required while leaving and approaching, m. The arm stands where it stands: leaving may begin nearer to
    /// something.
    pub(crate) fn required_on_straight(&self, kind: SegmentKind, s: f64) -> f64 {
        if kind == SegmentKind::Leave && s < 0.5 { 0.0 } else { self.min_clearance.goal }
    }
}
