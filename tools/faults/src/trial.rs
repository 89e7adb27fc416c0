use crate::evidence::Evidence;
use crate::private_mounts::Filler;
use crate::record::Record;
use crate::running_set::{POLL, RunningSet};
use crate::stranger::Stranger;
use crate::viewer::Viewer;
use crate::{Cell, FaultKind, MessageFault, Moment, Setup, Target, Trouble};
use coact_period::cycles;
use coact_realtime::{Schedule, now};
use coact_run_records::{Event, LogFollower, MotionReport};
use coact_supervisor::{Fault, request_fault};
use rustix::process::Signal;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::time::{Duration, Instant};

/// A run in which faults are done one after another.
pub(crate) struct Trial<'a> {
    setup: &'a Setup,
    set: RunningSet,
    viewer: Option<Viewer>,
}

/// Longest wait for a moment: in an assembly of a minute most come several times, but a robot that always finds something to do stands
/// at its park posture in one of several assemblies.
const MOMENT_WITHIN: Duration = Duration::from_secs(240);
/// From this cycle on stages are known to be fast enough, and one that is not any more is replaced (it takes a second), and spares
/// are loaded. Before it a run still starts.
const SETTLED: u64 = cycles(Duration::from_millis(1500));
/// Longest start of a set.
const STARTED_WITHIN: Duration = Duration::from_secs(40);
/// Longest wait for a replacement: what is not needed is restarted after pauses of two seconds at most.
const REPLACED_WITHIN: Duration = Duration::from_secs(15);
/// What may live on after a fault shows within this time whether it does: longer than every watchdog's limit.
const SURVIVES_WITHIN: Duration = Duration::from_millis(1500);
/// From the recovery to the next fault: the arm has come to rest or goes on, and the monitor has written the fault down.
const SETTLES_WITHIN: Duration = Duration::from_millis(700);
/// So long a stranger sends.
const SPOOFED: Duration = Duration::from_millis(300);
/// Longest wait for the next subgoal after all faults.
const GOES_ON_WITHIN: Duration = Duration::from_secs(90);
/// The samples of a dead set have ended when none came for so long.
const SILENCE: Duration = Duration::from_millis(300);
/// So long there is no room for the report: longer than it takes the monitor to write what it has.
const REPORT_FULL: Duration = Duration::from_secs(6);
/// So long a supervisor gets no file handles.
const STARVED: Duration = Duration::from_millis(500);
/// So long a set has no supervisor: longer than it takes until the arm stands.
const ORPHANED: Duration = Duration::from_secs(2);
/// Longest wait for a successor.
const ADOPTED_WITHIN: Duration = Duration::from_secs(15);
/// How long the second set lives.
const SECOND_SET_S: &str = "2";

impl<'a> Trial<'a> {
    /// Does the faults of these cells in one run, and returns what it left.
    ///
    /// # Errors
    /// There was no run, or it left nothing that can be read: none of the cells can be judged.
    pub(crate) fn run(
        setup: &'a Setup,
        cells: &[Cell],
    ) -> Result<(Vec<Record>, Evidence, RunningSet), Trouble> {
        let (private, adoptable) = (FaultKind::fills, |fault| fault == FaultKind::Adoption);
        let any = |is: fn(FaultKind) -> bool| cells.iter().any(|cell| is(cell.fault));
        let set = RunningSet::launch(setup, any(private), any(adoptable))?;
        let mut trial = Self { setup, set, viewer: None };
        let records = trial.perform_all(cells);
        let start_ns = trial.set.run().start_ns().ok().flatten();
        if records.iter().all(|record| record.trouble.is_none()) {
            trial.wait_for_progress(&records, start_ns);
        }
        let evidence = trial.finish(cells, start_ns)?;
        Ok((records, evidence, trial.set))
    }

    /// Whichever cell's moment comes first is done first.
    fn perform_all(&mut self, cells: &[Cell]) -> Vec<Record> {
        let mut left: Vec<_> = cells.iter().collect();
        let mut records = Vec::new();
        while !left.is_empty() {
            if let Some(viewer) = &mut self.viewer {
                viewer.begin();
            }
            match self.wait_for_any(&left) {
                Ok(index) => records.push(self.perform(left.remove(index))),
                Err(trouble) => {
                    let missed = |cell: &Cell| Record::of(cell, Some(Trouble(trouble.0.clone())));
                    records.extend(left.drain(..).map(missed));
                }
            }
        }
        records
    }

    fn perform(&mut self, cell: &Cell) -> Record {
        let mut record = Record::of(cell, None);
        if let Err(trouble) = self.attempt(&mut record) {
            record.trouble = Some(trouble);
        }
        record.until_ns = now();
        record.motion = self.viewer.as_ref().map_or_else(MotionReport::default, Viewer::motion);
        record
    }

    /// Index of the first cell whose moment has come.
    fn wait_for_any(&mut self, cells: &[&Cell]) -> Result<usize, Trouble> {
        if let Some(index) = cells.iter().position(|cell| cell.moment == Moment::StartUp) {
            self.wait_for_start_of(cells[index].target.processes()[0])?;
            return Ok(index);
        }
        self.wait_for_start()?;
        // The end of the run comes last, from a movement.
        let is_over = cells.iter().all(|cell| cell.moment == Moment::Shutdown);
        let (schedule, begin) = (self.schedule()?, Instant::now());
        while begin.elapsed() < MOMENT_WITHIN {
            self.look()?;
            let sight = self.viewer.as_ref().map(Viewer::sight).unwrap_or_default();
            let tick = schedule.tick_at(now());
            let has_come = |cell: &&Cell| match cell.moment {
                Moment::Shutdown => is_over && Moment::Moving.is_at(&sight),
                moment => moment.is_at(&sight) && is_possible(cell.fault, tick),
            };
            if let Some(index) = cells.iter().position(has_come) {
                return Ok(index);
            }
            if self.set.has_ended() {
                return Err(Trouble("the set had ended already".into()));
            }
        }
        let moments: BTreeSet<_> = cells.iter().map(|cell| cell.moment.name()).collect();
        let moments = moments.into_iter().collect::<Vec<_>>().join(" or ");
        Err(Trouble(format!("the robot was not {moments} within {} s", MOMENT_WITHIN.as_secs())))
    }

    /// Its moment has come.
    fn attempt(&mut self, record: &mut Record) -> Result<(), Trouble> {
        let cell = record.cell.clone();
        if cell.moment == Moment::Shutdown {
            self.set.signal(Signal::INT)?;
        }
        let generations = self.generations(&cell);
        record.from_ns = now();
        self.strike(&cell)?;
        match cell.moment {
            Moment::Shutdown => Ok(()),
            _ if cell.fault.ends_the_set() || cell.kills_supervisor() => self.watch_the_end(),
            Moment::StartUp => self.wait_for_start().or(Ok(())),
            _ => self.wait_for_recovery(&cell, &generations, record),
        }
    }

    /// Looks once, and pauses until the next look.
    fn look(&mut self) -> Result<bool, Trouble> {
        let came = match &mut self.viewer {
            Some(viewer) => viewer.look()?,
            None => false,
        };
        std::thread::sleep(POLL);
        Ok(came)
    }

    fn look_for(&mut self, time: Duration) -> Result<(), Trouble> {
        let begin = Instant::now();
        while begin.elapsed() < time {
            self.look()?;
        }
        Ok(())
    }

    /// Until the run's clock runs; the viewer joins before it does.
    fn wait_for_start(&mut self) -> Result<(), Trouble> {
        let begin = Instant::now();
        while self.set.run().start_ns().ok().flatten().is_none() {
            if self.set.has_ended() || begin.elapsed() > STARTED_WITHIN {
                return Err(Trouble("the run did not begin".into()));
            }
            self.join_when_possible();
            self.look()?;
        }
        if self.viewer.is_none() {
            self.viewer = Some(Viewer::join(self.set.run(), self.setup)?);
        }
        Ok(())
    }

    /// The topics exist as soon as a process is ready.
    fn join_when_possible(&mut self) {
        if self.viewer.is_none() && self.set.run().ready("monitor", 0).is_ok_and(|ready| ready.is_some()) {
            self.viewer = Viewer::join(self.set.run(), self.setup).ok();
        }
    }

    fn wait_for_start_of(&mut self, process: &str) -> Result<(), Trouble> {
        let begin = Instant::now();
        while self.set.pid_of(process).is_none() {
            if begin.elapsed() > STARTED_WITHIN {
                return Err(Trouble(format!("{process} was not started")));
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        match self.set.run().start_ns().ok().flatten() {
            None => Ok(()),
            Some(_) => Err(Trouble("the run had begun already".into())),
        }
    }

    fn schedule(&self) -> Result<Schedule, Trouble> {
        let start_ns = self.set.run().start_ns().ok().flatten();
        Ok(Schedule { start_ns: start_ns.ok_or_else(|| Trouble("the run has no clock".into()))? })
    }

    /// How often each process that is struck has been restarted.
    fn generations(&mut self, cell: &Cell) -> BTreeMap<&'static str, u32> {
        let events = self.set.events();
        let newest = |process: &'static str| {
            let of_it = events.iter().filter(|event| event.process == process);
            (process, of_it.map(|event| event.generation).max().unwrap_or(0))
        };
        cell.struck().into_iter().map(newest).collect()
    }

    fn strike(&mut self, cell: &Cell) -> Result<(), Trouble> {
        match cell.fault {
            FaultKind::Nothing => self.look_for(SURVIVES_WITHIN),
            FaultKind::Process(fault) => self.injure(cell, fault),
            FaultKind::Message(fault) => self.spoof(cell.target.processes()[0], fault),
            FaultKind::ViewerFlood => self.flood(cell.target.processes()[0]),
            FaultKind::MemoryFull => {
                let filler = Filler::fill(Path::new("/dev/shm"), || self.look().map(drop))?;
                self.request(cell.target.processes()[0], Fault::Kill)?;
                self.look_for(SURVIVES_WITHIN)?;
                drop(filler);
                Ok(())
            }
            FaultKind::ReportFull => {
                let folder = self.set.folder().to_owned();
                let filler = Filler::fill(&folder, || self.look().map(drop))?;
                self.look_for(REPORT_FULL)?;
                drop(filler);
                Ok(())
            }
            FaultKind::SecondSet => self.start_second_set(),
            FaultKind::Adoption => self.adopt(),
            FaultKind::PlantedRun => self.plant(),
        }
    }

    fn injure(&mut self, cell: &Cell, fault: Fault) -> Result<(), Trouble> {
        let by_signal = matches!(cell.moment, Moment::StartUp | Moment::Shutdown);
        if cell.target == Target::Supervisor {
            return self.injure_supervisor(fault);
        }
        if let (Target::Two(starved, killed), Fault::NoHandles) = (&cell.target, fault) {
            self.request(starved, Fault::NoHandles)?;
            return self.request(killed, Fault::Kill);
        }
        for process in cell.target.processes() {
            match by_signal {
                true => self.set.signal_process(process, signal_of(fault))?,
                false => self.request(process, fault)?,
            }
        }
        Ok(())
    }

    /// Through the supervisor, which notes what was injected.
    fn request(&mut self, process: &str, fault: Fault) -> Result<(), Trouble> {
        let refused = Trouble::because("the supervisor refused");
        request_fault(self.set.run(), process, fault.name()).map_err(|error| refused(&error))
    }

    fn injure_supervisor(&mut self, fault: Fault) -> Result<(), Trouble> {
        let pause = match fault {
            Fault::StopShort => Duration::from_millis(50),
            Fault::Stop => Duration::from_secs(2),
            Fault::NoHandles => return self.starve_supervisor(),
            fault => return self.set.signal(signal_of(fault)),
        };
        self.set.signal(Signal::STOP)?;
        let looked = self.look_for(pause);
        self.set.signal(Signal::CONT)?;
        looked
    }

    /// The supervisor gets no file handles for a while, in which a process dies that has to be replaced.
    fn starve_supervisor(&mut self) -> Result<(), Trouble> {
        let before = self.set.limit_handles(0)?;
        let died = self.set.signal_process(Cell::WHILE_STARVED, Signal::KILL);
        let looked = self.look_for(STARVED);
        self.set.limit_handles(before)?;
        died.and(looked)
    }

    fn spoof(&mut self, process: &str, fault: MessageFault) -> Result<(), Trouble> {
        let schedule = self.schedule()?;
        let stranger = Stranger::join(self.set.run())?;
        let mut send = stranger.spoofs(process, fault)?;
        let begin = Instant::now();
        while begin.elapsed() < SPOOFED {
            send(schedule.tick_at(now()))?;
            self.look()?;
        }
        Ok(())
    }

    fn flood(&mut self, process: &str) -> Result<(), Trouble> {
        let stranger = Stranger::join(self.set.run())?;
        let places = stranger.flood()?;
        self.request(process, Fault::Kill)?;
        // The viewers stay while the replacement is started.
        self.look_for(SURVIVES_WITHIN)?;
        drop(places);
        Ok(())
    }

    fn start_second_set(&mut self) -> Result<(), Trouble> {
        let failed = |error: std::io::Error| Trouble::because("no second set was started")(&error);
        let report = self.set.report().with_file_name("second-report");
        let mut command = std::process::Command::new(&self.setup.coact);
        command.arg("launch").arg("--report").arg(report).args(["--duration", SECOND_SET_S]);
        command.args(["--world", "kinematic"]).stdout(std::process::Stdio::null());
        let mut second = command.stderr(std::process::Stdio::null()).spawn().map_err(failed)?;
        while second.try_wait().map_err(failed)?.is_none() {
            self.look()?;
        }
        Ok(())
    }

    /// Kills the supervisor; when the arm stands, a successor adopts the set.
    fn adopt(&mut self) -> Result<(), Trouble> {
        self.set.orphan()?;
        self.look_for(ORPHANED)?;
        self.set.adopt(self.setup)?;
        let begin = Instant::now();
        while self.set.run().owner().is_ok_and(|owner| owner.generation == 0) {
            if self.set.has_ended() || begin.elapsed() > ADOPTED_WITHIN {
                return Err(Trouble("nobody adopted the set".into()));
            }
            self.look()?;
        }
        Ok(())
    }

    /// Puts a copy of the run's description where a dead run of another name would lie, and has the dead removed.
    fn plant(&mut self) -> Result<(), Trouble> {
        let failed = |error: std::io::Error| Trouble::because("no run directory was planted")(&error);
        let directory = self.set.run().directory().to_owned();
        let planted = directory.with_file_name(format!("coact_{}-planted", self.set.run().id()));
        std::fs::create_dir(&planted).map_err(failed)?;
        let copied = std::fs::copy(directory.join("run.json"), planted.join("run.json"));
        let locked = std::fs::write(planted.join("lock"), "");
        coact_pipeline::Run::remove_dead();
        std::fs::remove_dir_all(&planted).or_else(|error| match error.kind() {
            // It was taken for what a dead run left.
            std::io::ErrorKind::NotFound => Ok(()),
            _ => Err(failed(error)),
        })?;
        copied.and(locked).map_err(failed)
    }

    fn wait_for_recovery(
        &mut self,
        cell: &Cell,
        generations: &BTreeMap<&'static str, u32>,
        record: &mut Record,
    ) -> Result<(), Trouble> {
        let limit = if cell.fault.may_be_survived() { SURVIVES_WITHIN } else { REPLACED_WITHIN };
        let limit = limit + cell.fault.lasts();
        let begin = Instant::now();
        while begin.elapsed() < limit && record.resumed.len() < generations.len() {
            self.look()?;
            for (process, generation) in generations {
                // A replacement may itself be struck, and the next one be the first that is ready.
                let ready = (1..=3).find_map(|next| self.set.run().ready(process, generation + next).ok()?);
                record.resumed.extend(ready.map(|ready| (*process, ready.resumed)));
            }
            if generations.is_empty() {
                break;
            }
        }
        self.look_for(SETTLES_WITHIN)
    }

    /// Until no samples come any more.
    fn watch_the_end(&mut self) -> Result<(), Trouble> {
        let (begin, mut last) = (Instant::now(), Instant::now());
        while last.elapsed() < SILENCE && begin.elapsed() < REPLACED_WITHIN {
            // What cannot be read any more has ended.
            if self.look().unwrap_or(false) {
                last = Instant::now();
            }
        }
        Ok(())
    }

    /// Until the next subgoal is achieved, where the run is to go on; whether it was, is judged by the event log.
    fn wait_for_progress(&mut self, records: &[Record], start_ns: Option<u64>) {
        let Some((start_ns, last)) = start_ns.zip(records.last()) else { return };
        let cell = &last.cell;
        if cell.fault.ends_the_set() || cell.kills_supervisor() || cell.moment == Moment::Shutdown {
            return;
        }
        let after_ms = last.until_ns.saturating_sub(start_ns) / 1_000_000;
        let is_later = |event: &Event| matches!(event, Event::Subgoal { at_ms, .. } if *at_ms >= after_ms);
        let mut events = LogFollower::<Event>::new(&self.set.report());
        let begin = Instant::now();
        while begin.elapsed() < GOES_ON_WITHIN && !self.set.has_ended() {
            // What cannot be read is found when the run is judged.
            if events.news().unwrap_or_default().iter().any(is_later) || self.look().is_err() {
                return;
            }
        }
    }

    fn finish(&mut self, cells: &[Cell], start_ns: Option<u64>) -> Result<Evidence, Trouble> {
        if !cells.iter().any(|cell| cell.moment == Moment::Shutdown) {
            // It may have ended already.
            self.set.signal(Signal::INT).ok();
        }
        let Self { set, viewer, .. } = self;
        // What cannot be read any more has ended.
        let ending = set.end(|| _ = viewer.as_mut().map(Viewer::look));
        let read = Evidence::read(&set.report()).map_err(|error| Trouble::because("the report")(&error))?;
        let last_speed = viewer.as_ref().map_or(0.0, |viewer| viewer.sight().speed);
        Ok(Evidence { ending, start_ns, last_speed, ..read })
    }
}

/// Whether the fault can be done in this cycle already.
fn is_possible(fault: FaultKind, tick: u64) -> bool {
    tick >= SETTLED && !matches!(fault, FaultKind::Message(fault) if tick < fault.possible_from())
}

/// The signal by which a fault strikes that needs nobody to listen.
fn signal_of(fault: Fault) -> Signal {
    match fault {
        Fault::Abort => Signal::ABORT,
        Fault::StopForGood => Signal::STOP,
        _ => Signal::KILL,
    }
}
