use coact_motion::{Clearance, Goal, HandPath, Plan, Problem, SegmentKind};

/// How a planned movement looks from outside.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Quality {
    /// Time that it takes, s.
    pub duration_s: f64,
    /// The same over the shortest time in which its path can be followed whatever the jerk: see [`Plan::shortest`].
    pub over_shortest: f64,
    /// Length of the hand's path, m.
    pub path_m: f64,
    /// Largest speed of the hand, m/s.
    pub peak_speed: f64,
    /// Movement units: rises and falls of the hand's speed.
    pub units: u32,
    /// sqrt(1/2 integral of jerk² x T⁵ / L²) of the hand's path; 19 for a straight movement of minimum jerk.
    pub normalised_jerk: f64,
    /// Distance of the grasp point from its goal at the end, m; 0 for a posture.
    pub position_error: f64,
    /// Smallest clearance on the reaches, m (leaving and approaching must come near things); at most [`FAR`].
    pub clearance: f64,
}

/// Distances beyond this are not told apart, m: far beyond any clearance that is required.
pub const FAR: f64 = 0.3;
/// Samples of a movement, 1/s, and how many there are at least. Chosen by hand: fine against a rise and fall of speed,
/// which takes several tenths of a second.
const RATE: f64 = 500.0;
const LEAST_SAMPLES: f64 = 8.0;
/// Steps of each reach at whose ends clearance is measured. Chosen by hand: twice as many as the planner checks.
const CHECKED: u32 = 200;

impl Quality {
    /// Of a plan for this problem.
    pub fn of(problem: &Problem, plan: &Plan) -> Self {
        let path = path(problem, plan);
        Self {
            duration_s: plan.duration(),
            over_shortest: plan.duration() / plan.shortest,
            path_m: path.length(),
            peak_speed: path.speed.iter().copied().fold(0.0, f64::max),
            units: path.units(),
            normalised_jerk: path.normalised_jerk(),
            position_error: position_error(problem, plan),
            clearance: clearance(problem, plan),
        }
    }
}

/// The path of the hand in a plan.
pub fn path(problem: &Problem, plan: &Plan) -> HandPath {
    let count = (plan.duration() * RATE).ceil().max(LEAST_SAMPLES) as usize;
    HandPath::of(problem.mechanism, plan, count)
}

fn position_error(problem: &Problem, plan: &Plan) -> f64 {
    let (Goal::Hand(goals), Some(target)) = (&problem.goal, &plan.target) else { return 0.0 };
    let grasp = problem.mechanism.arm.palm(&plan.end()) * problem.mechanism.grasp_point();
    (grasp - goals[target.goal].point).norm()
}

/// Smallest clearance on the reaches.
fn clearance(problem: &Problem, plan: &Plan) -> f64 {
    let Problem { mechanism, collision_model, scene, .. } = *problem;
    let clearance = Clearance { mechanism, collision_model, scene, segment: SegmentKind::Reach };
    let ends = plan.segments.iter().map(|(_, end)| *end);
    let begins = std::iter::once(0.0).chain(ends);
    let reaches = plan.segments.iter().zip(begins).filter(|((kind, _), _)| *kind == SegmentKind::Reach);
    reaches
        .flat_map(|((_, end), begin)| {
            (0..=CHECKED).map(move |step| begin + (end - begin) * f64::from(step) / f64::from(CHECKED))
        })
        .map(|t| plan.at(t).map(|state| state.position))
        .filter_map(|posture| clearance.nearest(&posture, FAR))
        .map(|near| near.distance)
        .fold(FAR, f64::min)
}
