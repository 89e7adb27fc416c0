use crate::plausible::{bounded, fractions, index};
use crate::{Flaw, MAX_GRIPS};
use bytemuck::{Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;
use std::f64::consts::TAU;

/// How the person's hand may be about to take a part, or holds one: what its orientation tells of each grip, before any is chosen: that is the grip
/// field's.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
pub struct Grips {
    /// How many are valid: none where nothing tells them apart, for the hand's orientation cannot be seen, or there is but one.
    pub count: u32,
    /// Reserved, zero.
    pub reserved: u32,
    /// How this person holds the hand in each grip: its pitch against the table plane, rad.
    pub pitch: [f64; MAX_GRIPS],
    /// How well the hand's pitch fits each, against the one that it fits best, in [0, 1]; all 0 of a hand that is out of sight.
    pub fit: [f64; MAX_GRIPS],
}

impl Grips {
    /// Index, pitch and fit of each.
    pub fn iter(&self) -> impl Iterator<Item = (usize, f64, f64)> {
        let count = (self.count as usize).min(MAX_GRIPS);
        (0..count).map(move |index| (index, self.pitch[index], self.fit[index]))
    }

    pub(crate) fn check(&self) -> Result<(), Flaw> {
        index("grips.count", self.count, MAX_GRIPS + 1)?;
        bounded("grips.pitch", &self.pitch, TAU)?;
        fractions("grips.fit", &self.fit)
    }
}
