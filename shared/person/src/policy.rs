use crate::{
    Intention, PersonState, RandomBehaviour, RecordedArm, Script, Surroundings, Undertaking, active_policy,
    random_policy, synthetic_policy,
};
use coact_period::cycles;
use coact_random::{RandomStreams, Stream};
use rand::{Rng, RngExt};
use std::ops::Range;
use std::time::Duration;

/// Pause between two activities of a person who chooses, cycles. Chosen by hand.
const PAUSE: Range<u64> = cycles(Duration::from_millis(500))..cycles(Duration::from_millis(2000));
/// The same of one who loses no time, cycles. Chosen by hand: about a reaction time.
const SHORT_PAUSE: Range<u64> = cycles(Duration::from_millis(150))..cycles(Duration::from_millis(400));

/// Where the person's intentions come from.
#[derive(Debug, Clone)]
pub enum Policy {
    /// Chosen at random among the plan's valid actions.
    Synthetic,
    /// The same, but without a pause, and at work on what comes next while the robot mounts what comes before it; where the robot is at
    /// work beside her place she lets it finish.
    Active,
    /// As the synthetic one, but with mistakes, pauses and variations as this says.
    Random(RandomBehaviour),
    /// Written down beforehand.
    Script(Script),
    /// None: the person moves an arm as it was recorded, and takes no part in the task.
    Arm(RecordedArm),
    /// Not known: the hand comes from outside ([`Person::show`](crate::Person::show_hand)), and what it does is found from what it did.
    Live,
}

impl Policy {
    /// What comes next for a person at rest; `can_hide` says whether an occluder may hide an activity.
    pub(crate) fn next<R: Rng>(
        &self,
        around: &Surroundings,
        state: &mut PersonState,
        can_hide: &dyn Fn(&Intention) -> bool,
        rng: &mut R,
    ) -> Undertaking {
        match self {
            Self::Synthetic => synthetic_policy::choose(around, rng),
            Self::Active => active_policy::choose(around, rng),
            Self::Random(behaviour) => random_policy::choose(behaviour, around, can_hide, rng),
            Self::Script(script) => script.next(around, state),
            Self::Arm(_) | Self::Live => Undertaking::Rest(PAUSE.end),
        }
    }

    /// Rest before the next thought, cycles.
    pub(crate) fn pause(&self, random: &RandomStreams, tick: u64) -> u64 {
        match self {
            Self::Synthetic | Self::Random(_) => random.at(Stream::Choice, tick).random_range(PAUSE),
            Self::Active => random.at(Stream::Choice, tick).random_range(SHORT_PAUSE),
            Self::Script(_) => 1,
            Self::Arm(_) | Self::Live => PAUSE.end,
        }
    }

    /// How a random partner moves and is seen; none for the others.
    pub(crate) fn behaviour(&self) -> Option<&RandomBehaviour> {
        match self {
            Self::Random(behaviour) => Some(behaviour),
            Self::Synthetic | Self::Active | Self::Script(_) | Self::Arm(_) | Self::Live => None,
        }
    }
}
