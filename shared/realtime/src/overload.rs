use coact_period::{CYCLES_PER_SECOND, PERIOD_NS};

/// So many cycles in a row that each compute for longer than a period are too many. Chosen by hand: cycles of five periods
/// keep the stages of the same core from their work for 50 ms, half of what an outage may last.
const TOO_MANY: u64 = 10;
/// So many cycles within a period show that the machine can do them: on one that never could, to replace the process would
/// help nobody. Chosen by hand: those of a tenth of a second, so that a run is protected almost from its start.
const PROVEN: u64 = CYCLES_PER_SECOND / 10;

/// Notices that a stage which was fast enough is so no more, and keeps the others from their core.
#[derive(Debug, Default)]
pub(crate) struct Overload {
    within: u64,
    beyond: u64,
    /// What the thread had computed after the last cycle, ns; none when that was within its period, and nobody asked.
    computed_ns: Option<u64>,
}

impl Overload {
    /// Counts a cycle that lasted so long, ns. One that the thread itself computed for longer than a period is its own fault, not
    /// that of others who had the core: `thread_time` tells what it has computed so far, ns, and is asked only where it matters,
    /// for it costs a system call. True when the stage is to be replaced.
    pub(crate) fn is_reached(&mut self, lasted_ns: u64, thread_time: impl FnOnce() -> u64) -> bool {
        let now = (lasted_ns > PERIOD_NS).then(thread_time);
        let before = std::mem::replace(&mut self.computed_ns, now);
        let computed = now.zip(before).map_or(0, |(now, before)| now - before);
        if computed > PERIOD_NS {
            self.beyond += 1;
        } else {
            self.within += 1;
            self.beyond = 0;
        }
        self.beyond >= TOO_MANY && self.within >= PROVEN
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A stage whose thread computes.
    #[derive(Default)]
    struct Stage {
        overload: Overload,
        computed_ns: u64,
    }

    impl Stage {
        fn proven() -> Self {
            let mut stage = Self::default();
            assert!((0..PROVEN).all(|_| !stage.cycle(PERIOD_NS, PERIOD_NS)));
            stage
        }

        fn cycle(&mut self, lasted_ns: u64, computed_ns: u64) -> bool {
            self.computed_ns += computed_ns;
            self.overload.is_reached(lasted_ns, || self.computed_ns)
        }
    }

    const LONG: u64 = 2 * PERIOD_NS;

    #[test]
    fn a_stage_that_computes_too_long_again_and_again_is_overloaded() {
        let mut stage = Stage::proven();
        assert!((0..TOO_MANY).all(|_| !stage.cycle(LONG, LONG)));
        assert!(stage.cycle(LONG, LONG));
    }

    #[test]
    fn one_that_others_keep_from_its_core_is_not_nor_one_that_is_late_once_in_a_while() {
        let mut stage = Stage::proven();
        assert!((0..100).all(|_| !stage.cycle(LONG, PERIOD_NS / 2)));
        assert!((1..100).all(|cycle| !stage.cycle(if cycle % TOO_MANY == 0 { 1 } else { LONG }, LONG)));
    }

    #[test]
    fn on_a_machine_that_was_never_fast_enough_nobody_is() {
        let mut stage = Stage::default();
        assert!((0..10_000).all(|_| !stage.cycle(LONG, LONG)));
    }
}
