use coact_run_records::OutageReport;

/// Counts the cycles in which something that is due once a period was missing.
///
/// Whoever reports tells up to which cycle, and how many of the cycles since the last report had a timely good output.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub struct Outage {
    /// The next cycle that is not accounted for.
    due: u64,
    without: u64,
    /// Length of the run of cycles without output at the end, and the cycle of the last good output before it.
    run: u64,
    last_good: u64,
    longest: u64,
    longest_from: u64,
}

impl Outage {
    /// Accounts for all cycles up to `cycle`: `good` of them had an output, `cycle` itself if `ends_good`. Returns how many
    /// had none.
    ///
    /// Where single cycles are not known, those without output count as one run: the longest that it may have been.
    pub fn report(&mut self, cycle: u64, good: u64, ends_good: bool) -> u64 {
        let new = (cycle + 1).saturating_sub(self.due);
        let without = new.saturating_sub(good);
        self.due += new;
        self.without += without;
        self.run += without;
        if self.run > self.longest {
            (self.longest, self.longest_from) = (self.run, self.last_good);
        }
        if new > 0 && ends_good {
            (self.run, self.last_good) = (0, cycle);
        }
        without
    }

    /// The account of a run in which `due` cycles were due: those that nobody reported had no output.
    pub fn until(mut self, due: u64) -> OutageReport {
        if let Some(last) = due.checked_sub(1) {
            self.report(last, 0, false);
        }
        OutageReport {
            due: self.due,
            without_output: self.without,
            longest: self.longest,
            longest_from_ms: self.longest_from,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cycle_is_missing_until_a_good_output_comes_however_long_nobody_reports() {
        let mut outage = Outage::default();
        (0..100).for_each(|cycle| assert_eq!(outage.report(cycle, 1, true), 0));
        assert_eq!(outage.report(350, 1, true), 250);
        (351..400).for_each(|cycle| assert_eq!(outage.report(cycle, 1, true), 0));
        let expected = OutageReport { due: 400, without_output: 250, longest: 250, longest_from_ms: 99 };
        assert_eq!(outage.until(400), expected);
    }

    #[test]
    fn an_output_that_never_came_again_is_missing_until_the_end() {
        let mut outage = Outage::default();
        outage.report(4999, 5000, true);
        let ten_seconds =
            OutageReport { due: 15_000, without_output: 10_000, longest: 10_000, longest_from_ms: 4999 };
        assert_eq!(outage.until(15_000), ten_seconds);
        assert_eq!(Outage::default().until(7).without_output, 7);
    }

    #[test]
    fn late_outputs_belong_to_the_run_that_the_next_good_one_ends() {
        let mut outage = Outage::default();
        outage.report(0, 1, true);
        for late in 1..=3 {
            outage.report(late, 0, false);
        }
        outage.report(6, 1, true);
        outage.report(7, 0, false);
        let expected = OutageReport { due: 8, without_output: 6, longest: 5, longest_from_ms: 0 };
        assert_eq!(outage.until(8), expected);
    }

    #[test]
    fn a_cycle_that_is_reported_twice_counts_once() {
        let mut outage = Outage::default();
        outage.report(9, 10, true);
        assert_eq!(outage.report(9, 1, true), 0);
        assert_eq!(outage.report(3, 0, false), 0);
        assert_eq!(outage.until(10).without_output, 0);
    }
}
