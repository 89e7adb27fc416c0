use crate::executor::Executor;
use crate::signals::Signals;
use crate::{Arguments, Bus, Cycle, Message, Output, PortError, ProcessError, Schedule, memory, scheduling};
use clap::Parser;
use coact_messages::topic;
use coact_pipeline::{GENERATION_VARIABLE, Pipeline, ProcessEntry, Ready, Run};
use std::panic::AssertUnwindSafe;
use std::path::Path;
use std::time::Duration;
use tracing_subscriber::EnvFilter;

/// How long a replacement waits for the offer of what its predecessor left, before it begins anew.
const SURVIVOR_WITHIN: Duration = Duration::from_millis(500);
/// How often a process that is ready looks whether the run has started.
const LOOK_AGAIN: Duration = Duration::from_millis(1);

/// A process of a set, from its command line to its last cycle.
#[derive(Debug)]
pub struct Process {
    run: Run,
    pipeline: Pipeline,
    entry: ProcessEntry,
    generation: u32,
    bus: Bus,
    signals: Signals,
    resumed: bool,
}

impl Process {
    /// Joins the run that the command line names, as the process called `name`; ends the program on bad usage.
    ///
    /// # Errors
    /// [`ProcessError`] says what about the run, its process table or its topics is wrong.
    pub fn from_arguments(name: &str) -> Result<Self, ProcessError> {
        let arguments = Arguments::parse();
        let filter = EnvFilter::try_from_default_env().unwrap_or_else(|_| EnvFilter::new("warn"));
        tracing_subscriber::fmt().with_env_filter(filter).with_writer(std::io::stderr).init();
        Self::open(name, &arguments.run, generation()?)
    }

    /// Joins the run in `directory` as the process called `name`, in its `generation`-th restart.
    ///
    /// # Errors
    /// As [`Process::from_arguments`].
    pub fn open(name: &str, directory: &Path, generation: u32) -> Result<Self, ProcessError> {
        let signals = Signals::install().map_err(ProcessError::Signals)?;
        let run = Run::load(directory)?;
        let pipeline = Pipeline::load(&run.settings().pipeline)?;
        let entry = pipeline.process(name)?.clone();
        if entry.realtime {
            scheduling::hurry(entry.core);
        } else {
            scheduling::keep_off_real_time_cores(&pipeline);
        }
        let bus = Bus::open(&run, name, generation)?;
        Ok(Self { run, pipeline, entry, generation, bus, signals, resumed: false })
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

    /// Its way into the run's topics.
    pub fn bus(&self) -> &Bus {
        &self.bus
    }

    /// True once it was asked to stop, by SIGTERM or SIGINT.
    pub fn stop_requested(&self) -> bool {
        self.signals.stop()
    }

    /// The last message of the predecessor that this process replaces, and `output` counts on from it.
    ///
    /// `None` in a first start, and when nothing survived.
    ///
    /// # Errors
    /// [`PortError`].
    pub fn survivor<T: Message>(&mut self, output: &mut Output<T>) -> Result<Option<Box<T>>, PortError> {
        if self.generation == 0 {
            return Ok(None);
        }
        let survivor = self.bus.survivor::<T>(output.topic(), SURVIVOR_WITHIN)?;
        if let Some(last) = &survivor {
            output.continue_after(last.header());
            self.resumed = true;
        }
        Ok(survivor)
    }

    /// Starts a thread for work that takes longer than a cycle: of the ordinary class, and off the real-time cores where
    /// there are others, so that it never holds up a cycle. It ends with the process.
    ///
    /// # Errors
    /// [`ProcessError::Thread`] when the system grants no thread.
    pub fn work_beside(&self, name: &str, work: impl FnOnce() + Send + 'static) -> Result<(), ProcessError> {
        let pipeline = self.pipeline.clone();
        let beside = move || {
            scheduling::step_aside(&pipeline);
            // A process whose work beside the cycle died would wait for it for ever: it ends, and is replaced.
            if std::panic::catch_unwind(AssertUnwindSafe(work)).is_err() {
                std::process::abort();
            }
        };
        std::thread::Builder::new().name(name.to_owned()).spawn(beside).map_err(ProcessError::Thread)?;
        Ok(())
    }

    /// Goes real time as far as the process table asks and the machine grants, and reports readiness.
    ///
    /// What was refused stands in the report, which the supervisor shows in red; the process runs all the same.
    ///
    /// # Errors
    /// [`ProcessError::Run`] when the report cannot be written.
    pub fn report_ready(&self) -> Result<(), ProcessError> {
        let lock = if self.entry.realtime { memory::settle() } else { Err(String::new()) };
        let memory_locked = lock.is_ok();
        let mut why_not: Vec<_> = lock.err().into_iter().filter(|reason| !reason.is_empty()).collect();
        why_not.extend(scheduling::request(&self.entry));
        let mut ready = Ready {
            process: self.entry.name.clone(),
            generation: self.generation,
            pid: std::process::id(),
            scheduler: String::new(),
            priority: 0,
            core: None,
            memory_locked,
            why_not,
            resumed: self.resumed,
        };
        scheduling::obtained(&mut ready);
        Ok(self.run.report_ready(&ready)?)
    }

    /// Waits until the run starts; `None` when the process was asked to stop before.
    ///
    /// # Errors
    /// [`ProcessError::Run`].
    pub fn wait_for_start(&self) -> Result<Option<Schedule>, ProcessError> {
        while !self.stop_requested() {
            if let Some(start_ns) = self.run.start_ns()? {
                return Ok(Some(Schedule { start_ns, period_ns: self.pipeline.period_ns() }));
            }
            std::thread::sleep(LOOK_AGAIN);
        }
        Ok(None)
    }

    /// Goes real time, reports readiness, waits for the start of the run, and runs `cycle` in each period until it
    /// is asked to stop.
    ///
    /// # Errors
    /// [`ProcessError`]; a port that failed ends the process.
    pub fn run_cycles(self, mut cycle: impl Cycle) -> Result<(), ProcessError> {
        let waits = crate::executor::waits_for_topic(&self.entry, cycle.trigger().topic())?;
        let pulse = self.bus.output(&topic::pulse(&self.entry.name))?;
        self.report_ready()?;
        let Some(schedule) = self.wait_for_start()? else { return Ok(()) };
        let Self { pipeline, entry, signals, .. } = self;
        Executor::new(&pipeline, &entry, schedule, waits, pulse).run(&mut cycle, &signals)?;
        Ok(())
    }
}

fn generation() -> Result<u32, ProcessError> {
    let Ok(found) = std::env::var(GENERATION_VARIABLE) else { return Ok(0) };
    found.parse().map_err(|_| ProcessError::Generation { variable: GENERATION_VARIABLE, found })
}
