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
//! use coact_motion::{Aim, Margin, Mechanism, Problem, Scene};
//! use coact_robot::{HandGoal, MotionState, Robot};
//!
//! let robot = Robot::load("rt-config/robots/aros.toml".as_ref())?;
//! let mechanism = Mechanism::of(&robot)?;
//! let body = mechanism.body(&|_| 0.8)?;
//! let part = nalgebra::Isometry3::translation(-0.4, 0.55, 0.8);
//! let plan = Problem {
//!     mechanism: &mechanism,
//!     body: &body,
//!     scene: &Scene::default(),
//!     start: robot.park.map(MotionState::at_rest),
//!     leave: None,
//!     aim: Aim::Hand(vec![HandGoal::grip(&part, 0.04, 0, 0.15, 0.8)]),
//!     then: Vec::new(),
//!     guide: 0.0,
//!     margin: Margin::default(),
//! }
//! .plan()?;
//! println!("{:.2} s", plan.duration());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bell;
mod body;
mod capsule;
mod choice;
mod clearance;
mod comfort;
mod detour;
mod guide;
mod hand_path;
mod links;
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
mod solid;
mod solver;
mod stage;
mod straight;
mod target;
mod trajectory;
mod way;
mod work;
pub mod workplace;

pub use body::{Body, Bone};
pub use capsule::Capsule;
pub use clearance::{Clearance, Near, Other};
pub use detour::exists as way_exists;
pub use hand_path::HandPath;
pub use mechanism::{MAX_JOINTS, Mechanism, Meshes};
pub use obstacle::Obstacle;
pub use plan::{Knot, Plan, state_at};
pub use planner::{Aim, Margin, Problem};
pub use refusal::Refusal;
pub use scene::Scene;
pub use solid::Solid;
use stage::Stage;
pub use stage::StageKind;
pub use target::Target;
pub use trajectory::Trajectory;
