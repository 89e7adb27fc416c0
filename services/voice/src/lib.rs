//! Says what the robot is about to do, and why.
//!
//! [`Voice`] watches the fields. Once the robot's decision (or a detected error) has stood for a while, it
//! composes a sentence from the task's own names: the goal that was inferred, what the robot does about it by its
//! motor skill, and what is wrong and what could be done instead. It knows no task and no finished sentence. [`Standstill`] says what an arm
//! waits for that stands on its way.

mod clauses;
mod meanings;
mod speaker;
mod standstill;
mod voice;

pub use meanings::{Goal, Meanings, Mistake};
pub use speaker::Speaker;
pub use standstill::Standstill;
pub use voice::{Sentence, Voice};
