//! The real-time shell around the stages: ports, cycles, deadlines, memory, and resuming after a crash.
//!
//! A service's `main` loads what it needs as a [`Candidate`], joins the run as a [`Process`], opens its ports on the [`Bus`], and
//! hands a [`Cycle`] to [`Process::run_cycles`]. That waits for each period's release or for the arrival of the input, calls the stage, which
//! publishes, and counts deadline misses, stale inputs and skipped cycles. The counters leave the process in its
//! [`Pulse`](coact_messages::Pulse).
//!
//! Each message is judged by its reader before a stage sees it ([`Judge`], [`Plausible`](coact_messages::Plausible)); what is
//! not good is ignored and counted ([`Refusals`]).
//!
//! Ports work without a process, too. Messages are written and read in place, in the shared memory of one run:
//!
//! ```
//! use coact_messages::{Pulse, topic};
//! use coact_period::PERIOD_NS;
//! use coact_pipeline::{Ready, Run, RunSettings};
//! use coact_realtime::{Bus, Input, Output, Schedule, now};
//!
//! let run = Run::create(RunSettings::default())?;
//! // Seven periods ago the run began, and this program reported that it is the process "fields" of it.
//! let schedule = Schedule { start_ns: now() - 7 * PERIOD_NS };
//! run.start(schedule.start_ns)?;
//! run.report_ready(&Ready { process: "fields".into(), pid: std::process::id(), ..Ready::default() })?;
//!
//! let bus = Bus::open(&run, "fields", 0)?;
//! let mut output: Output<Pulse> = bus.output(&topic::pulse("fields"))?;
//! let mut input: Input<Pulse> = bus.input(&topic::pulse("fields"))?;
//! let mut pulse = output.loan()?;
//! pulse.released_ns = schedule.release(7);
//! pulse.missed = 2;
//! pulse.refused_topic = coact_messages::NONE;
//! pulse.send(7, now())?;
//!
//! assert!(input.refresh()?, "something newer has come");
//! let newest = input.latest().ok_or("no message")?;
//! assert_eq!((newest.header.cycle, newest.missed), (7, 2));
//! assert_eq!(schedule.tick_at(newest.released_ns), 7);
//! # drop((input, output, bus));
//! run.remove()?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod any_topic;
mod arguments;
mod background_thread;
mod bus;
mod candidate;
mod checkpoint;
mod checkpoint_store;
mod cycle;
mod cycle_accounting;
mod drop_outs;
mod each_topic;
mod executor;
mod handles;
mod heartbeat;
mod hung_thread;
mod input;
mod judge;
mod late_wake_up;
mod latency_probe;
mod loan;
mod log_style;
mod memory_lock;
mod message;
mod monotonic_clock;
mod origin;
mod output;
mod overload;
mod owner_watch;
mod pending_fault;
mod place;
mod places;
mod port;
mod port_error;
mod process;
mod process_error;
mod refusals;
mod requested_fault;
mod reservation;
mod run_node;
mod run_view;
mod schedule;
mod scheduling;
mod scheduling_class;
mod signals;
mod stand_in;
mod tick;
mod topic_anchors;
mod verdict;
mod wake_up_lateness;
mod zero_copy_reader;
mod zero_copy_writer;

pub use arguments::Arguments;
pub use background_thread::BackgroundThread;
pub use bus::Bus;
pub use candidate::Candidate;
pub use checkpoint_store::CheckpointStore;
pub use cycle::Cycle;
pub use drop_outs::DropOuts;
pub use handles::handles_left;
pub use heartbeat::Heartbeat;
pub use hung_thread::{HUNG_THREAD, end_for_hung_thread};
pub use input::Input;
pub use judge::Judge;
pub use late_wake_up::LateWakeUp;
pub use latency_probe::LatencyProbe;
pub use loan::Loan;
pub use log_style::LogStyle;
pub use message::Message;
pub use monotonic_clock::{monotonic_time, now, thread_time};
pub use origin::Origin;
pub use output::Output;
pub use place::Place;
pub use port_error::PortError;
pub use process::Process;
pub use process_error::ProcessError;
pub use refusals::Refusals;
pub use requested_fault::RequestedFault;
pub use reservation::Reservation;
pub use schedule::Schedule;
pub use scheduling::exclude_real_time_cores;
pub use scheduling_class::SchedulingClass;
pub use stand_in::StandIn;
pub use tick::Tick;
pub use topic_anchors::TopicAnchors;
pub use verdict::Verdict;
pub use wake_up_lateness::WakeUpLateness;
