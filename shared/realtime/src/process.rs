use crate::executor::Executor;
use crate::owner_watch::OwnerWatch;
use crate::signals::Signals;
use crate::{
    BackgroundThread, Bus, Candidate, Cycle, DropOuts, Heartbeat, Message, Output, PortError, ProcessError,
    Schedule, SchedulingClass, StandIn, memory_lock, scheduling,
};
use coact_messages::{Refusal, topic};
use coact_pipeline::{Pipeline, ProcessEntry, ProcessStat, Ready, Run};
use rustix::process::Signal;
use std::io;
use std::panic::AssertUnwindSafe;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// How long a replacement waits for its predecessor's checkpoint before it begins anew. The supervisor publishes it before
/// it starts the replacement, and hands it over within some 2 ms: after half a second it never will. Chosen by hand.
const CHECKPOINT_TIMEOUT: Duration = Duration::from_millis(500);
/// How often a process that is ready looks whether the run has started. The supervisor announces the start some 50 ms
/// ahead, so that this delays nothing.
const START_POLL: Duration = Duration::from_millis(1);

/// A process of a set, from when it joins the run to its last cycle.
#[derive(Debug)]
pub struct Process {
    run: Run,
    pipeline: Pipeline,
    entry: ProcessEntry,
    generation: u32,
    bus: Bus,
    signals: Signals,
    resumed: bool,
    /// The reasons for ignoring messages that were warned of.
    warned: [bool; Refusal::COUNT],
}

impl Process {
    /// Joins the run that the command line names, as the process called `name`, or as its standby; ends the program on bad usage.
    /// What takes long to load is better loaded by a [`Candidate`].
    ///
    /// # Errors
    /// [`ProcessError`] says what about the run, its process table or its topics is wrong.
    pub fn from_arguments(name: &str) -> Result<Self, ProcessError> {
        Candidate::from_arguments(name)?.join()
    }

    pub(crate) fn new(
        run: Run,
        pipeline: Pipeline,
        entry: ProcessEntry,
        generation: u32,
        bus: Bus,
        signals: Signals,
    ) -> Self {
        let (resumed, warned) = (false, [false; Refusal::COUNT]);
        Self { run, pipeline, entry, generation, bus, signals, resumed, warned }
    }

    /// The run that it takes part in.
    pub fn run(&self) -> &Run {
        &self.run
    }

    /// The process table.
    pub fn pipeline(&self) -> &Pipeline {
        &self.pipeline
    }

    /// Its own entry in the process table.
    pub fn entry(&self) -> &ProcessEntry {
        &self.entry
    }

    /// How often it was restarted in this run.
    pub fn generation(&self) -> u32 {
        self.generation
    }

    /// Opens ports on the run's topics.
    pub fn bus(&self) -> &Bus {
        &self.bus
    }

    /// True once SIGTERM or SIGINT requested that it stops.
    pub fn stop_requested(&self) -> bool {
        self.signals.stop()
    }

    /// The output of a stage that may have a standby, or of that standby.
    ///
    /// # Errors
    /// [`PortError`].
    pub fn stand_in<T: Message>(&self, topic: &str) -> Result<StandIn<T>, PortError> {
        Ok(StandIn::new(self.bus.input(topic)?, self.bus.output(topic)?, self.entry.standby_of.is_some()))
    }

    /// The checkpoint of the predecessor that this process replaces: its last message. `output` goes on with its sequence.
    ///
    /// `None` in a first start, and when the predecessor left no checkpoint.
    ///
    /// # Errors
    /// [`PortError`].
    pub fn checkpoint<T: Message>(&mut self, output: &mut Output<T>) -> Result<Option<Box<T>>, PortError> {
        if self.generation == 0 {
            return Ok(None);
        }
        let checkpoint = self.bus.checkpoint::<T>(output.topic(), CHECKPOINT_TIMEOUT)?;
        if let Some(last) = &checkpoint {
            output.continue_after(last.header());
            self.resumed = true;
        }
        Ok(checkpoint)
    }

    /// Lets the process end in order when the supervisor dies: it is told to stop then (SIGTERM), where others are killed. In a
    /// set that can be adopted that holds until the process is ready.
    ///
    /// # Errors
    /// [`ProcessError::Signals`] when the system refuses.
    pub fn outlive_supervisor(&self) -> Result<(), ProcessError> {
        match has_supervisor()? {
            true => on_death_of_supervisor(Some(Signal::TERM)),
            false => Ok(()),
        }
    }

    /// In a set that can be adopted: the process no longer ends with the supervisor, but a while later, if nobody adopts the run.
    fn become_adoptable(&self) -> Result<(), ProcessError> {
        if self.pipeline.adoptable_for.is_zero() || !has_supervisor()? {
            return Ok(());
        }
        let member = self.run.become_member()?;
        let watch = OwnerWatch::new(&self.run, self.pipeline.adoptable_for, &self.entry, member);
        self.spawn_background("owner-watch", || watch.watch())?;
        on_death_of_supervisor(None)
    }

    /// Starts a thread for work that takes longer than a cycle. It is an ordinary thread, off the real-time cores where
    /// there are others, so that it never delays a cycle. It ends with the process.
    ///
    /// # Errors
    /// [`ProcessError::Thread`] when the system grants no thread.
    pub fn spawn_background(
        &self,
        name: &str,
        work: impl FnOnce() + Send + 'static,
    ) -> Result<BackgroundThread, ProcessError> {
        let pipeline = self.pipeline.clone();
        let thread = BackgroundThread::default();
        let own = thread.clone();
        let background = move || {
            own.begin();
            scheduling::become_ordinary(&pipeline);
            // A process whose background work died would wait for it for ever: it ends instead, and is replaced.
            if std::panic::catch_unwind(AssertUnwindSafe(work)).is_err() {
                std::process::abort();
            }
        };
        std::thread::Builder::new().name(name.to_owned()).spawn(background).map_err(ProcessError::Thread)?;
        Ok(thread)
    }

    /// Warns of the messages that its inputs have ignored, once for each reason. For processes without a pulse, which would
    /// carry the counts; never to be called on a real-time thread.
    pub fn warn_of_refusals(&mut self) {
        let counts = self.bus.refusals().counts();
        for (reason, (warned, count)) in Refusal::ALL.iter().zip(self.warned.iter_mut().zip(counts)) {
            if count > 0 && !*warned {
                *warned = true;
                let name =
                    topic::ALL.get(self.bus.refusals().topic() as usize).map_or("a topic", |own| own.name);
                tracing::warn!("a message of {name} is ignored: {}", reason.name());
            }
        }
    }

    /// Starts an ordinary thread on the process's own core that is idle from then on. The memory of a killed process is given back
    /// by whichever thread of it ends last, for milliseconds: by this one, in no real-time class, where others would wait for
    /// it. It ends last because it gets the core last; on another core it might end first. Of a replacement it prefaults the
    /// memory before.
    fn keep_last_thread(&self) -> Result<(), ProcessError> {
        let prefaults = self.generation > 0;
        let last = move || {
            if prefaults {
                memory_lock::populate_beside_cycles();
            }
            // Always granted.
            let _ = SchedulingClass::Other.apply();
            park();
        };
        std::thread::Builder::new().name("last".into()).spawn(last).map(drop).map_err(ProcessError::Thread)
    }

    /// Set once an injected fault requests that the background work stands still; the work itself does it.
    pub fn background_freezes(&self) -> Arc<AtomicBool> {
        self.signals.background_freezes()
    }

    /// Requests of injected faults that the sensors drop out; the process itself does that.
    pub fn drop_outs(&self) -> DropOuts {
        self.signals.drop_outs()
    }

    /// Becomes real time as far as the process table wants and the machine grants, and reports readiness; from then on the process
    /// can be adopted, if the table says so.
    ///
    /// The report says what was refused, and the supervisor shows that in red; the process runs all the same.
    ///
    /// # Errors
    /// [`ProcessError::Run`] when the report cannot be written; [`ProcessError::Thread`] or [`ProcessError::Signals`] when the
    /// system refuses.
    pub fn report_ready(&self) -> Result<(), ProcessError> {
        let lock = self.entry.realtime.then(|| match self.generation {
            0 => memory_lock::lock_and_prefault(),
            _ => memory_lock::lock_on_fault(),
        });
        let memory_locked = matches!(lock, Some(Ok(())));
        let mut why_not: Vec<_> = lock.and_then(Result::err).into_iter().collect();
        why_not.extend(scheduling::take_core(&self.entry).err());
        if self.entry.realtime {
            // Before any thread of it is of a real-time class.
            self.keep_last_thread()?;
        }
        why_not.extend(scheduling::take_class(&self.entry).err());
        let sentinel = if self.entry.realtime { start_sentinel()? } else { 0 };
        let mut ready = Ready {
            process: self.entry.name.clone(),
            generation: self.generation,
            pid: std::process::id(),
            // Without it, no successor of the supervisor takes the process for this one.
            started: ProcessStat::of(std::process::id()).map_or(0, |stat| stat.started),
            sentinel,
            scheduler: String::new(),
            priority: 0,
            core: None,
            memory_locked,
            why_not,
            resumed: self.resumed,
        };
        scheduling::report_obtained(&mut ready);
        self.run.report_ready(&ready)?;
        self.become_adoptable()
    }

    /// The sign of life of a process without cycles: to be begun when its loop begins, and to beat in each turn of it.
    ///
    /// # Errors
    /// [`ProcessError::Heartbeat`].
    pub fn heartbeat(&self) -> Result<Heartbeat, ProcessError> {
        Heartbeat::begin(&self.run.heartbeat_file(&self.entry.name)).map_err(ProcessError::Heartbeat)
    }

    /// Waits until the run starts; `None` when the process is to stop before.
    ///
    /// # Errors
    /// [`ProcessError::Run`].
    pub fn wait_for_start(&self) -> Result<Option<Schedule>, ProcessError> {
        while !self.stop_requested() {
            if let Some(start_ns) = self.run.start_ns()? {
                self.bus.start(start_ns);
                return Ok(Some(Schedule { start_ns }));
            }
            std::thread::sleep(START_POLL);
        }
        Ok(None)
    }

    /// Becomes real time, reports readiness, waits for the start of the run, and runs `cycle` in each period until a signal
    /// stops it.
    ///
    /// # Errors
    /// [`ProcessError`]; a port that failed ends the process.
    pub fn run_cycles(self, mut cycle: impl Cycle) -> Result<(), ProcessError> {
        let waits = crate::executor::waits_for_topic(&self.entry, cycle.trigger().topic())?;
        let pulse = self.bus.output(&topic::pulse(&self.entry.name))?;
        self.report_ready()?;
        let Some(schedule) = self.wait_for_start()? else { return Ok(()) };
        let Self { pipeline, entry, signals, bus, .. } = self;
        let ended =
            Executor::new(&entry, schedule, waits, pulse, bus.refusals().clone()).run(&mut cycle, &signals);
        // To say why it ends, with a trace of its calls, takes up to a tenth of a second, and others have cycles to do meanwhile.
        scheduling::become_ordinary(&pipeline);
        ended
    }
}

/// Whether the process was started by a supervisor, which has the kernel end it with itself. One that was started by hand has none,
/// and needs none.
fn has_supervisor() -> Result<bool, ProcessError> {
    let given = rustix::process::parent_process_death_signal().map_err(io::Error::from);
    Ok(given.map_err(ProcessError::Signals)?.is_some())
}

/// The signal that the kernel sends when the supervisor dies.
fn on_death_of_supervisor(signal: Option<Signal>) -> Result<(), ProcessError> {
    let set = rustix::process::set_parent_process_death_signal(signal);
    set.map_err(|error| ProcessError::Signals(error.into()))
}

/// Starts a thread of the caller's class that does nothing, and returns its id: killed, the process loses it at once.
fn start_sentinel() -> Result<u32, ProcessError> {
    let (tell, told) = std::sync::mpsc::sync_channel(1);
    let wait = move || {
        tell.send(rustix::thread::gettid().as_raw_nonzero().get().cast_unsigned()).ok();
        park();
    };
    std::thread::Builder::new().name("sentinel".into()).spawn(wait).map_err(ProcessError::Thread)?;
    // One that told nothing is none.
    Ok(told.recv().unwrap_or(0))
}

fn park() {
    loop {
        std::thread::park();
    }
}
