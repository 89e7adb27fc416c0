use crate::signals::Signals;
use crate::{Arguments, Bus, LogStyle, Process, ProcessError, memory_lock, scheduling};
use clap::Parser;
use coact_messages::topic;
use coact_pipeline::{GENERATION_VARIABLE, Pipeline, ProcessEntry, Run};
use std::io::Read;
use std::path::Path;

/// A process that has not joined its run yet: it knows the run, and has nothing of it open.
///
/// What takes long is done now, before [`Candidate::join`]: reading files, computing models. A *spare* is a candidate that the
/// supervisor has started ahead; its predecessor still runs, and it waits in `join` until that one has died.
#[derive(Debug)]
pub struct Candidate {
    run: Run,
    pipeline: Pipeline,
    entry: ProcessEntry,
    generation: u32,
    signals: Signals,
    is_spare: bool,
}

impl Candidate {
    /// A candidate for the run that the command line names, for the place of `name`, or of its standby; ends the program on bad
    /// usage.
    ///
    /// # Errors
    /// [`ProcessError`] says what about the run or its process table is wrong.
    pub fn from_arguments(name: &str) -> Result<Self, ProcessError> {
        let arguments = Arguments::parse();
        LogStyle::Process.log_to_stderr();
        let standby = arguments.standby.then(|| topic::standby(name));
        let name = match &standby {
            Some(Some(standby)) => standby,
            Some(None) => return Err(ProcessError::NoStandby { process: name.to_owned() }),
            None => name,
        };
        Self::new(name, &arguments.run, generation()?, arguments.spare)
    }

    /// A candidate for the run in `directory`, for the place of `name`, in its `generation`-th restart.
    ///
    /// # Errors
    /// As [`Candidate::from_arguments`].
    pub fn open(name: &str, directory: &Path, generation: u32) -> Result<Self, ProcessError> {
        Self::new(name, directory, generation, false)
    }

    fn new(name: &str, directory: &Path, generation: u32, is_spare: bool) -> Result<Self, ProcessError> {
        let signals = Signals::install().map_err(ProcessError::Signals)?;
        let run = Run::load(directory)?;
        let pipeline = Pipeline::of_run(run.settings())?;
        let entry = pipeline.process(name)?.clone();
        if entry.realtime && !is_spare {
            scheduling::prepare_start(entry.core);
        } else {
            scheduling::exclude_real_time_cores(&pipeline);
        }
        Ok(Self { run, pipeline, entry, generation, signals, is_spare })
    }

    /// The run that it is to take part in.
    pub fn run(&self) -> &Run {
        &self.run
    }

    /// How often the process has been restarted in this run.
    pub fn generation(&self) -> u32 {
        self.generation
    }

    /// Joins the run. A spare waits for its turn first, and ends the program when that never comes: when the supervisor needs it
    /// no more, or has died.
    ///
    /// # Errors
    /// [`ProcessError::Port`].
    pub fn join(self) -> Result<Process, ProcessError> {
        if self.is_spare {
            self.wait_for_turn();
        }
        let Self { run, pipeline, entry, generation, signals, .. } = self;
        let bus = Bus::open(&run, &entry.name, generation)?;
        Ok(Process::new(run, pipeline, entry, generation, bus, signals))
    }

    /// With all that it has loaded in memory.
    fn wait_for_turn(&self) {
        if self.entry.realtime {
            // Refused, it is reported as soon as it is ready.
            memory_lock::lock_on_fault().ok();
            memory_lock::populate();
        }
        if !matches!(std::io::stdin().read(&mut [0]), Ok(1)) {
            std::process::exit(0);
        }
        if self.entry.realtime {
            scheduling::prepare_start(self.entry.core);
        }
    }
}

fn generation() -> Result<u32, ProcessError> {
    let Ok(found) = std::env::var(GENERATION_VARIABLE) else { return Ok(0) };
    found.parse().map_err(|_| ProcessError::Generation { variable: GENERATION_VARIABLE, found })
}
