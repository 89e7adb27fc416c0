use crate::queue::{QueueIn, queue};
use crate::storage::Storage;
use crate::{Gaps, Sources, Topics, recording_file};
use anyhow::Context;
use coact_realtime::{PortError, Process, ProcessError, Schedule, now};
use coact_run_recording::{Origin, RecordingError, RecordingWriter};
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, sync_channel};
use std::time::{Duration, SystemTime};

/// How long the rest of the queue may take to be written when the run ends: less than the process table gives the recorder.
const END_WITHIN: Duration = Duration::from_secs(4);

/// A recording that is being made.
pub struct Recorder {
    topics: Topics,
    gaps: Gaps,
    queue: QueueIn,
    /// What became of the file, once that is known.
    outcome: Receiver<Result<u64, RecordingError>>,
    path: PathBuf,
    /// It was said already that messages are lost.
    warned: bool,
}

impl Recorder {
    /// Begins a thread that makes the file and writes it. Nothing waits for the disk: messages come already.
    ///
    /// # Errors
    /// The system grants no thread.
    pub fn begin(
        process: &Process,
        schedule: Schedule,
        sources: Sources,
        topics: Topics,
    ) -> Result<Self, ProcessError> {
        let settings = process.run().settings();
        let path = recording_file(&settings.report, process.generation());
        let origin = Origin {
            settings: settings.clone(),
            files: sources.files.clone(),
            generation: process.generation(),
            start_ns: schedule.start_ns,
            clock_offset_ns: clock_offset_ns(),
            version: Origin::VERSION.to_owned(),
            code: Origin::CODE.to_owned(),
        };
        let ((queue, out), (tell, outcome)) = (queue(), sync_channel(1));
        let file = path.clone();
        process.spawn_background("storage", move || {
            let writer = RecordingWriter::create(&file, &origin);
            let outcome = writer.and_then(|writer| Storage::new(writer, &origin, &sources).run(&out));
            if let Err(error) = &outcome {
                tracing::warn!("{error}; nothing more is recorded");
            }
            tell.send(outcome).ok();
        })?;
        Ok(Self { topics, gaps: Gaps::new(process.generation() == 0), queue, outcome, path, warned: false })
    }

    /// Records what has come since the last look.
    ///
    /// # Errors
    /// [`PortError`].
    pub fn look(&mut self) -> Result<(), PortError> {
        let Self { topics, gaps, queue, .. } = self;
        topics.drain(gaps, &mut |message| queue.put(message))?;
        if !self.warned && !self.gaps.lost().is_empty() {
            self.warned = true;
            tracing::warn!("messages are lost: {}", lost(&self.gaps));
        }
        Ok(())
    }

    /// Writes the end of the file.
    ///
    /// # Errors
    /// It cannot be written, or not in time.
    pub fn finish(self) -> anyhow::Result<()> {
        let Self { gaps, queue, outcome, path, .. } = self;
        let said = lost(&gaps);
        queue.end(gaps.lost().clone());
        let written =
            outcome.recv_timeout(END_WITHIN).context("the disk is too slow: the end is missing")??;
        let told = format!("{}: {written} messages recorded; lost: {said}", path.display());
        match gaps.lost().is_empty() {
            true => tracing::info!("{told}"),
            false => tracing::warn!("{told}"),
        }
        Ok(())
    }
}

/// What wall clock time is more than `CLOCK_MONOTONIC`, ns.
fn clock_offset_ns() -> u64 {
    let wall = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
    (wall.map_or(0, |since| since.as_nanos()) as u64).saturating_sub(now())
}

/// In words, how many messages were lost.
fn lost(gaps: &Gaps) -> String {
    if gaps.lost().is_empty() {
        return "none".to_owned();
    }
    let counts = gaps.lost().iter().map(|(topic, count)| format!("{count} of {topic}"));
    counts.collect::<Vec<_>>().join(", ")
}
