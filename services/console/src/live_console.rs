use crate::page_partner::PagePartner;
use coact_console::{Board, Cadence, LiveTopics, Machine, PictureMaker, Timeline, Wish, report};
use coact_realtime::{Process, Schedule, now};
use coact_run_records::Summary;
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

/// How often the run is looked at: often enough for all pulses, and for a hand that is to be passed on at once.
const LOOK_EVERY: Duration = Duration::from_millis(4);
/// How often it is looked into the logs, and what the machine does is told anew.
const READ_EVERY: Duration = Duration::from_millis(200);
const TELL_EVERY: Duration = Duration::from_secs(1);
/// How long the console waits for the monitor's summary at the end: less than the process table gives it.
const SUMMARY_WITHIN: Duration = Duration::from_millis(4500);
/// How long pages have then to take in how it ended.
const FAREWELL: Duration = Duration::from_millis(300);

/// What is shown of a run, and done in it.
pub struct LiveConsole {
    pub topics: LiveTopics,
    pub maker: PictureMaker,
    pub timeline: Timeline,
    pub machine: Machine,
    pub board: Arc<Board>,
    pub partner: PagePartner,
    pub schedule: Schedule,
    /// From one picture to the next.
    pub every: Duration,
}

impl LiveConsole {
    /// Follows the run until it ends.
    pub fn follow(&mut self, process: &mut Process, wishes: &Receiver<Wish>) -> anyhow::Result<()> {
        let mut heartbeat = process.heartbeat()?;
        let [mut picture, mut read, mut told] = [self.every, READ_EVERY, TELL_EVERY].map(Cadence::new);
        while !process.stop_requested() {
            heartbeat.beat()?;
            self.topics.refresh(&mut self.machine)?;
            let seen = self.topics.seen();
            self.timeline.watch(&seen);
            let cycle = self.schedule.tick_at(now());
            match wishes.recv_timeout(LOOK_EVERY.min(self.partner.hand_due_in())) {
                Ok(wish) => self.partner.take(wish, cycle)?,
                Err(RecvTimeoutError::Timeout) => (),
                // Nobody is served any more.
                Err(RecvTimeoutError::Disconnected) => std::thread::sleep(LOOK_EVERY),
            }
            wishes.try_iter().try_for_each(|wish| self.partner.take(wish, cycle))?;
            self.partner.show_hand(self.maker.task(), &seen, cycle)?;
            if picture.is_due()
                && let Some(glimpse) = self.maker.glimpse(&seen)
            {
                self.board.put_glimpse(glimpse);
            }
            if read.is_due() {
                self.timeline.read_logs()?;
                self.board.put_events(self.timeline.events());
            }
            if told.is_due() {
                self.board.put_machine(&self.machine.to_json(cycle));
            }
            process.warn_of_refusals();
        }
        Ok(())
    }

    /// Tells all pages how the run has ended, once the monitor has said so.
    pub fn say_how_it_ended(&mut self, folder: &Path) -> anyhow::Result<()> {
        let begin = Instant::now();
        while !folder.join(Summary::FILE).is_file() && begin.elapsed() < SUMMARY_WITHIN {
            std::thread::sleep(LOOK_EVERY);
        }
        // A log that cannot be read must not hide how it ended.
        if let Err(error) = self.timeline.read_logs() {
            tracing::warn!("{error}");
        }
        self.board.put_events(self.timeline.events());
        let cycle = self.topics.seen().cycle().unwrap_or_default();
        self.board.put_end(&report(folder, cycle, self.timeline.errors()));
        std::thread::sleep(FAREWELL);
        Ok(())
    }
}
