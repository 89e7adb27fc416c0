use crate::bell::during;
use crate::comfort::{WEIGHT, cost};
use crate::guide::Guide;
use crate::quadratic::Quadratic;
use crate::roughness::Roughness;
use crate::route::Route;
use crate::segment_motion::excursion;
use crate::solver::anywhere;
use crate::work::Work;
use crate::{Clearance, MinClearance, Plan, Proximity, Refusal, Segment, SegmentKind, SegmentMotion, bell};
use coact_robot::{JointLimits, Posture};
use nalgebra::Vector3;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::ops::Range;

/// The search for a movement along a route that stays clear of everything: the direct one, or the one with the smallest
/// excursion on the reach.
pub(crate) struct Way<'a> {
    /// Distances on the reach.
    pub clearance: Clearance<'a>,
    pub limits: [JointLimits; 7],
    pub route: Route,
    pub min_clearance: MinClearance,
    /// Lines to which the hand keeps: out of where it is, and outwards from where it goes, m, world.
    pub lines: [Vector3<f64>; 2],
    /// What the search may do.
    pub work: &'a Work,
}

/// Points of a way at which the search watches the distances, and those at which the result is checked.
const WATCHED: u32 = 24;
const CHECKED: u32 = 96;
/// Postures that making a movement smooth looks at, about.
const SMOOTHING: u32 = 300;
/// Steps of one search.
const STEPS: u32 = 25;
/// Links nearer than this are watched, m, beyond the margin.
const NEARBY: f64 = 0.06;
/// Demands on one step at most: the nearest ones.
const DEMANDS: usize = 120;
/// Room for what lies between the points, m, and by how much a plan may come nearer than its segments.
const BETWEEN: f64 = 0.004;
const BETWEEN_KNOTS: f64 = 0.001;
/// Postures that are drawn at most until one is clear.
const DRAWS: u32 = 40;
/// Largest change of the excursion in one step, rad.
const TRUST: f64 = 0.5;

impl<'a> Way<'a> {
    /// The direct movement along the route.
    ///
    /// # Errors
    /// [`Refusal::TooFast`] when the start is too fast for the rest.
    pub fn direct(&self) -> Result<Vec<Segment>, Refusal> {
        self.timed([0.0; 7])
    }

    /// The movement with the smallest excursion that keeps clear, beginning from these attempts, one after the other:
    /// the first begins at the direct movement, the others ever farther from it.
    ///
    /// # Errors
    /// [`Refusal::NoPath`] when nothing was found.
    pub fn find(&self, direct: &[Segment], attempts: Range<u32>) -> Result<Vec<Segment>, Refusal> {
        self.check_straight_segments(direct)?;
        let Some(reach) = reach(direct) else { return Ok(direct.to_vec()) };
        let Some(nearest) = self.worst(&reach, CHECKED) else { return Ok(direct.to_vec()) };
        for attempt in attempts {
            let bounce = if attempt == 0 { [0.0; 7] } else { self.somewhere(&reach, attempt) };
            if let Some(found) = self.shrink(bounce, &reach) {
                return Ok(found);
            }
        }
        Err(self.refusal(&nearest))
    }

    /// The movement with the smallest excursion near one of these postures, half-way through the reach.
    pub fn find_near(&self, vias: &[Posture]) -> Option<Vec<Segment>> {
        let direct = self.direct().ok()?;
        self.check_straight_segments(&direct).ok()?;
        let reach = reach(&direct)?;
        vias.iter().find_map(|via| self.shrink(bounce_to(via, &reach), &reach))
    }

    /// These segments, with hand and joints moving more smoothly, if that is clear.
    pub fn smooth(&self, segments: &[Segment]) -> Option<Vec<Segment>> {
        let room = |t: f64| {
            let (clearance, margin) = self.room(segments, t);
            (clearance, margin + BETWEEN)
        };
        if !self.work.spend(SMOOTHING) {
            return None;
        }
        let guides: Vec<Guide> = self.guides(segments).collect();
        let change = self.route.smoothing(self.clearance.mechanism, segments, &room, &guides);
        let segments = self.route.changed(segments, &change).timed(&self.limits).ok()?;
        self.check(&segments).is_ok().then_some(segments)
    }

    /// Holds all segments against everything.
    ///
    /// # Errors
    /// What comes too near.
    pub fn check(&self, segments: &[Segment]) -> Result<(), Refusal> {
        self.check_straight_segments(segments)?;
        self.check_guided(segments)?;
        let reaches = segments.iter().filter(|segment| segment.kind == SegmentKind::Reach);
        let mut worst = reaches.filter_map(|segment| {
            self.worst_of(&segment.motion, CHECKED, &|s| self.reach_margin(segments, segment, s))
        });
        worst.next().map_or(Ok(()), |worst| Err(self.refusal(&worst)))
    }

    /// The hand must keep to its line where it leaves something, and where what it holds goes into something.
    fn check_guided(&self, segments: &[Segment]) -> Result<(), Refusal> {
        let mechanism = self.clearance.mechanism;
        let excesses = self.guides(segments).flat_map(|guide| {
            (0..=WATCHED).map(move |point| {
                let posture = segments[guide.segment].motion.posture(f64::from(point) / f64::from(WATCHED));
                guide.excess(&(mechanism.arm.palm(&posture) * mechanism.grasp_point()))
            })
        });
        let short = excesses.fold(0.0, f64::max);
        if short > 0.0 {
            let (link, other) =
                ("the hand".to_owned(), "the side of the place that it leaves or goes into".to_owned());
            return Err(Refusal::NoPath { link, other, short, fraction: 1.0 });
        }
        Ok(())
    }

    fn guides(&self, segments: &[Segment]) -> impl Iterator<Item = Guide> + use<> {
        let (mechanism, [out, into]) = (self.clearance.mechanism, self.lines);
        let leaving = Guide::of_leaving(mechanism, segments, out);
        leaving.into_iter().chain(Guide::of_approach(mechanism, segments, into))
    }

    /// The distances that count at an instant of these segments, and how much of them is kept, m.
    fn room(&self, segments: &[Segment], t: f64) -> (Clearance<'a>, f64) {
        let Some((segment, t)) = during(segments, t) else {
            return (self.clearance, self.min_clearance.path);
        };
        let s = t / segment.motion.duration;
        match segment.kind {
            SegmentKind::Reach => (self.clearance, self.reach_margin(segments, segment, s)),
            kind => (self.clearance.at(kind), self.straight_margin(kind, s)),
        }
    }

    fn timed(&self, bounce: Posture) -> Result<Vec<Segment>, Refusal> {
        let route = Route { bounce, ..self.route.clone() };
        route.timed(&self.limits).map_err(|joint| {
            let joint = self.clearance.mechanism.arm.joints.get(joint).map_or("", |joint| &joint.name);
            Refusal::TooFast { joint: joint.to_owned() }
        })
    }

    /// Leaving and approaching must be free: no excursion helps them.
    fn check_straight_segments(&self, segments: &[Segment]) -> Result<(), Refusal> {
        let straight = segments.iter().filter(|segment| segment.kind != SegmentKind::Reach);
        let near = straight.flat_map(|segment| {
            let postures = (0..=WATCHED).map(|point| f64::from(point) / f64::from(WATCHED));
            let clearance = self.clearance.at(segment.kind);
            postures.filter_map(move |s| {
                let margin = self.straight_margin(segment.kind, s);
                let near = clearance.nearest(&segment.motion.posture(s), margin)?;
                Some((margin - near.distance, near))
            })
        });
        match near.max_by(|one, other| one.0.total_cmp(&other.0)) {
            None => Ok(()),
            Some((short, near)) => {
                let (link, other) = self.clearance.names(&near);
                Err(Refusal::Blocked { link, other, short })
            }
        }
    }

    /// The point of the way that comes nearest to something, if it comes nearer than the margin.
    fn worst(&self, way: &SegmentMotion, points: u32) -> Option<(f64, Proximity)> {
        self.worst_of(way, points, &|s| self.min_clearance.at(s))
    }

    fn worst_of(
        &self,
        way: &SegmentMotion,
        points: u32,
        margin: &dyn Fn(f64) -> f64,
    ) -> Option<(f64, Proximity)> {
        let shares = (0..=points).map(|point| f64::from(point) / f64::from(points));
        let found = shares.filter_map(|s| Some((s, self.clearance.nearest(&way.posture(s), margin(s))?)));
        found.min_by(|one, other| one.1.distance.total_cmp(&other.1.distance))
    }

    /// What is kept on a reach, m: it narrows where the first begins and the last ends, not where they meet.
    fn reach_margin(&self, segments: &[Segment], segment: &Segment, s: f64) -> f64 {
        let mut reaches = segments.iter().filter(|segment| segment.kind == SegmentKind::Reach);
        let end = if s < 0.5 { reaches.next() } else { reaches.next_back() };
        let is_end = end.is_some_and(|end| std::ptr::eq(end, segment));
        if is_end { self.min_clearance.at(s) } else { self.min_clearance.path }
    }

    /// From this excursion, to the smallest one nearby that keeps clear.
    fn shrink(&self, mut bounce: Posture, direct: &SegmentMotion) -> Option<Vec<Segment>> {
        let mut trust = TRUST;
        let shape = |bounce: Posture| SegmentMotion { bounce, ..*direct };
        let mut merit = self.merit(&shape(bounce));
        for _ in 0..STEPS {
            if !self.work.spend(2 * WATCHED) {
                return None;
            }
            let step = self.step(&shape(bounce), trust)?;
            let next = std::array::from_fn(|joint| bounce[joint] + step[joint]);
            let after = self.merit(&shape(next));
            let gain = merit - after;
            if gain > 0.0 {
                (bounce, merit) = (next, after);
            }
            if gain < 1e-3 {
                trust *= 0.4;
            }
            if trust < 0.01 {
                break;
            }
        }
        let found = self.timed(bounce).ok()?;
        let within = reach(&found).is_some_and(|reach| self.worst(&reach, CHECKED).is_none());
        within.then_some(found)
    }

    fn step(&self, way: &SegmentMotion, trust: f64) -> Option<Posture> {
        let mut demands: Vec<(f64, Posture, f64)> = Vec::new();
        let mut near = Vec::new();
        for point in 1..WATCHED {
            let s = f64::from(point) / f64::from(WATCHED);
            let margin = self.min_clearance.at(s) + BETWEEN;
            let [share, ..] = excursion(s);
            let posture = way.posture(s);
            self.clearance.near(&posture, margin + NEARBY, &mut near);
            demands.extend(near.iter().map(|near| {
                (near.distance, near.gradient.map(|gradient| share * gradient), margin - near.distance)
            }));
            self.demand_limits(&posture, share, &mut demands);
        }
        demands.sort_by(|one, other| one.0.total_cmp(&other.0));
        demands.truncate(DEMANDS);
        let mechanism = self.clearance.mechanism;
        let reach = |joint: usize| if joint < mechanism.joints() { trust } else { 0.0 };
        let problem = Quadratic {
            weight: WEIGHT,
            centre: way.bounce.map(|offset| -offset),
            lower: std::array::from_fn(|joint| -reach(joint)),
            upper: std::array::from_fn(reach),
            above: demands.into_iter().map(|(_, gradient, bound)| (gradient, bound)).collect(),
            equal: Vec::new(),
            penalty: PENALTY,
        };
        problem.solve()
    }

    /// Demands that joints which come near their limits stay within them.
    fn demand_limits(&self, posture: &Posture, share: f64, demands: &mut Vec<(f64, Posture, f64)>) {
        let joints = self.limits.iter().zip(posture).take(self.clearance.mechanism.joints());
        for (joint, (limit, angle)) in joints.enumerate() {
            let unit =
                |sign: f64| std::array::from_fn(|other| if other == joint { sign * share } else { 0.0 });
            for (sign, room) in [(1.0, angle - limit.lower), (-1.0, limit.upper - angle)] {
                if room < NEARBY {
                    demands.push((room, unit(sign), -room));
                }
            }
        }
    }

    /// Size of the excursion, and how far the demands are not met at the watched points.
    fn merit(&self, way: &SegmentMotion) -> f64 {
        let mut short = 0.0f64;
        for point in 1..WATCHED {
            let s = f64::from(point) / f64::from(WATCHED);
            let (posture, margin) = (way.posture(s), self.min_clearance.at(s) + BETWEEN);
            if let Some(near) = self.clearance.nearest(&posture, margin - short) {
                short = short.max(margin - near.distance);
            }
            for (limit, angle) in self.limits.iter().zip(&posture) {
                short = short.max(limit.lower - angle).max(angle - limit.upper);
            }
        }
        cost(&way.bounce, &[0.0; 7]) + PENALTY * short
    }

    /// An excursion to a random posture that is clear of everything, ever farther from the middle of the way.
    fn somewhere(&self, reach: &SegmentMotion, attempt: u32) -> Posture {
        let mut random = Pcg64::seed_from_u64(10 + u64::from(attempt));
        let middle = reach.posture(0.5);
        let joints = self.clearance.mechanism.joints();
        let share = (0.12 * f64::from(attempt)).min(0.9);
        let mut posture = middle;
        for _ in 0..DRAWS {
            let anywhere = anywhere(&mut random, &self.limits, joints);
            posture = std::array::from_fn(|joint| middle[joint] + share * (anywhere[joint] - middle[joint]));
            if self.clearance.is_clear(&posture, self.min_clearance.path) {
                break;
            }
        }
        bounce_to(&posture, reach)
    }

    /// The segments as a plan, whose law of time is that of one bell where that keeps clear and within the limits.
    pub fn plan(&self, segments: &[Segment]) -> (Roughness, Plan) {
        let keeps = |t: f64, posture: &Posture| {
            let (clearance, margin) = self.room(segments, t);
            clearance.is_clear(posture, margin - BETWEEN_KNOTS)
        };
        bell::timed(self.clearance.mechanism, segments, &self.limits, &keeps)
    }

    /// What is kept while leaving and approaching, m. The start is where it is: leaving may begin nearer than the margin.
    fn straight_margin(&self, kind: SegmentKind, s: f64) -> f64 {
        if kind == SegmentKind::Leave && s < 0.5 { 0.0 } else { self.min_clearance.goal }
    }

    fn refusal(&self, (share, near): &(f64, Proximity)) -> Refusal {
        let (link, other) = self.clearance.names(near);
        Refusal::NoPath {
            link,
            other,
            short: self.min_clearance.at(*share) - near.distance,
            fraction: *share,
        }
    }
}

/// Cost of each metre by which a demand is not met, rad².
const PENALTY: f64 = 200.0;

/// The bounce with which a reach is at a posture half-way.
fn bounce_to(posture: &Posture, reach: &SegmentMotion) -> Posture {
    let middle = reach.posture(0.5);
    std::array::from_fn(|joint| reach.bounce[joint] + posture[joint] - middle[joint])
}

fn reach(segments: &[Segment]) -> Option<SegmentMotion> {
    segments.iter().find(|segment| segment.kind == SegmentKind::Reach).map(|segment| segment.motion)
}
