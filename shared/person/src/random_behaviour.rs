use crate::PersonError;
use std::ops::RangeInclusive;

/// How a random partner behaves: what `random:KEY=VALUE,...` sets.
///
/// | key | value | meaning |
/// |---|---|---|
/// | `idle` | fraction | of the choices, the person idles for 2 to 6 s instead |
/// | `goal` | fraction | a part is taken for a subgoal whose turn has not come, or that is achieved |
/// | `request` | fraction | a part is requested whose turn has not come |
/// | `means` | fraction | a part is requested that lies in the person's own workspace |
/// | `hidden` | fraction | of valid takings of a part, behind an occluder: it hides the part and the hand at it, but not the hand that sets out |
/// | `words` | fraction | of valid actions, with a sentence of the task that means the same, said at reach onset |
/// | `aloud` | fraction | of requests that are wrong, with a sentence that says what is asked for: a bare hand does not show it; 0 unless given |
/// | `undoes` | fraction | a mounted part on the person's own side is taken out of its socket again and laid down, one that no achieved step needs; 0 unless given |
/// | `clarity` | range in 0..1 | of a grip: 1 is the grip's own pitch, 0 the middle of all grips' |
/// | `dropouts` | per second | bursts in which the tracker loses the hand, 50 to 300 ms long; at most 2 |
/// | `withdraws` | fraction | of handovers, the person lets go of the robot's part again, or takes the given part back, too early |
/// | `late` | fraction | of parts that the robot gives, the person comes for 2 to 6 s late |
/// | `changes` | fraction | of valid, plain reaches to a part, the hand turns to another one at 25 to 90 % of its way; 0 unless given |
/// | `returns` | fraction | of valid takings of an own part, the grasped part is put back to where it lay; 0 unless given |
/// | `hesitates` | fraction | of valid, plain reaches to a part, the hand stops at 25 to 75 % of its way for 0.3 to 1.0 s, and goes on; 0 unless given |
/// | `left` | fraction | of actions with what lies nearer to the left hand, and of askings and takings from the robot, with that one; 0 unless given |
/// | `movement` | range in ms | movement time of a reach, 300 to 3000 |
///
/// A fraction is from 0 to 1; the seven fractions of all choices add up to at most 1. To receive what the robot gives is
/// no choice. A range is written `LOW..HIGH`. What is not named has its default value.
#[derive(Debug, Clone, PartialEq)]
pub struct RandomBehaviour {
    pub(crate) idle: f64,
    pub(crate) goal: f64,
    pub(crate) request: f64,
    pub(crate) means: f64,
    pub(crate) hidden: f64,
    pub(crate) words: f64,
    pub(crate) aloud: f64,
    pub(crate) undoes: f64,
    pub(crate) clarity: RangeInclusive<f64>,
    pub(crate) dropouts: f64,
    pub(crate) withdraws: f64,
    pub(crate) late: f64,
    pub(crate) changes: f64,
    pub(crate) returns: f64,
    pub(crate) hesitates: f64,
    pub(crate) left: f64,
    pub(crate) movement: RangeInclusive<f64>,
}

impl Default for RandomBehaviour {
    /// One choice in ten goes wrong; all fractions are chosen by hand. Nobody undoes a step, changes the mind in mid-reach, hesitates, or puts a part back, and all act with the right hand. Movement time goes from the 5th percentile of
    /// recorded reaches to the longest one.
    fn default() -> Self {
        Self {
            idle: 0.15,
            goal: 0.06,
            request: 0.02,
            means: 0.02,
            hidden: 0.03,
            words: 0.03,
            aloud: 0.0,
            undoes: 0.0,
            clarity: 0.5..=1.0,
            dropouts: 0.05,
            withdraws: 0.05,
            late: 0.05,
            changes: 0.0,
            returns: 0.0,
            hesitates: 0.0,
            left: 0.0,
            movement: 429.0..=895.0,
        }
    }
}

/// What an error names.
const KEYS: &str = "idle, goal, request, means, hidden, words, aloud, undoes, clarity, dropouts, withdraws, late, changes, returns, hesitates, left, movement";

impl RandomBehaviour {
    /// Reads `KEY=VALUE,...`; an empty text leaves all defaults.
    ///
    /// # Errors
    /// [`PersonError::Behaviour`] for an unknown key, or a value that is out of its range.
    pub fn parse(text: &str) -> Result<Self, PersonError> {
        let fault = |entry: &str, expected: String| PersonError::Behaviour { entry: entry.into(), expected };
        let mut behaviour = Self::default();
        for entry in text.split(',').filter(|entry| !entry.is_empty()) {
            let (key, value) = entry.split_once('=').ok_or_else(|| fault(entry, "KEY=VALUE".into()))?;
            behaviour.set(key, value).map_err(|expected| fault(entry, expected))?;
        }
        let Self { idle, goal, request, means, hidden, words, undoes, .. } = behaviour;
        let sum = idle + goal + request + means + hidden + words + undoes;
        if sum <= 1.0 {
            return Ok(behaviour);
        }
        let all = "idle, goal, request, means, hidden, words and undoes to add up to at most 1";
        Err(fault(text, format!("{all}, not {sum:.2}")))
    }

    /// Sets one key; an error says what was expected.
    fn set(&mut self, key: &str, value: &str) -> Result<(), String> {
        match key {
            "idle" => self.idle = fraction(value)?,
            "goal" => self.goal = fraction(value)?,
            "request" => self.request = fraction(value)?,
            "means" => self.means = fraction(value)?,
            "hidden" => self.hidden = fraction(value)?,
            "undoes" => self.undoes = fraction(value)?,
            "aloud" => self.aloud = fraction(value)?,
            "words" => self.words = fraction(value)?,
            "withdraws" => self.withdraws = fraction(value)?,
            "late" => self.late = fraction(value)?,
            "changes" => self.changes = fraction(value)?,
            "returns" => self.returns = fraction(value)?,
            "hesitates" => self.hesitates = fraction(value)?,
            "left" => self.left = fraction(value)?,
            "dropouts" => self.dropouts = number(value, 2.0, "bursts per second, from 0 to 2")?,
            "clarity" => self.clarity = range(value, 0.0..=1.0, "LOW..HIGH within 0..1")?,
            "movement" => self.movement = range(value, 300.0..=3000.0, "LOW..HIGH within 300..3000 ms")?,
            _ => return Err(format!("one of the keys {KEYS}")),
        }
        Ok(())
    }
}

fn fraction(text: &str) -> Result<f64, String> {
    number(text, 1.0, "a fraction from 0 to 1")
}

/// A number from 0 to `highest`.
fn number(text: &str, highest: f64, expected: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|number| (0.0..=highest).contains(number));
    number.ok_or_else(|| expected.to_owned())
}

/// `LOW..HIGH`, both within `limits`, in this order.
fn range(text: &str, limits: RangeInclusive<f64>, expected: &str) -> Result<RangeInclusive<f64>, String> {
    let bounds = text.split_once("..").and_then(|(low, high)| Some((low.parse().ok()?, high.parse().ok()?)));
    let ordered = |(low, high): &(f64, f64)| limits.contains(low) && limits.contains(high) && low <= high;
    bounds.filter(ordered).map(|(low, high)| low..=high).ok_or_else(|| expected.to_owned())
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn keys_set_their_values_and_leave_the_others() {
        let behaviour = RandomBehaviour::parse(
            "goal=0.2,hidden=0.1,words=0.4,undoes=0.05,clarity=0..0.25,changes=1,returns=0.3,hesitates=0.5,movement=600..600",
        )
        .unwrap();
        assert_eq!(
            behaviour,
            RandomBehaviour {
                goal: 0.2,
                hidden: 0.1,
                words: 0.4,
                undoes: 0.05,
                clarity: 0.0..=0.25,
                changes: 1.0,
                returns: 0.3,
                hesitates: 0.5,
                movement: 600.0..=600.0,
                ..RandomBehaviour::default()
            }
        );
        assert_eq!(RandomBehaviour::parse("").unwrap(), RandomBehaviour::default());
    }

    #[test]
    fn what_makes_no_sense_is_refused_with_what_was_expected() {
        for (text, expected) in [
            ("gaol=0.2", "random: \"gaol=0.2\"; expected one of the keys idle, goal"),
            ("goal", "random: \"goal\"; expected KEY=VALUE"),
            ("goal=1.2", "random: \"goal=1.2\"; expected a fraction from 0 to 1"),
            ("goal=NaN", "expected a fraction"),
            ("hidden=1.5", "expected a fraction from 0 to 1"),
            ("words=often", "expected a fraction from 0 to 1"),
            ("undoes=2", "expected a fraction from 0 to 1"),
            ("changes=-0.1", "expected a fraction from 0 to 1"),
            ("returns=yes", "expected a fraction from 0 to 1"),
            ("hesitates=1.01", "expected a fraction from 0 to 1"),
            ("dropouts=-1", "expected bursts per second"),
            ("clarity=0.9..0.2", "expected LOW..HIGH within 0..1"),
            ("movement=10..500", "expected LOW..HIGH within 300..3000 ms"),
            ("goal=0.6,means=0.6", "to add up to at most 1"),
            ("idle=0.5,undoes=0.6", "to add up to at most 1"),
            (
                "idle=0.5,hidden=0.3,words=0.3",
                "idle, goal, request, means, hidden, words and undoes to add up to at most 1",
            ),
        ] {
            let error = RandomBehaviour::parse(text).unwrap_err().to_string();
            assert!(error.contains(expected), "{error}");
        }
    }
}
