use std::time::{Duration, Instant};

/// Something that is done so often; what is late is not caught up with.
#[derive(Debug)]
pub struct Cadence {
    every: Duration,
    due: Instant,
}

impl Cadence {
    /// Due for the first time after so long, and then so often.
    pub fn new(every: Duration) -> Self {
        Self { every, due: Instant::now() + every }
    }

    /// Due at once, and then so often.
    pub fn from_now(every: Duration) -> Self {
        Self { every, due: Instant::now() }
    }

    /// Whether it is due now; it then is again after its time.
    pub fn is_due(&mut self) -> bool {
        let now = Instant::now();
        if now < self.due {
            return false;
        }
        let next = self.due + self.every;
        self.due = if next > now { next } else { now + self.every };
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_late_is_done_once() {
        let mut cadence = Cadence::new(Duration::from_millis(5));
        assert!(!cadence.is_due());
        std::thread::sleep(Duration::from_millis(30));
        assert!(cadence.is_due());
        assert!(!cadence.is_due());
    }
}
