//! Movements planned as people plan them: first the posture at the end, then the direct movement to it, and only when
//! something is in the way an excursion through a second posture. (Planning in posture space after Rosenbaum;
//! the chapter's robot moves so.)
//!
//! ```text
//! where the hand shall be -> Target  posture at the goal, nearest to the present one, within limits, clear of all
//!                         -> Way     direct movement on which the hand goes as straight as it can, or the smallest
//!                                    excursion that keeps clear
//!                         -> Plan    leave, reach and approach as one movement: the hand's speed rises and falls once
//! ```
//!
//! Lengths m, angles rad, times s, world frame with z up. Planning allocates and takes milliseconds: it runs beside
//! a servo, never in its cycle.
//!
//! ```no_run
//! use coact_motion::{Goal, MinClearance, Mechanism, Problem, Scene};
//! use coact_robot::{HandGoal, MotionState, Robot};
//!
//! let robot = Robot::load("rt-config/robots/aros.toml".as_ref())?;
//! let mechanism = Mechanism::of(&robot)?;
//! let collision_model = mechanism.collision_model(&|_| 0.8)?;
//! let part = nalgebra::Isometry3::translation(-0.4, 0.55, 0.8);
//! let plan = Problem {
//!     mechanism: &mechanism,
//!     collision_model: &collision_model,
//!     scene: &Scene::default(),
//!     start: robot.park.map(MotionState::at_rest),
//!     leave: None,
//!     goal: Goal::Hand(vec![HandGoal::grip(&part, 0.04, 0, 0.15, 0.8)]),
//!     next_displacements: Vec::new(),
//!     insertion_depth: 0.0,
//!     min_clearance: MinClearance::default(),
//! }
//! .plan()?;
//! println!("{:.2} s", plan.duration());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bell;
mod capsule;
mod choice;
mod clearance;
mod collision_geometry;
mod collision_model;
mod comfort;
mod detour;
mod frames;
mod guide;
mod hand_path;
mod link;
mod mechanism;
mod obstacle;
mod plan;
mod planner;
mod quadratic;
mod refusal;
mod roughness;
mod route;
mod scene;
mod search;
mod segment;
mod segment_kind;
mod segment_motion;
mod solid;
mod solver;
mod straight;
mod target;
mod way;
mod work;

pub use capsule::Capsule;
pub use clearance::{Clearance, Counterpart, Proximity};
pub use collision_model::CollisionModel;
pub use detour::path_exists;
pub use hand_path::HandPath;
pub use link::Link;
pub use mechanism::{MAX_JOINTS, Mechanism, Meshes};
pub use obstacle::Obstacle;
pub use plan::{Knot, Plan, state_at};
pub use planner::{Goal, MinClearance, Problem};
pub use refusal::Refusal;
pub use scene::Scene;
use segment::Segment;
pub use segment_kind::SegmentKind;
use segment_motion::SegmentMotion;
pub use solid::Solid;
pub use target::Target;
