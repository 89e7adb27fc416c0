mod assembly;
mod reaches;

use crate::{Case, Setting};
use rand_pcg::Pcg64;

/// A kind of movement of the suite.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scenario {
    /// From anywhere to anywhere, with nothing around.
    FreeReach,
    /// To a part among others on the table, until the hand is around it.
    Pick,
    /// With a part from the table into its socket.
    Insert,
    /// From a socket back to rest.
    Park,
    /// Into a shelf.
    Shelf,
    /// Past one small obstacle.
    PastSmall,
    /// Past one tall obstacle.
    PastTall,
    /// Past two obstacles, a small one and a tall one.
    PastTwo,
}

impl Scenario {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::FreeReach,
        Self::Pick,
        Self::Insert,
        Self::Park,
        Self::Shelf,
        Self::PastSmall,
        Self::PastTall,
        Self::PastTwo,
    ];

    /// What it is called.
    pub fn name(self) -> &'static str {
        match self {
            Self::FreeReach => "free-reach",
            Self::Pick => "pick",
            Self::Insert => "insert",
            Self::Park => "park",
            Self::Shelf => "shelf",
            Self::PastSmall => "past-small",
            Self::PastTall => "past-tall",
            Self::PastTwo => "past-two",
        }
    }

    /// Median time of planning that it may take, and its 99th percentile where that is bounded, ms. Chosen by hand:
    /// well below the 0.2 to 2 s that published planners in posture space take for such movements.
    pub fn budget_ms(self) -> (f64, Option<f64>) {
        match self {
            Self::FreeReach => (5.0, None),
            Self::Pick => (50.0, Some(200.0)),
            Self::Insert | Self::PastSmall | Self::PastTall | Self::PastTwo => (50.0, None),
            Self::Park => (20.0, None),
            Self::Shelf => (200.0, None),
        }
    }

    /// Whether it needs a hand of ours: one of which a robot file says how it grips.
    pub fn needs_hand(self) -> bool {
        matches!(self, Self::Pick | Self::Insert | Self::Park)
    }

    /// A random case of it; none when none was drawn that starts clear of everything.
    pub fn case(self, setting: &Setting, random: &mut Pcg64) -> Option<Case> {
        match self {
            Self::FreeReach => Some(reaches::free_reach(setting, random)),
            Self::Pick => retry(|| assembly::pick(setting, random)),
            Self::Insert => retry(|| assembly::insert(setting, random)),
            Self::Park => retry(|| assembly::park(setting, random)),
            Self::Shelf => retry(|| reaches::shelf(setting, random)),
            Self::PastSmall => retry(|| reaches::past(setting, random, &[reaches::SMALL])),
            Self::PastTall => retry(|| reaches::past(setting, random, &[reaches::TALL])),
            Self::PastTwo => retry(|| reaches::past(setting, random, &[reaches::SMALL, reaches::TALL])),
        }
    }
}

/// Draws until a case starts clear of everything, or all [`DRAWS`] are used up.
fn retry(draw: impl FnMut() -> Option<Case>) -> Option<Case> {
    std::iter::repeat_with(draw).take(DRAWS).flatten().next()
}

/// Cases that are drawn at most until one starts clear. Chosen by hand: a bound that is hardly ever reached.
const DRAWS: usize = 200;
