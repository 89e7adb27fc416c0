use coact_period::cycles;
use std::time::Duration;

/// Whether the planner's thread goes on, by its heartbeat: its search beats at each posture that it looks at, so that a long
/// search is alive and one that hangs is not.
#[derive(Debug, Default)]
pub(crate) struct PlannerWatch {
    beats: u64,
    /// Cycles in which it owed an answer, and did not beat.
    still: u64,
}

/// A planner that owes an answer and has not beaten in so many cycles hangs. Counted are control's own cycles: while the whole
/// machine stands still, so does the count. A trade-off: the longest that a search was seen to go without a beat is some
/// milliseconds, a busy machine keeps an ordinary thread from its core for some 100, and until a hang is found the robot does
/// not move.
const HANGS_AFTER: u64 = cycles(Duration::from_millis(700));
/// One that would go on, but does not get its core, is waited for so long: another process would get it no sooner. Chosen by hand, as
/// the supervisor's.
const STARVED_AFTER: u64 = cycles(Duration::from_secs(10));
/// One that is silent is looked at this often: it takes some system calls. The first look, long before one that hangs is told from one that
/// waits for its core, is what the next one compares with.
const LOOK_EVERY: Duration = Duration::from_millis(100);

impl PlannerWatch {
    /// Looks once in each cycle. `owes`: there is a query that has no answer yet; `beats`: of the heartbeat, so far.
    pub fn look(&mut self, owes: bool, beats: u64) {
        let goes_on = !owes || beats != self.beats;
        self.still = if goes_on { 0 } else { self.still.saturating_add(1) };
        self.beats = beats;
    }

    /// Whether the planner hangs. `starves` says whether it would go on but for the machine, and hardly has since it was last asked, some time
    /// ago; it is asked only about one that is silent.
    pub fn hangs(&self, starves: impl FnOnce(Duration) -> bool) -> bool {
        if self.still == 0 || !self.still.is_multiple_of(cycles(LOOK_EVERY)) {
            return false;
        }
        let starves = starves(LOOK_EVERY);
        self.still >= HANGS_AFTER && (self.still >= STARVED_AFTER || !starves)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a planner hangs after so many cycles, that beats as given.
    fn hangs(cycles: u64, owes: bool, beats: impl Fn(u64) -> u64) -> bool {
        let mut watch = PlannerWatch::default();
        (0..cycles).for_each(|cycle| watch.look(owes, beats(cycle)));
        watch.hangs(|_| false)
    }

    #[test]
    fn one_that_owes_an_answer_and_does_not_beat_hangs_after_a_while() {
        assert!(!hangs(HANGS_AFTER, true, |_| 9) && hangs(HANGS_AFTER + 1, true, |_| 9));
    }

    #[test]
    fn a_long_search_and_one_that_is_idle_do_not_hang() {
        assert!(!hangs(100 * HANGS_AFTER, true, |cycle| 9 + cycle / (HANGS_AFTER - 1)));
        assert!(!hangs(100 * HANGS_AFTER, false, |_| 9));
    }

    #[test]
    fn one_that_gets_no_core_is_waited_for_but_not_for_ever() {
        let mut watch = PlannerWatch::default();
        let mut hung = Vec::new();
        for cycle in 0..=STARVED_AFTER {
            watch.look(true, 9);
            if watch.hangs(|_| true) {
                hung.push(cycle);
            }
        }
        assert_eq!(hung, [STARVED_AFTER]);
    }

    #[test]
    fn what_it_has_computed_before_it_fell_silent_does_not_count() {
        let (mut watch, mut looks) = (PlannerWatch::default(), 0);
        // As its thread tells it: at the first look all that it has ever computed is new.
        let hung = (0..2 * HANGS_AFTER).any(|_| {
            watch.look(true, 9);
            watch.hangs(|_| {
                looks += 1;
                looks > 1
            })
        });
        assert!(!hung && looks > 1);
    }

    #[test]
    fn the_count_begins_anew_with_each_beat() {
        let mut watch = PlannerWatch::default();
        for beats in 1..5 {
            (0..HANGS_AFTER).for_each(|_| watch.look(true, beats));
            assert!(!watch.hangs(|_| false));
        }
    }
}
