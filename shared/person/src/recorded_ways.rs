use crate::PersonError;
use crate::recorded_way::RecordedWay;
use coact_recordings::{WayKind, read_ways};
use std::ops::RangeInclusive;
use std::path::Path;

/// Ways along which hands of real people carried, gave and withdrew, ready to move the partner's hand.
#[derive(Debug, Clone)]
pub struct RecordedWays {
    pub(crate) ways: Vec<RecordedWay>,
    /// Time grows with this power of the distance.
    growth: f64,
}

/// The power where the ways do not tell it: about that of the shipped ones.
const UNTOLD: f64 = 0.5;
/// What is believed of them: a movement takes neither less time the farther it leads, nor more than at the same speed.
const PLAUSIBLE: RangeInclusive<f64> = 0.0..=1.0;

impl RecordedWays {
    /// Reads a file of ways.
    ///
    /// # Errors
    /// [`PersonError::Recording`] for what cannot be read, [`PersonError::Recordings`] without a way of each kind.
    pub fn load(file: &Path) -> Result<Self, PersonError> {
        let ways: Vec<RecordedWay> = read_ways(file)?.iter().map(RecordedWay::new).collect();
        let own = Self { growth: growth(&ways), ways };
        match WayKind::ALL.into_iter().find(|kind| own.count_of(*kind) == 0) {
            None => Ok(own),
            Some(kind) => {
                let message = format!("holds no way of the kind {}; expected one of each", kind.name());
                Err(PersonError::Recordings { path: file.to_owned(), message })
            }
        }
    }

    /// How many ways of this kind there are.
    pub(crate) fn count_of(&self, kind: WayKind) -> usize {
        self.of_kind(kind).count()
    }

    /// The `turn`-th of them, as an index into all.
    pub(crate) fn nth_of(&self, kind: WayKind, turn: usize) -> Option<usize> {
        self.of_kind(kind).nth(turn)
    }

    /// How long a hand takes along `way` to what is `distance` m away, s: as long as the recorded one, and longer for farther places as
    /// the recorded hands altogether did.
    pub(crate) fn duration(&self, way: &RecordedWay, distance: f64) -> f64 {
        way.duration * (distance / way.distance).powf(self.growth)
    }

    fn of_kind(&self, kind: WayKind) -> impl Iterator<Item = usize> {
        (0..self.ways.len()).filter(move |index| self.ways[*index].kind == kind)
    }
}

/// The power of the distance with which the ways' time grows: least squares on logarithms.
fn growth(ways: &[RecordedWay]) -> f64 {
    let count = ways.len().max(1) as f64;
    let mean = |value: fn(&RecordedWay) -> f64| ways.iter().map(|way| value(way).ln()).sum::<f64>() / count;
    let middle = (mean(|way| way.distance), mean(|way| way.duration));
    let (mut common, mut spread) = (0.0, 0.0);
    for way in ways {
        let off = way.distance.ln() - middle.0;
        common += off * (way.duration.ln() - middle.1);
        spread += off * off;
    }
    if spread > 1e-6 { (common / spread).clamp(*PLAUSIBLE.start(), *PLAUSIBLE.end()) } else { UNTOLD }
}
