//! What the monitor finds in messages made by hand, and what it writes.

mod anticipation;
mod faults;
mod joint_motion;
mod latencies;
mod process_counters;
mod report;
mod snapshot_log;
mod support;
mod timeline;
mod waits;
