//! How punctual the pipeline is, beside what the machine itself and iceoryx2 alone take at the same time.
//!
//! A real set runs under a [`Load`], and each process of its chain is killed once a minute ([`kills`]). The monitor measures it, as
//! in any run, and so it does an idle thread of the same priority (the latency probe). Beside them a [`RawHop`] sends the same
//! payload through iceoryx2 alone, and [`SlowCycles`] keeps the slowest cycles from the pulses. A [`LatencyReport`] is what comes of
//! it; [`page`] draws it.
//!
//! Beside that, [`random_faults`] strike stages of a set that never gives up; a [`RecoveryReport`] counts what that cost.
//!
//! ```
//! use coact_bench::{Load, kills};
//! use std::time::Duration;
//!
//! assert_eq!("memory".parse(), Ok(Load::Memory));
//! let chain = ["world", "fields"].map(str::to_owned);
//! let at: Vec<_> = kills(&chain, Duration::from_secs(60)).iter().map(|kill| kill.at.as_secs()).collect();
//! assert_eq!(at, [20, 40], "each once a minute, one after the other");
//! ```

mod bench_error;
mod kills;
mod latency_report;
mod load;
mod page;
mod random_faults;
mod raw_hop;
mod raw_port;
mod raw_sender;
mod readers_outage;
mod recovery_report;
mod running_load;
mod slow_cycle;
mod slow_cycles;

pub use bench_error::BenchError;
pub use kills::kills;
pub use latency_report::{LatencyReport, Measured};
pub use load::Load;
pub use page::page;
pub use random_faults::random_faults;
pub use raw_hop::RawHop;
pub use raw_sender::send_raw;
pub use readers_outage::{MissedCycles, ReadersOutage};
pub use recovery_report::{Recovery, RecoveryReport};
pub use running_load::RunningLoad;
pub use slow_cycle::{SlowCycle, StageTimes};
pub use slow_cycles::SlowCycles;
