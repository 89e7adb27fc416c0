//! Motion planning in posture space (after Rosenbaum et al., Psychol. Rev. 108, 2001): first the posture at the goal, then
//! the direct movement to it, and only where something is in the way a movement through a second posture, the bounce
//! posture. The hand moves as people's hands do where that costs little time: on a nearly straight path, its speed rising and falling once.
//!
//! ```text
//! Problem       where from, where to, among what, with which clearance
//!  -> Target     a posture at the goal: nearest to the present one, within the limits, clear (inverse kinematics)
//!  -> Waypoints  the postures to be passed, and the fraction of the duration between them; no duration yet
//!  -> Segment    leave, reach or approach: a movement of all joints in its own time; the reach may have a bounce
//!  -> Plan       the trajectory: knots in time, which quintics join; as fast as joints and hand may be
//! ```
//!
//! Only [`Problem`], [`Target`] and [`Plan`] are public. [`Problem::plan`] makes *attempts*, each through given waypoints,
//! and returns the quickest plan that is clear and within the limits, or the [`Refusal`] that says which constraint
//! binds. Whoever carries a plan out keeps its knots ([`coact_robot::Knot`]) and asks for [`coact_robot::state_at`] an instant. A [`Scene`] holds the
//! obstacles, a [`CollisionModel`] the forms of the robot, and [`Clearance`] the distances between them.
//!
//! Lengths in m, angles in rad, times in s, world frame with z up. Planning allocates and takes milliseconds: it runs
//! beside a servo, never in its cycle. The same problem has the same plan on every machine.
//!
//! # Example
//! The robot of this repository moves its hand over a table, past a pillar.
//!
//! ```
//! use coact_motion::{Clearance, Goal, Mechanism, Obstacle, Problem, Scene, SegmentKind, Solid};
//! use coact_robot::{HandGoal, MotionState, Robot};
//! use nalgebra::{Isometry3, Vector3};
//!
//! let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config/robots/aros.toml");
//! let robot = Robot::load(file.as_ref())?;
//! let mechanism = Mechanism::of(&robot)?;
//! let open_hand = robot.hand.posture(1.2);
//! let collision_model = mechanism.with_fingers(&robot.hand, &open_hand)?;
//!
//! let pillar = Solid::Cylinder { radius: 0.03, height: 0.6 };
//! let table = Solid::Box(Vector3::new(1.0, 1.2, 0.04));
//! let scene = Scene {
//!     obstacles: vec![
//!         Obstacle::new("pillar", pillar, &Isometry3::translation(-0.45, 0.45, 1.0)),
//!         Obstacle::new("table", table, &Isometry3::translation(-0.7, 0.3, 0.68)),
//!     ],
//!     ..Scene::default()
//! };
//!
//! // A grip from above, for something 40 mm high that stands on the table.
//! let part = Isometry3::translation(-0.55, 0.25, 0.7);
//! let goal = Goal::Hand(vec![HandGoal::grip(&part, 0.04, 0, 0.15, 0.7)]);
//! let start = robot.park.map(MotionState::at_rest);
//! let problem = Problem::new(&mechanism, &collision_model, &scene, start, goal);
//! let plan = problem.plan()?;
//! assert!(plan.duration() < 4.0);
//! assert_eq!(plan.broken(&mechanism.limits()), None);
//!
//! // Half-way, the arm is clear of everything.
//! let posture = plan.at(0.5 * plan.duration()).map(|state| state.position);
//! let clearance = Clearance {
//!     mechanism: &mechanism,
//!     collision_model: &collision_model,
//!     scene: &scene,
//!     segment: SegmentKind::Reach,
//! };
//! assert!(clearance.nearest(&posture, 0.002).is_none());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod attempt;
mod blend;
mod bounce_search;
mod budget;
mod capsule;
mod clearance;
mod collision_geometry;
mod collision_model;
mod frames;
mod goal;
mod hand_path;
mod hand_speed_limits;
mod incumbent;
mod line_constraint;
mod link;
mod measured_path;
mod mechanism;
mod mesh_file;
mod min_clearance;
mod minimum_jerk_spline;
mod moving_capsules;
mod numerical_ik;
mod obstacle;
mod path_bounds;
mod plan;
mod posture_cost;
mod problem;
mod proximity;
mod quadratic_program;
mod refusal;
mod rrt_connect;
mod scene;
mod search;
mod search_heartbeat;
mod segment;
mod segment_check;
mod segment_kind;
mod segment_motion;
mod shortest_time;
mod smoothing;
mod solid;
mod target;
mod target_search;
mod time_optimal_scaling;
mod time_scaling;
mod waypoints;

pub use capsule::Capsule;
pub use clearance::Clearance;
pub use collision_model::CollisionModel;
pub use goal::Goal;
pub use hand_path::HandPath;
pub use hand_speed_limits::HandSpeedLimits;
pub use link::Link;
pub use mechanism::{MAX_JOINTS, Mechanism, Meshes};
pub use min_clearance::MinClearance;
pub use moving_capsules::MovingCapsules;
pub use obstacle::Obstacle;
pub use plan::Plan;
pub use problem::Problem;
pub use proximity::{Counterpart, Proximity};
pub use refusal::Refusal;
pub use rrt_connect::path_exists;
pub use scene::Scene;
pub use search_heartbeat::SearchHeartbeat;
use segment::Segment;
pub use segment_kind::SegmentKind;
use segment_motion::SegmentMotion;
pub use shortest_time::shortest_time;
pub use solid::Solid;
pub use target::Target;
