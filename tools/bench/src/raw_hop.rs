use crate::BenchError;
use crate::raw_port::{RawPort, become_like, prefix};
use coact_monitor::histogram;
use coact_pipeline::{Pipeline, ProcessEntry, Run};
use hdrhistogram::Histogram;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// A hop through iceoryx2 alone: one process publishes and notifies once a period ([`send_raw`](crate::send_raw)), another one
/// waits and receives, with the classes, the core and the payload of the chain's first hop.
#[derive(Debug)]
pub struct RawHop {
    /// How long messages took, ns.
    pub histogram: Histogram<u64>,
}

/// How long the receiver waits before it looks whether it is to end.
const LOOK_EVERY: Duration = Duration::from_millis(100);
/// Messages in which connections are made, and every slot is used for the first time.
const WARM_UP: u64 = 1000;

impl RawHop {
    /// Measures beside a run until it is over. `sender`, told the run's directory and a folder, is to call
    /// [`send_raw`](crate::send_raw) with them.
    ///
    /// # Errors
    /// [`BenchError::Port`], [`BenchError::Sender`].
    pub fn measure(
        run: &Run,
        pipeline: &Pipeline,
        sender: &mut Command,
        over: &AtomicBool,
    ) -> Result<Self, BenchError> {
        let folder = std::env::temp_dir().join(format!("coact-bench-{}", std::process::id()));
        let sender = sender.arg(run.directory()).arg(&folder).stdin(Stdio::piped());
        let mut sender = sender.spawn().map_err(BenchError::Sender)?;
        let receiver = pipeline.processes.iter().filter(|entry| entry.realtime).nth(1);
        // A thread of its own, so that the caller keeps its class.
        let measured = std::thread::scope(|scope| {
            let receiver = scope.spawn(|| receive(&folder, receiver, over));
            receiver.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        });
        let ended = end(&mut sender);
        // iceoryx2 leaves its count of nodes; what cannot be removed harms nobody.
        std::fs::remove_dir_all(&folder).ok();
        for entry in std::fs::read_dir("/dev/shm").into_iter().flatten().flatten() {
            if entry.file_name().to_string_lossy().starts_with(&prefix(&folder)) {
                std::fs::remove_file(entry.path()).ok();
            }
        }
        let histogram = measured?;
        ended.map(|()| Self { histogram })
    }
}

fn receive(
    folder: &Path,
    like: Option<&ProcessEntry>,
    over: &AtomicBool,
) -> Result<Histogram<u64>, BenchError> {
    let port = RawPort::open(folder, false)?;
    become_like(like);
    let (mut histogram, mut received) = (histogram(), 0);
    while !over.load(Ordering::Relaxed) {
        if let Some(took) = port.receive(LOOK_EVERY)? {
            received += 1;
            if received > WARM_UP {
                histogram.saturating_record(took);
            }
        }
    }
    Ok(histogram)
}

/// Its standard input ends, and so does it.
fn end(sender: &mut Child) -> Result<(), BenchError> {
    drop(sender.stdin.take());
    let status = sender.wait().map_err(BenchError::Sender)?;
    let failed = || BenchError::Port(format!("its sender ended with {status}"));
    status.success().then_some(()).ok_or_else(failed)
}
