use crate::mutator::Mutator;
use crate::{Bounds, Failure, Target, seeds};
use rustix::time::{ClockId, clock_gettime};
use std::backtrace::Backtrace;
use std::cell::{Cell, RefCell};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Once;
use std::time::Instant;

/// What a target was given.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Exercised {
    /// How many inputs.
    pub inputs: u64,
    /// How many of them it took in.
    pub taken: u64,
    /// Most memory that one of them took at a time, bytes.
    pub memory: u64,
    /// Most time of the processor that one of them took, s.
    pub processor: f64,
}

/// Gives a target all of its seeds, then seeds with random changes, until the time is over.
///
/// # Errors
/// The first input with which it panics, takes longer or takes more memory than it may, and the first good seed that it
/// refuses. What overflows the stack or never ends, ends the program: whoever calls this says before which target it is.
pub fn exercise(target: &Target, bounds: &Bounds) -> Result<Exercised, Failure> {
    keep_words_of_panics();
    let seeds = seeds(target);
    let mut seen = Exercised::default();
    // What a target makes once, at its first input, is no cost of that input.
    let _ = outcome(target, &[]);
    for seed in &seeds {
        let taken = seen.run(target, &seed.bytes, bounds)?;
        if seed.good && !taken {
            let problem = format!("refuses its own seed {}", seed.path.display());
            return Err(Failure { target: target.name, problem, input: seed.bytes.clone() });
        }
    }
    let mut mutator = Mutator::new(target.input, seeds, bounds);
    let begin = Instant::now();
    while begin.elapsed().as_secs_f64() < bounds.seconds {
        seen.run(target, &mutator.next(), bounds)?;
    }
    Ok(seen)
}

impl Exercised {
    fn run(&mut self, target: &Target, input: &[u8], bounds: &Bounds) -> Result<bool, Failure> {
        let failure = |problem| Failure { target: target.name, problem, input: input.to_vec() };
        let (mut taken, begin) = (Ok(false), processor_seconds());
        let used = allocation_counter::measure(|| taken = outcome(target, input));
        let (memory, processor) = (used.bytes_max, processor_seconds() - begin);
        let taken = taken.map_err(failure)?;
        if memory > bounds.memory {
            return Err(failure(format!("takes {} MiB", memory >> 20)));
        }
        if processor > bounds.processor {
            return Err(failure(format!("takes {processor:.1} s of the processor")));
        }
        self.inputs += 1;
        self.taken += u64::from(taken);
        self.memory = self.memory.max(memory);
        self.processor = self.processor.max(processor);
        Ok(taken)
    }
}

/// Time of the processor that this thread has used, s.
fn processor_seconds() -> f64 {
    let used = clock_gettime(ClockId::ThreadCPUTime);
    used.tv_sec as f64 + used.tv_nsec as f64 * 1e-9
}

thread_local! {
    /// Whether this thread runs a target now, and what the last panic in one said.
    static RUNS: Cell<bool> = const { Cell::new(false) };
    static SAID: RefCell<String> = const { RefCell::new(String::new()) };
}

/// Whether the target takes the input in, or what it says when it panics.
fn outcome(target: &Target, input: &[u8]) -> Result<bool, String> {
    RUNS.set(true);
    let outcome = catch_unwind(AssertUnwindSafe(|| (target.run)(input)));
    RUNS.set(false);
    outcome.map_err(|_| SAID.take())
}

/// From now on panics of targets are not printed but kept, with their places.
fn keep_words_of_panics() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let usual = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |panic| match RUNS.get() {
            // The trace is there when RUST_BACKTRACE is set.
            true => SAID.set(format!("{panic}\n{}", Backtrace::capture())),
            false => usual(panic),
        }));
    });
}
