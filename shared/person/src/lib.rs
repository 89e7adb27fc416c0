//! The simulated partner: what a person means to do, and how the hand moves to do it.
//!
//! It shares nothing with what decodes people's movements: neither constant, template nor code of perception or of the
//! fields. Each tick it is shown its [`Surroundings`] as plain data and answers with a [`Manipulation`]: which part the
//! fingers grasped, moved or let go. What becomes of the part then is the world's business.
//!
//! [`Person`] does not change while it acts. All that changes is in [`PersonState`], plain words that can be stored in a
//! message and taken up again. The [`Policy`] says where its intentions come from.
//!
//! ```
//! use bytemuck::Zeroable;
//! use coact_joint_task::Task;
//! use coact_messages::PartState;
//! use coact_person::{ActivityPhase, Habits, PartsView, Person, PersonState, Policy, RobotHandView, Surroundings};
//! use coact_random::RandomStreams;
//! use std::path::Path;
//!
//! # let config = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config"));
//! let task = Task::load(&config.join("tasks/toy-vehicle.toml"))?;
//! let lying = |part: &coact_joint_task::Part| PartState {
//!     position: [part.at[0], part.at[1], task.scene.table_height],
//!     orientation: [0.0, 0.0, 0.0, 1.0],
//!     kind: part.kind as u32,
//!     ..PartState::default()
//! };
//! let parts: Vec<PartState> = task.parts.iter().map(lying).collect();
//!
//! let habits = Habits::load(&config.join("person.toml"), &task)?;
//! let person = Person::new(&task.scene, &habits, Policy::Synthetic, RandomStreams::new(1), None);
//! let mut state = PersonState::zeroed();
//! person.start(0, &mut state);
//! let mut tick = 0;
//! let grasped = loop {
//!     tick += 1;
//!     let (parts, robot) = (PartsView::new(&parts), RobotHandView::default());
//!     let around = Surroundings { tick, task: &task, parts, robot };
//!     if let Some(part) = person.advance(&mut state, &around).grasped {
//!         break part;
//!     }
//! };
//! assert_eq!(state.phase(), ActivityPhase::Dwell);
//! assert!(PartsView::new(&parts).centre(grasped, &task).distance(person.hand_centre(&state)) < 0.001);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod active_policy;
mod activity;
mod activity_phase;
mod arm_course;
mod contact_force;
mod deciding;
mod error;
mod fingers;
mod following_way;
mod habits;
mod hand_model;
mod hand_movement;
mod hand_pose;
mod handling;
mod hesitating;
mod hesitation;
mod intention;
mod line_of_sight;
mod live_carrying;
mod live_hand;
mod live_handling;
mod live_meaning;
mod manipulation;
mod movement_planning;
mod occluder;
mod parts_view;
mod person;
mod person_state;
mod policy;
mod random_behaviour;
mod random_policy;
mod reach_profile;
mod reach_turn;
mod recorded_arm;
mod recorded_hand;
mod recorded_reach;
mod recorded_reaches;
mod recorded_way;
mod recorded_ways;
mod robot_hand_view;
mod script;
mod spline;
mod surroundings;
mod synthetic_policy;
mod turning;
mod undoing;
mod variation;
mod waiting;

pub use activity::Activity;
pub use activity_phase::ActivityPhase;
pub use error::PersonError;
pub use habits::Habits;
pub use hand_model::{FOREARM, HandModel};
pub use hand_movement::HandMovement;
pub use hand_pose::HandPose;
pub use hesitation::Hesitation;
pub use intention::{Intention, Undertaking};
pub use line_of_sight::box_before;
pub use manipulation::Manipulation;
pub use parts_view::{Holder, PartsView};
pub use person::Person;
pub use person_state::PersonState;
pub use policy::Policy;
pub use random_behaviour::RandomBehaviour;
pub use reach_profile::FINGERS;
pub use reach_turn::ReachTurn;
pub use recorded_arm::RecordedArm;
pub use recorded_reaches::RecordedReaches;
pub use recorded_ways::RecordedWays;
pub use robot_hand_view::RobotHandView;
pub use script::{Due, Script, ScriptEntry, ScriptedAction};
pub use surroundings::Surroundings;
pub use variation::Variation;
