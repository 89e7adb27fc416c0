/// One dimension of a lattice.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// How many sites lie along it.
    pub sites: usize,
    /// Their distance, in the axis's own unit.
    pub spacing: f64,
    /// Where the first of them lies.
    pub origin: f64,
    /// The last site is the first one's neighbour, as an angle's are.
    pub circular: bool,
}

impl Axis {
    /// Sites from `first` to `last`, both included where the spacing fits.
    pub fn open(first: f64, last: f64, spacing: f64) -> Self {
        let sites = ((last - first) / spacing).round().max(0.0) as usize + 1;
        Self { sites, spacing, origin: first, circular: false }
    }

    /// `sites` sites that divide a circle of this circumference, from `first` on.
    pub fn circular(first: f64, circumference: f64, sites: usize) -> Self {
        Self { sites, spacing: circumference / sites as f64, origin: first, circular: true }
    }

    /// Where a site lies.
    pub fn place(&self, site: usize) -> f64 {
        self.origin + site as f64 * self.spacing
    }

    /// The two sites that a place lies between, with their shares of it; a site outside an open axis is none.
    pub(crate) fn neighbours(&self, place: f64) -> [Option<(usize, f64)>; 2] {
        let position = (place - self.origin) / self.spacing;
        let below = position.floor();
        let share = position - below;
        [(below, 1.0 - share), (below + 1.0, share)]
            .map(|(site, share)| Some((self.site(site as i64)?, share)))
    }

    /// The site of this number; on a circle all numbers have one.
    pub(crate) fn site(&self, number: i64) -> Option<usize> {
        let sites = self.sites as i64;
        match self.circular {
            true => Some(number.rem_euclid(sites) as usize),
            false => (0..sites).contains(&number).then_some(number as usize),
        }
    }
}
