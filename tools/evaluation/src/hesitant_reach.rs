use serde::Serialize;

/// How the robot bore a person who hesitated in mid-reach. Times are ms from the assembly's start.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct HesitantReach {
    /// When the hand began to stop.
    pub hesitated_ms: u64,
    /// When the goal stood in IL, highest of all, for the first time from then on; none: not before the grasp.
    pub inferred_ms: Option<u64>,
    /// Whether it then stood there until grasp completion without a break.
    pub kept: bool,
}

impl HesitantReach {
    /// A hand that began to stop then.
    pub(crate) fn new(hesitated_ms: u64) -> Self {
        Self { hesitated_ms, inferred_ms: None, kept: true }
    }

    /// Whether the goal stood in IL as the hand began to stop.
    pub fn is_inferred_before(&self) -> bool {
        self.inferred_ms.is_some_and(|inferred| inferred <= self.hesitated_ms)
    }

    /// Sees whether the goal `stands` now.
    pub(crate) fn see(&mut self, stands: bool, now: u64) {
        match self.inferred_ms {
            None => self.inferred_ms = stands.then_some(now),
            Some(_) => self.kept &= stands,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn goal_that_goes_and_comes_again_was_not_kept() {
        let seen = |stands: [bool; 4]| {
            let mut reach = HesitantReach::new(100);
            (100..).zip(stands).for_each(|(now, stands)| reach.see(stands, now));
            (reach.is_inferred_before(), reach.inferred_ms, reach.kept)
        };
        assert_eq!(seen([true, true, true, true]), (true, Some(100), true));
        assert_eq!(seen([false, false, true, true]), (false, Some(102), true));
        assert_eq!(seen([true, false, true, true]), (true, Some(100), false));
        assert_eq!(seen([false; 4]), (false, None, true));
    }
}
