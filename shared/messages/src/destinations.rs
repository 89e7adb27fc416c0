use crate::plausible::{fractions, index, optional, places};
use crate::{Flaw, MAX_DESTINATIONS, MAX_KINDS, NONE};
use bytemuck::{Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;

/// Where the present movement of the person's hand may lead: every part that could be taken, every mounted one, and two places where nothing is. What is
/// measured of each, before anything is chosen: that is the destination field's.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
pub struct Destinations {
    /// How many are valid.
    pub count: u32,
    /// Reserved, zero.
    pub reserved: u32,
    /// How much the movement tells yet, in [0, 1]; 0 without a movement, and the others are then those of the last one.
    pub told: f64,
    /// Where they are on the table plane, m.
    pub place: [[f64; 2]; MAX_DESTINATIONS],
    /// Kind of the part that lies there; [`NONE`] where nothing is taken, or what is mounted.
    pub kind: [u32; MAX_DESTINATIONS],
    /// How well movement and shape of the hand fit each, against the one that they fit best, in [0, 1].
    pub fit: [f64; MAX_DESTINATIONS],
}

impl Destinations {
    /// Kind, place and fit of each; no kind where nothing is taken.
    pub fn iter(&self) -> impl Iterator<Item = (Option<usize>, [f64; 2], f64)> {
        let count = (self.count as usize).min(MAX_DESTINATIONS);
        let kind = |index: usize| (self.kind[index] != NONE).then_some(self.kind[index] as usize);
        (0..count).map(move |index| (kind(index), self.place[index], self.fit[index]))
    }

    /// Adds one, if there is room.
    pub fn push(&mut self, kind: Option<usize>, place: [f64; 2], fit: f64) {
        let index = self.count as usize;
        if index < MAX_DESTINATIONS {
            (self.place[index], self.fit[index]) = (place, fit);
            self.kind[index] = kind.map_or(NONE, |kind| kind as u32);
            self.count += 1;
        }
    }

    pub(crate) fn check(&self) -> Result<(), Flaw> {
        index("destinations.count", self.count, MAX_DESTINATIONS + 1)?;
        let count = self.count as usize;
        fractions("destinations.told", &[self.told])?;
        places("destinations.place", self.place[..count].as_flattened())?;
        self.kind[..count].iter().try_for_each(|kind| optional("destinations.kind", *kind, MAX_KINDS))?;
        fractions("destinations.fit", &self.fit[..count])
    }
}
