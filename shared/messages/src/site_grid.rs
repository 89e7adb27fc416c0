use crate::plausible::{bounded, ensure};
use crate::{Flaw, MAX_PLACES};
use bytemuck::{Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;

/// Where the sites of a field of two dimensions lie, or of a picture: row after row along the first axis, the sites of a row along the second.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable, ZeroCopySend)]
pub struct SiteGrid {
    /// Place of the first site along both axes, in their own units: m on the table plane.
    pub first: [f64; 2],
    /// Distance of neighbours along both axes.
    pub spacing: [f64; 2],
    /// Sites along both axes.
    pub sites: [u32; 2],
}

impl SiteGrid {
    /// Number of sites.
    pub fn used(&self) -> usize {
        (self.sites[0] as usize).saturating_mul(self.sites[1] as usize).min(MAX_PLACES)
    }

    /// Where a site lies.
    pub fn place(&self, site: usize) -> [f64; 2] {
        let width = (self.sites[1] as usize).max(1);
        let along = |axis: usize, number: usize| self.first[axis] + number as f64 * self.spacing[axis];
        [along(0, site / width), along(1, site % width)]
    }

    /// The site nearest to a place; `None` if that lies beside the grid.
    pub fn site(&self, place: [f64; 2]) -> Option<usize> {
        let along = |axis: usize| {
            let number = ((place[axis] - self.first[axis]) / self.spacing[axis]).round();
            (number >= 0.0 && number < f64::from(self.sites[axis])).then_some(number as usize)
        };
        Some(along(0)? * self.sites[1] as usize + along(1)?)
    }

    /// Refuses more sites than `most`, and places that are none; `field` is the grid's name.
    pub(crate) fn check(&self, field: &'static str, most: usize) -> Result<(), Flaw> {
        let [rows, width] = self.sites.map(|sites| sites as usize);
        let fits = rows.checked_mul(width).is_some_and(|sites| sites <= most);
        ensure(fits, field, "sites that a message holds")?;
        bounded(field, [self.first, self.spacing].as_flattened(), 100.0)
    }
}
