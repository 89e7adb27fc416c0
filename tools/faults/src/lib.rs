//! The fault matrix: what happens to whom, and when, on real process sets; and whether the robot stays safe and goes on.
//!
//! A [`Cell`] is a fault, a target and a moment. A [`Campaign`] does cells in real runs and judges each by what the run
//! left (its summary and logs, its exit status, what is left behind) and by what a viewer saw of the joints; never by what
//! the injector meant to do. A cell that cannot be judged is [`Outcome::Unknown`], never green.

mod campaign;
mod cell;
mod evidence;
mod fault_kind;
mod judge;
/// Which cells there are.
pub mod matrix;
mod matrix_report;
mod message_fault;
mod moment;
mod outcome;
mod page;
mod private_mounts;
mod record;
mod running_set;
mod selection;
mod setup;
mod stranger;
mod target;
mod trial;
mod trouble;
mod viewer;

pub use campaign::{Campaign, Step};
pub use cell::Cell;
pub use fault_kind::FaultKind;
pub use matrix_report::{MatrixReport, Row};
pub use message_fault::MessageFault;
pub use moment::{Moment, Sight};
pub use outcome::{JudgedCell, Outcome};
pub use page::page;
pub use selection::{Selection, UnknownSelection};
pub use setup::Setup;
pub use target::Target;
pub use trouble::Trouble;
