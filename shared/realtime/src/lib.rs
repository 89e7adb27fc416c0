//! The real-time shell around the stages: ports, cycles, deadlines, memory, and going on after a crash.
//!
//! A service's `main` opens its [`Process`], its ports on the [`Bus`], and hands a [`Cycle`] to [`Process::run`]:
//! that waits for each period's release or the arrival of the input, calls the stage, publishes, and keeps accounts.

mod accounts;
mod arguments;
mod bus;
mod clock;
mod cycle;
mod executor;
mod held;
mod input;
mod keeper;
mod loan;
mod memory;
mod message;
mod output;
mod port_error;
mod process;
mod process_error;
mod scheduling;
mod signals;
mod witness;

pub use arguments::Arguments;
pub use bus::Bus;
pub use clock::{Schedule, now};
pub use cycle::{Cycle, Tick};
pub use held::Held;
pub use input::Input;
pub use keeper::Keeper;
pub use loan::Loan;
pub use message::Message;
pub use output::Output;
pub use port_error::PortError;
pub use process::Process;
pub use process_error::ProcessError;
pub use scheduling::keep_off_real_time_cores;
pub use witness::{Punctuality, Witness};
