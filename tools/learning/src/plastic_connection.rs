/// How often somebody who demonstrates a task does a step before one that it needs, by mistake. Chosen by hand: two demonstrations in a hundred. The
/// smaller, the more right ones it takes until one mistake is forgiven; the larger, the more often a free order that is seldom shown is
/// taken for one.
const MISTAKES: f64 = 0.02;

/// One modifiable connection, from a memorised subgoal to a newly achieved one.
///
/// Correlation-based learning, gated by the target's transient peak c2 (Gerstner and Kistler 2002, chapter 10): while it lasts, the connection traces
/// how much of it the source's memory c1 had stood for. What one demonstration leaves is how far the source was there, between 0 and 1. From
/// demonstration to demonstration the connection sums up what that speaks for: that the source is a condition, and missing by mistake at times, or
/// that the order is free, with a frequency that nothing is known of (Laplace's rule of succession). So nothing is pruned for ever:
/// a single demonstration in the wrong order is outweighed by enough of those in the right one, and an order that varies stays free.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PlasticConnection {
    /// Integrals over the present demonstration: of c1 c2, and of c2.
    together: f64,
    achieved: f64,
    /// Demonstrations in which the source was there when the target came about, and in which it was not.
    with: f64,
    without: f64,
    /// Logarithm of the odds that the source is a condition.
    log_odds: f64,
}

impl PlasticConnection {
    pub const NEW: Self = Self { together: 0.0, achieved: 0.0, with: 0.0, without: 0.0, log_odds: 0.0 };

    /// Traces one cycle with the signals `memorised` = c1 of the source, `achieved` = c2 of the target.
    pub fn trace(&mut self, memorised: f64, achieved: f64) {
        self.together += memorised * achieved;
        self.achieved += achieved;
    }

    /// Learns from the demonstration that has ended; nothing where the target did not come about.
    pub fn learn(&mut self) {
        if self.achieved <= 0.0 {
            return;
        }
        let share = self.together / self.achieved;
        let seen = self.with + self.without + 2.0;
        let odds = |by_condition: f64, by_free: f64| (by_condition / (by_free / seen)).ln();
        self.log_odds += share * odds(1.0 - MISTAKES, self.with + 1.0);
        self.log_odds += (1.0 - share) * odds(MISTAKES, self.without + 1.0);
        self.with += share;
        self.without += 1.0 - share;
        (self.together, self.achieved) = (0.0, 0.0);
    }

    /// How likely the source is a condition, 0 to 1; 0 before anything was demonstrated.
    pub fn strength(&self) -> f64 {
        if self.with + self.without > 0.0 { 1.0 / (1.0 + (-self.log_odds).exp()) } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Demonstrations in which the source was there or not; a transient peak as the fields make it lasts some 80 cycles.
    fn after(there: impl IntoIterator<Item = bool>) -> f64 {
        let mut connection = PlasticConnection::NEW;
        for there in there {
            (0..80).for_each(|_| connection.trace(f64::from(u8::from(there)), 0.9));
            connection.learn();
        }
        connection.strength()
    }

    fn times(there: bool, count: usize) -> impl Iterator<Item = bool> {
        std::iter::repeat_n(there, count)
    }

    #[test]
    fn what_is_always_memorised_is_learned_from_the_first_time_on() {
        assert_eq!(after([]), 0.0);
        for count in 1..50 {
            assert!(after(times(true, count)) > 0.6, "{count}");
        }
    }

    #[test]
    fn one_mistake_is_forgiven_after_some_right_ones_whenever_it_was_made() {
        assert!(after([false]) < 0.1 && after([true, false]) < 0.2);
        for before in 0..=20 {
            let shown = times(true, before).chain([false]).chain(times(true, 20 - before));
            assert!(after(shown) > 0.6, "after {before}");
        }
        let first_forgiven =
            (1..20).find(|&count| after([false].into_iter().chain(times(true, count))) > 0.5);
        assert_eq!(first_forgiven, Some(7));
    }

    #[test]
    fn an_order_that_varies_is_free_however_long_it_is_shown() {
        for rounds in 1..50 {
            // One in ten the other way.
            let varied = (0..rounds).flat_map(|_| times(true, 9).chain([false]));
            assert!(rounds < 4 || after(varied) < 0.5, "{rounds}");
            assert!(after((0..rounds).flat_map(|_| [true, false])) < 0.2, "{rounds}");
        }
    }
}
