use crate::plausible::{bounded, ensure};
use crate::{Flaw, MAX_PLACES};
use bytemuck::{Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;

/// Where the sites of a field over the table lie: row after row along x, the sites of a row along y.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable, ZeroCopySend)]
pub struct TableGrid {
    /// Place of the first site, x and y, m.
    pub first: [f64; 2],
    /// Distance of neighbours, m.
    pub spacing: f64,
    /// Sites along x and y.
    pub sites: [u32; 2],
}

impl TableGrid {
    /// Number of sites.
    pub fn used(&self) -> usize {
        (self.sites[0] as usize).saturating_mul(self.sites[1] as usize).min(MAX_PLACES)
    }

    /// Where a site lies, m.
    pub fn place(&self, site: usize) -> [f64; 2] {
        let width = (self.sites[1] as usize).max(1);
        let along = |axis: usize, number: usize| self.first[axis] + number as f64 * self.spacing;
        [along(0, site / width), along(1, site % width)]
    }

    /// The site nearest to a place; `None` if that lies beside the grid.
    pub fn site(&self, place: [f64; 2]) -> Option<usize> {
        let along = |axis: usize| {
            let number = ((place[axis] - self.first[axis]) / self.spacing).round();
            (number >= 0.0 && number < f64::from(self.sites[axis])).then_some(number as usize)
        };
        Some(along(0)? * self.sites[1] as usize + along(1)?)
    }

    pub(crate) fn check(&self) -> Result<(), Flaw> {
        let [along_x, along_y] = self.sites.map(|sites| sites as usize);
        let fits = along_x.checked_mul(along_y).is_some_and(|sites| sites <= MAX_PLACES);
        ensure(fits, "table.sites", "sites that a frame holds")?;
        let [x, y] = self.first;
        bounded("table", &[x, y, self.spacing], 100.0)
    }
}
