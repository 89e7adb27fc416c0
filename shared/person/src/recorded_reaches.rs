use crate::PersonError;
use crate::hand_model::FOREARM;
use crate::recorded_reach::RecordedReach;
use coact_recordings::{Reach, forearm, read_folder};
use std::path::Path;

/// Reaches of one recorded person, ready to drive the partner's hand.
///
/// The image knows neither depth nor the scene: each reach keeps its time course, its detours in proportion to its way, and the shape of
/// the hand, in m by the length of the person's forearm at rest; start and end are those of the simulated reach.
#[derive(Debug, Clone)]
pub struct RecordedReaches {
    pub(crate) reaches: Vec<RecordedReach>,
}

impl RecordedReaches {
    /// Reads a folder of recordings and takes one of its people, in turn with the seed.
    ///
    /// # Errors
    /// [`PersonError::Recording`] for what cannot be read, [`PersonError::Recordings`] without a usable reach.
    pub fn load(folder: &Path, seed: u64) -> Result<Self, PersonError> {
        let all = read_folder(folder)?;
        let mut people: Vec<u32> = all.iter().map(|reach| reach.participant).collect();
        people.sort_unstable();
        people.dedup();
        let person = people.get((seed % people.len().max(1) as u64) as usize);
        Self::made_by(person.copied(), &all, folder)
    }

    /// Reads a folder of recordings and takes this participant.
    ///
    /// # Errors
    /// As [`load`](Self::load); the participant is none of the folder's.
    pub fn load_participant(folder: &Path, participant: u32) -> Result<Self, PersonError> {
        Self::made_by(Some(participant), &read_folder(folder)?, folder)
    }

    fn made_by(participant: Option<u32>, all: &[Reach], folder: &Path) -> Result<Self, PersonError> {
        let lacking =
            |message: &str| PersonError::Recordings { path: folder.to_owned(), message: message.to_owned() };
        let own: Vec<&Reach> = all.iter().filter(|reach| Some(reach.participant) == participant).collect();
        if own.is_empty() {
            return Err(match participant.filter(|_| !all.is_empty()) {
                Some(participant) => lacking(&format!("holds no reach of participant {participant}")),
                None => lacking("holds no reach; expected CSV files as in data/reaches"),
            });
        }
        let scale = forearm(&own)
            .map(|length| FOREARM / length)
            .ok_or_else(|| lacking("shows no forearm at rest; expected elbow and wrist before the onset"))?;
        let reaches: Vec<_> = own.iter().filter_map(|reach| RecordedReach::new(reach, scale)).collect();
        if reaches.is_empty() {
            return Err(lacking("holds no reach whose wrist can be followed from onset to grasp"));
        }
        Ok(Self { reaches })
    }

    /// How many reaches there are for a part of `width` m: those for the width that is nearest to it.
    pub(crate) fn count_for(&self, width: f64) -> usize {
        self.for_width(width).count()
    }

    /// The `turn`-th of them, as an index into all.
    pub(crate) fn nth_for(&self, width: f64, turn: usize) -> Option<usize> {
        self.for_width(width).nth(turn)
    }

    fn for_width(&self, width: f64) -> impl Iterator<Item = usize> {
        let distance = move |reach: &RecordedReach| (reach.width - width).abs();
        let nearest = self.reaches.iter().map(distance).fold(f64::INFINITY, f64::min);
        (0..self.reaches.len()).filter(move |&index| distance(&self.reaches[index]) <= nearest + 1e-9)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use crate::recorded_reach::RecordedFrame;
    use coact_period::PERIOD_S;

    #[test]
    fn no_hand_leaps_where_the_detector_is_mistaken() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/reaches");
        let (mut believed, mut all) = (0, 0);
        for participant in 1..=6 {
            for reach in RecordedReaches::load_participant(&folder, participant).unwrap().reaches {
                let hand: Vec<_> = (-1000..1500).map(|tick| reach.at(f64::from(tick) * PERIOD_S)).collect();
                for (tick, (before, after)) in hand.iter().zip(&hand[1..]).enumerate() {
                    let gone = |joint: usize| before.shape[joint].distance(after.shape[joint]) / PERIOD_S;
                    let fastest = (0..9).map(gone).fold(0.0, f64::max);
                    assert!(fastest < 3.001, "{participant}: {fastest} m/s in {tick}");
                }
                let near = |frame: &&RecordedFrame| {
                    (0..9).all(|joint| {
                        frame.confidence[joint] == 0.0
                            || frame.shape[joint].distance(frame.reported[joint]) < 0.03
                    })
                };
                believed += hand.iter().filter(near).count();
                all += hand.len();
            }
        }
        assert!(10 * believed > 9 * all, "{believed} of {all} as reported, within 3 cm");
    }
}
