//! Random tasks that person and robot can solve: for what the network holds on plans that nobody drew.
//!
//! A [`TaskShape`] and a seed make a [`RandomTask`]: kinds of parts, where they lie, and a partial order of subgoals. The parts are
//! put onto the table side by side and on top of each other, in *towers*; the words, grips and actions, and the table, are the
//! same in all of them. Solvable by construction: each step comes only after earlier ones, or after a choice between such, each kind has as many
//! parts as there are steps with it, and every way from one side to the other has an act.
//!
//! ```
//! use coact_random_task::{RandomTask, TaskShape};
//!
//! let shape = TaskShape::new(12, 4, 1.0 / 3.0)?;
//! let text = RandomTask::new(shape, 7).to_toml();
//! assert_eq!(text.matches("[[subgoal]]").count(), 12);
//! # Ok::<(), coact_random_task::ShapeError>(())
//! ```

mod choice;
mod places;
mod random_task;
mod shape_error;
mod subgoal;
mod task_shape;

pub use random_task::RandomTask;
pub use shape_error::ShapeError;
pub use task_shape::TaskShape;
