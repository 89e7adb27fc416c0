use coact_messages::SiteGrid;
use coact_neural_field::{Axis, Gaussian, Interaction, Lattice, MetricConstants, ParameterError};
use std::f64::consts::TAU;

/// A field of two dimensions that selects: what drives it at different places competes, and one peak stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SelectionPlan {
    /// Time scale and sigmoid.
    pub constants: MetricConstants,
    /// Resting level h.
    pub resting: f64,
    /// Input at a place for which everything speaks.
    pub gain: f64,
    /// Standard deviation of the input about a place, along both axes.
    pub input_sigma: [f64; 2],
    /// Integral of the excitation of a site by its neighbours.
    pub excitation: f64,
    /// Its standard deviation along both axes.
    pub excitation_sigma: [f64; 2],
    /// Inhibition of each site by a peak as large as the excitation's Gaussian, wherever it stands.
    pub inhibition: f64,
    /// Where its sites lie.
    pub grid: SiteGrid,
}

impl SelectionPlan {
    /// Its sites, as neural fields have them.
    ///
    /// # Errors
    /// The grid's extents or its spacing are none.
    pub fn lattice(&self) -> Result<Lattice<2>, ParameterError> {
        let SiteGrid { first, spacing, sites } = self.grid;
        let axis = |axis: usize| Axis {
            sites: sites[axis] as usize,
            spacing: spacing[axis],
            origin: first[axis],
            circular: false,
        };
        Lattice::new([axis(0), axis(1)])
    }

    /// How they act on each other.
    ///
    /// # Errors
    /// A constant that is out of its range.
    pub fn interaction(&self) -> Result<Interaction<2>, ParameterError> {
        let sigma = self.excitation_sigma;
        let area = TAU * sigma[0] * sigma[1];
        let excitation = Gaussian { amplitude: self.excitation / area, sigma };
        Ok(Interaction::none(self.lattice()?)
            .with(excitation)?
            .with_inhibition_everywhere(self.inhibition / area))
    }
}
