use super::intention::{Choice, Intention, View};
use super::rates::Rates;
use super::script::Script;
use super::{PersonMemory, erring, synthetic};
use crate::noise::{Noise, Stream};
use rand::{Rng, RngExt};

/// Pause between two actions of a person who chooses, ms.
const PAUSE_MS: std::ops::Range<u64> = 500..2000;

/// Where the person's intentions come from.
#[derive(Debug, Clone)]
pub(crate) enum Plan {
    /// Chosen at random among the plan's valid actions.
    Synthetic,
    /// The same, but for mistakes and pauses at these rates.
    Erring(Rates),
    /// Read from a file.
    Script(Script),
}

impl Plan {
    /// What comes next for a person at rest; `can_hide` says whether something that stands before the part may hide an
    /// action.
    pub fn next<R: Rng>(
        &self,
        view: &View,
        memory: &mut PersonMemory,
        can_hide: &dyn Fn(&Intention) -> bool,
        rng: &mut R,
    ) -> Choice {
        match self {
            Self::Synthetic => synthetic::choose(view, rng),
            Self::Erring(rates) => erring::choose(rates, view, can_hide, rng),
            Self::Script(script) => script.next(view, memory),
        }
    }

    /// Rest before the next thought, ms.
    pub fn pause_ms(&self, noise: &Noise, tick: u64) -> u64 {
        match self {
            Self::Synthetic | Self::Erring(_) => noise.at(Stream::Choice, tick).random_range(PAUSE_MS),
            Self::Script(_) => 1,
        }
    }

    /// How a person who errs at times moves and is seen; none for one who never does.
    pub fn rates(&self) -> Option<&Rates> {
        match self {
            Self::Erring(rates) => Some(rates),
            Self::Synthetic | Self::Script(_) => None,
        }
    }
}
