use super::{HandPath, MovementReader, PersonMovement};
use bytemuck::{Pod, Zeroable};
use coact_messages::MAX_PARTS;
use coact_stage_state::{Implausible, ensure};
use nalgebra::Vector2;

/// Places that are looked at: those of all parts, and some where an empty hand may be shown.
pub(crate) const PLACES: usize = MAX_PARTS + 3;
/// The first of these.
pub(crate) const HANDOVER: usize = MAX_PARTS;
/// Exponent by which likelihoods are weakened: a model of some people is too sure of another one.
const TRUSTED: f64 = 0.25;
/// Share of reaches that are taken to be unlike all that the model knows. Chosen by hand, as the one before on the recorded people, each left out
/// in turn: so the way alone never outweighs where the hand is at last.
const UNKNOWN: f64 = 0.1;
/// Of a place that no reach leads to.
const LEAST: f32 = -1e6;

/// How well the hand's way so far fits a reach to each place, as of one frame of the tracker.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Likelihoods {
    /// The place that is looked at next; all have been: [`PLACES`].
    next: u64,
    /// Frames of the path that are reckoned with.
    frames: u64,
    /// How likely each place is against the likeliest one, as far as frames were reckoned with when all had been looked at last.
    whole: [f32; PLACES],
    /// As far as the places have been looked at.
    coming: [f32; PLACES],
}

impl Likelihoods {
    /// A movement begins, and nothing is known of it.
    pub fn begin(&mut self) {
        *self = Self::zeroed();
        self.next = PLACES as u64;
    }

    /// One cycle's part of the work: one place. When all have been looked at, they are looked at anew with the frames that have come
    /// meanwhile. `place` tells where a place is, on the table plane, if there is one.
    pub fn step(
        &mut self,
        reader: &MovementReader,
        path: &HandPath,
        person: &PersonMovement,
        place: impl Fn(usize) -> Option<Vector2<f64>>,
    ) {
        let seen = path.frames().len() as u64;
        if self.next as usize == PLACES && self.frames != seen {
            (self.next, self.frames) = (0, seen);
            self.coming = [LEAST; PLACES];
        }
        let rest = self.next as usize..PLACES;
        let found = rest.clone().find_map(|index| Some((index, place(index)?)));
        if let Some((index, place)) = found {
            let likelihood = reader.likelihood(path, self.frames as usize, person, place);
            self.coming[index] = likelihood.max(f64::from(LEAST)) as f32;
        }
        self.next = found.map_or(PLACES, |(index, _)| index + 1) as u64;
        if !rest.is_empty() && self.next as usize == PLACES {
            self.whole = against_the_likeliest(&self.coming);
        }
    }

    /// How likely the way so far leads to that place, against the likeliest one: a logarithm, 0 or less. It is bounded, for some reach in a way
    /// that no model knows.
    pub fn of(&self, index: usize) -> f64 {
        f64::from(self.whole[index])
    }

    /// Refuses what is none.
    pub fn check(&self) -> Result<(), Implausible> {
        let counted = self.next as usize <= PLACES && self.frames <= HandPath::MOST as u64;
        ensure(counted, "likelihoods.next", "no more places and frames than there are")?;
        ensure(
            self.whole.iter().chain(&self.coming).all(|value| value.is_finite()),
            "likelihoods",
            "finite numbers",
        )
    }
}

fn against_the_likeliest(likelihoods: &[f32; PLACES]) -> [f32; PLACES] {
    let best = likelihoods.iter().copied().fold(LEAST, f32::max);
    likelihoods.map(|own| {
        let less = TRUSTED * f64::from(own - best);
        (UNKNOWN + (1.0 - UNKNOWN) * less.exp()).ln() as f32
    })
}
