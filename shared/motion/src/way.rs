use crate::comfort::{WEIGHT, cost};
use crate::quadratic::Quadratic;
use crate::route::Route;
use crate::solver::anywhere;
use crate::trajectory::excursion;
use crate::{Clearance, Margin, Near, Refusal, Stage, StageKind, Trajectory};
use coact_robot::{JointLimits, Posture};
use rand::SeedableRng;
use rand_pcg::Pcg64;

/// The search for a movement along a route that stays clear of everything: the direct one, or the one with the smallest
/// excursion on the reach.
pub(crate) struct Way<'a> {
    pub clearance: Clearance<'a>,
    /// The same, where the hand may touch what it is about.
    pub touching: Clearance<'a>,
    pub limits: [JointLimits; 7],
    pub route: Route,
    pub margin: Margin,
    /// Excursions that are tried at most.
    pub tries: u32,
}

/// Points of a way at which the search watches the distances, and those at which the result is checked.
const WATCHED: u32 = 24;
const CHECKED: u32 = 96;
/// Steps of one search.
const STEPS: u32 = 25;
/// Bones nearer than this are watched, m, beyond the margin.
const NEARBY: f64 = 0.06;
/// Demands on one step at most: the nearest ones.
const DEMANDS: usize = 120;
/// Room for what lies between the points, m.
const BETWEEN: f64 = 0.004;
/// Postures that are drawn at most until one is clear.
const DRAWS: u32 = 40;
/// Largest change of the excursion in one step, rad.
const TRUST: f64 = 0.5;

impl Way<'_> {
    /// # Errors
    /// [`Refusal::Way`] when nothing was found, [`Refusal::TooFast`] when the start is too fast for the rest.
    pub fn find(&self) -> Result<Vec<Stage>, Refusal> {
        let direct = self.timed([0.0; 7])?;
        self.check_straight_stages(&direct)?;
        let Some(reach) = reach(&direct) else { return Ok(direct) };
        let Some(nearest) = self.worst(&reach, CHECKED) else { return Ok(direct) };
        let mut random = Pcg64::seed_from_u64(11);
        for attempt in 0..self.tries {
            let bounce = if attempt == 0 { [0.0; 7] } else { self.somewhere(&reach, &mut random, attempt) };
            if let Some(found) = self.shrink(bounce, &reach) {
                return Ok(found);
            }
        }
        Err(self.refusal(&nearest))
    }

    /// The movement with the smallest excursion near this posture, half-way through the reach.
    pub fn find_near(&self, via: &Posture) -> Option<Vec<Stage>> {
        let direct = self.timed([0.0; 7]).ok()?;
        self.check_straight_stages(&direct).ok()?;
        let reach = reach(&direct)?;
        let middle = reach.posture(0.5);
        self.shrink(std::array::from_fn(|joint| via[joint] - middle[joint]), &reach)
    }

    /// The movement along a route of several reaches, if all of it is clear.
    ///
    /// # Errors
    /// As [`Way::find`].
    pub fn follow(&self) -> Result<Vec<Stage>, Refusal> {
        let stages = self.timed([0.0; 7])?;
        self.check_straight_stages(&stages)?;
        let reaches = stages.iter().filter(|stage| stage.kind == StageKind::Reach);
        match reaches.filter_map(|stage| self.worst(&stage.trajectory, CHECKED)).next() {
            None => Ok(stages),
            Some(worst) => Err(self.refusal(&worst)),
        }
    }

    fn timed(&self, bounce: Posture) -> Result<Vec<Stage>, Refusal> {
        let route = Route { bounce, ..self.route.clone() };
        route.timed(&self.limits).map_err(|joint| {
            let joint = self.clearance.mechanism.arm.joints.get(joint).map_or("", |joint| &joint.name);
            Refusal::TooFast { joint: joint.to_owned() }
        })
    }

    /// Leaving and approaching must be free: no excursion helps them.
    fn check_straight_stages(&self, stages: &[Stage]) -> Result<(), Refusal> {
        let straight = stages.iter().filter(|stage| stage.kind != StageKind::Reach);
        let near = straight.flat_map(|stage| {
            // The start is where it is: leaving may begin nearer than the margin.
            let postures = (0..=WATCHED).map(|point| f64::from(point) / f64::from(WATCHED));
            postures.filter_map(|s| {
                let begins = stage.kind == StageKind::Leave && s < 0.5;
                let margin = if begins { 0.0 } else { self.margin.goal };
                let near = self.touching.nearest(&stage.trajectory.posture(s), margin)?;
                Some((margin - near.distance, near))
            })
        });
        match near.max_by(|one, other| one.0.total_cmp(&other.0)) {
            None => Ok(()),
            Some((short, near)) => {
                let (bone, other) = self.touching.names(&near);
                Err(Refusal::Blocked { bone, other, short })
            }
        }
    }

    /// The point of the way that comes nearest to something, if it comes nearer than the margin.
    fn worst(&self, way: &Trajectory, points: u32) -> Option<(f64, Near)> {
        let shares = (0..=points).map(|point| f64::from(point) / f64::from(points));
        let found =
            shares.filter_map(|s| Some((s, self.clearance.nearest(&way.posture(s), self.margin.at(s))?)));
        found.min_by(|one, other| one.1.distance.total_cmp(&other.1.distance))
    }

    /// From this excursion, to the smallest one nearby that keeps clear.
    fn shrink(&self, mut bounce: Posture, direct: &Trajectory) -> Option<Vec<Stage>> {
        let mut trust = TRUST;
        let shape = |bounce: Posture| Trajectory { bounce, ..*direct };
        let mut merit = self.merit(&shape(bounce));
        for _ in 0..STEPS {
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

    fn step(&self, way: &Trajectory, trust: f64) -> Option<Posture> {
        let mut demands: Vec<(f64, Posture, f64)> = Vec::new();
        let mut near = Vec::new();
        for point in 1..WATCHED {
            let s = f64::from(point) / f64::from(WATCHED);
            let margin = self.margin.at(s) + BETWEEN;
            let [share, ..] = excursion(s);
            let posture = way.posture(s);
            self.clearance.near(&posture, margin + NEARBY, &mut near);
            demands.extend(
                near.iter().map(|near| {
                    (near.distance, near.slope.map(|slope| share * slope), margin - near.distance)
                }),
            );
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
            above: demands.into_iter().map(|(_, slope, bound)| (slope, bound)).collect(),
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
    fn merit(&self, way: &Trajectory) -> f64 {
        let mut short = 0.0f64;
        for point in 1..WATCHED {
            let s = f64::from(point) / f64::from(WATCHED);
            let (posture, margin) = (way.posture(s), self.margin.at(s) + BETWEEN);
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
    fn somewhere(&self, reach: &Trajectory, random: &mut Pcg64, attempt: u32) -> Posture {
        let middle = reach.posture(0.5);
        let joints = self.clearance.mechanism.joints();
        let share = (0.12 * f64::from(attempt)).min(0.9);
        let mut excursion = [0.0; 7];
        for _ in 0..DRAWS {
            let anywhere = anywhere(random, &self.limits, joints);
            excursion = std::array::from_fn(|joint| share * (anywhere[joint] - middle[joint]));
            let posture = std::array::from_fn(|joint| middle[joint] + excursion[joint]);
            if self.clearance.is_clear(&posture, self.margin.way) {
                break;
            }
        }
        excursion
    }

    fn refusal(&self, (share, near): &(f64, Near)) -> Refusal {
        let (bone, other) = self.clearance.names(near);
        Refusal::Way { bone, other, short: self.margin.at(*share) - near.distance, share: 100.0 * share }
    }
}

/// Cost of each metre by which a demand is not met, rad².
const PENALTY: f64 = 200.0;

fn reach(stages: &[Stage]) -> Option<Trajectory> {
    stages.iter().find(|stage| stage.kind == StageKind::Reach).map(|stage| stage.trajectory)
}
