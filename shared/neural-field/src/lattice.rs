use crate::{Axis, ParameterError};

/// Where the sites of a metric field lie: a grid of one to three dimensions, the last of which runs fastest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lattice<const D: usize> {
    axes: [Axis; D],
}

/// No lattice has more sites: memory is taken in proportion.
const MOST_SITES: usize = 10_000_000;

impl<const D: usize> Lattice<D> {
    /// A lattice with these axes.
    ///
    /// # Errors
    /// No axis, an axis without sites or with a spacing that is not positive, or too many sites.
    pub fn new(axes: [Axis; D]) -> Result<Self, ParameterError> {
        for axis in &axes {
            ParameterError::unless_positive("spacing", axis.spacing)?;
            ParameterError::unless_finite("origin", axis.origin)?;
        }
        let sites = axes.iter().try_fold(1_usize, |product, axis| product.checked_mul(axis.sites));
        let sites = sites.filter(|sites| D > 0 && (1..=MOST_SITES).contains(sites));
        let value = axes.iter().map(|axis| axis.sites as f64).product();
        let expected = "1 to 10000000, on at least one axis";
        sites.map(|_| Self { axes }).ok_or(ParameterError { name: "number of sites", value, expected })
    }

    /// Its axes.
    pub fn axes(&self) -> &[Axis; D] {
        &self.axes
    }

    /// Number of sites.
    pub fn sites(&self) -> usize {
        self.axes.iter().map(|axis| axis.sites).product()
    }

    /// Length, area or volume that belongs to one site.
    pub fn element(&self) -> f64 {
        self.axes.iter().map(|axis| axis.spacing).product()
    }

    /// Where a site lies.
    pub fn place(&self, mut site: usize) -> [f64; D] {
        let mut place = [0.0; D];
        for (place, axis) in place.iter_mut().zip(&self.axes).rev() {
            *place = axis.place(site % axis.sites);
            site /= axis.sites;
        }
        place
    }

    /// The sites around a place, with their shares of it (multilinear); those outside open axes are left out.
    pub(crate) fn around(&self, place: [f64; D]) -> Vec<(usize, f64)> {
        let mut around = vec![(0, 1.0)];
        for (axis, place) in self.axes.iter().zip(place) {
            let neighbours = axis.neighbours(place);
            let next = around.iter().flat_map(|(index, share)| {
                let of = move |(site, part): (usize, f64)| (index * axis.sites + site, share * part);
                neighbours.into_iter().flatten().map(of)
            });
            around = next.filter(|(_, share)| *share > 0.0).collect();
        }
        around
    }

    /// For an axis: how many stretches there are across the ones before it, and how many sites one step along it is.
    pub(crate) fn strides(&self, axis: usize) -> (usize, usize) {
        let product = |axes: &[Axis]| axes.iter().map(|axis| axis.sites).product();
        (product(&self.axes[..axis]), product(&self.axes[axis + 1..]))
    }
}
