use std::time::Instant;

/// How fast a page may send: as much as a page of ours does, on the average.
///
/// A server that gets no core for a while finds all that was sent meanwhile at once. That is no page's fault: so much is kept in hand.
#[derive(Debug)]
pub(crate) struct MessageRate {
    /// How many more may come now.
    left: f64,
    looked: Instant,
}

/// More messages in a second come from no page of ours: three times as many as it sends while somebody plays and scrolls.
const MOST_PER_S: f64 = 300.0;
/// At once come at most as many as in so many seconds. Chosen by hand: a machine that stands still for longer is of no use to anybody.
const SAVED_S: f64 = 10.0;

impl MessageRate {
    /// Of a page that opens.
    pub fn from_now(now: Instant) -> Self {
        Self { left: MOST_PER_S * SAVED_S, looked: now }
    }

    /// One more has come: whether it may.
    pub fn admits(&mut self, now: Instant) -> bool {
        let since = now.saturating_duration_since(self.looked).as_secs_f64();
        self.left = (self.left + MOST_PER_S * since).min(MOST_PER_S * SAVED_S) - 1.0;
        self.looked = now;
        self.left >= 0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    /// How many of these are admitted, which come at this rate for so many seconds.
    fn admitted(rate: &mut MessageRate, begun: Instant, per_s: u32, seconds: u32) -> u32 {
        let times = (0..per_s * seconds).map(|index| begun + Duration::from_secs(1) / per_s * index);
        times.map(|time| u32::from(rate.admits(time))).sum()
    }

    #[test]
    fn a_page_that_plays_is_admitted_for_ever_and_so_is_what_a_standstill_has_kept_back() {
        let begun = Instant::now();
        let mut rate = MessageRate::from_now(begun);
        assert_eq!(admitted(&mut rate, begun, 185, 60), 185 * 60);
        let after = begun + Duration::from_secs(65);
        assert!((0..185 * 5).all(|_| rate.admits(after)), "five seconds' worth at once");
        assert_eq!(admitted(&mut rate, after, 185, 60), 185 * 60);
    }

    #[test]
    fn a_flood_is_not_admitted() {
        let begun = Instant::now();
        let mut rate = MessageRate::from_now(begun);
        assert!(admitted(&mut rate, begun, 1000, 10) < 6100);
        assert!(!rate.admits(begun + Duration::from_secs(10)));
    }
}
