//! The real-time shell around the stages: ports, cycles, deadlines, memory, and going on after a crash.
//!
//! A service's `main` opens its [`Process`], its ports on the [`Bus`], and hands a [`Cycle`] to [`Process::run`]:
//! that waits for each period's release or the arrival of the input, calls the stage, publishes, and keeps accounts.

mod bus;
mod clock;
mod held;
mod input;
mod keeper;
mod loan;
mod message;
mod output;
mod port_error;

pub use bus::Bus;
pub use clock::{Schedule, now};
pub use held::Held;
pub use input::Input;
pub use keeper::Keeper;
pub use loan::Loan;
pub use message::Message;
pub use output::Output;
pub use port_error::PortError;
