use crate::Sentence;
use coact_messages::{ArmSide, Command, NONE, Percept};
use coact_period::cycles;
use std::time::Duration;

/// How long the arm must have stood on its way before it is spoken of. Chosen by hand: shorter stops explain themselves.
const STOOD: u64 = cycles(Duration::from_secs(2));
/// Speed override below which the arm stands.
const STANDS: f64 = 0.01;

/// Says what an arm that stands on its way waits for, where the person cannot know: it does not see where one of her arms is, and beside
/// an arm that may be anywhere it does not move.
#[derive(Debug, Default)]
pub struct Standstill {
    /// Cycle since which it stands.
    since: Option<u64>,
    /// Whether it has been told.
    is_told: bool,
}

impl Standstill {
    /// Looks at what control does and what perception sees; gives a sentence when the arm has stood for long for an arm that is not seen.
    pub fn observe(&mut self, command: &Command, percept: &Percept) -> Option<Sentence> {
        let cycle = command.header.cycle;
        if command.action == NONE || command.speed_override > STANDS {
            *self = Self::default();
            return None;
        }
        let stood = cycle.saturating_sub(*self.since.get_or_insert(cycle));
        let unseen = ArmSide::BOTH.map(|side| !percept.arms[side as usize].is_tracked());
        let arms = match unseen {
            _ if self.is_told || stood < STOOD => return None,
            [false, false] => return None,
            [true, false] => "your right arm",
            [false, true] => "your left arm",
            [true, true] => "your arms",
        };
        self.is_told = true;
        Some(Sentence { cycle, text: format!("I cannot see {arms}: I stand still until I do.") })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable;

    /// What is said when an arm whose hands are `seen` stands so long on its way, cycle by cycle.
    fn said(seen: [u32; 2], stands: impl Fn(u64) -> bool, cycles: u64) -> Vec<Sentence> {
        let mut standstill = Standstill::default();
        let mut percept = Percept::zeroed();
        percept.arms.iter_mut().zip(seen).for_each(|(arm, seen)| arm.tracked = seen);
        let said = (1..=cycles).filter_map(|cycle| {
            let mut command = Command::zeroed();
            command.header.cycle = cycle;
            command.speed_override = if stands(cycle) { 0.0 } else { 1.0 };
            standstill.observe(&command, &percept)
        });
        said.collect()
    }

    #[test]
    fn an_arm_that_stands_for_an_arm_that_is_not_seen_says_so_once() {
        let texts = |seen| said(seen, |_| true, 10_000).into_iter().map(|own| own.text).collect::<Vec<_>>();
        assert_eq!(texts([1, 0]), ["I cannot see your left arm: I stand still until I do."]);
        assert_eq!(texts([0, 1]), ["I cannot see your right arm: I stand still until I do."]);
        assert_eq!(texts([0, 0]), ["I cannot see your arms: I stand still until I do."]);
    }

    #[test]
    fn it_is_said_again_when_it_happens_again() {
        assert_eq!(said([1, 0], |cycle| cycle != 5000, 10_000).len(), 2);
    }

    #[test]
    fn an_arm_that_goes_on_stands_shortly_or_stands_for_what_is_seen_says_nothing() {
        assert!(said([1, 0], |_| false, 10_000).is_empty());
        assert!(said([1, 0], |cycle| cycle % 1500 != 0, 10_000).is_empty());
        assert!(said([1, 1], |_| true, 10_000).is_empty());
    }
}
