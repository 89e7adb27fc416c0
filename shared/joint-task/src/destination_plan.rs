use coact_messages::TableGrid;
use coact_neural_field::{Axis, Gaussian, Interaction, Lattice, MetricConstants, ParameterError};
use std::f64::consts::TAU;

/// The destination field: a field over the table in which the places that the person's hand may go to compete.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DestinationPlan {
    /// Time scale and sigmoid.
    pub constants: MetricConstants,
    /// Resting level h.
    pub resting: f64,
    /// Input at a place that the hand goes to for certain.
    pub gain: f64,
    /// How likely a reach for a part that no available step needs is beforehand, against one for a part that is due, from 0 to 1.
    pub undue: f64,
    /// Standard deviation of the input about a place, m.
    pub input_sigma: f64,
    /// Excitation of a site by its neighbours: its integral over the plane, and its standard deviation, m.
    pub excitation: (f64, f64),
    /// Inhibition of each site by a peak as large as the excitation's Gaussian, wherever it stands.
    pub inhibition: f64,
    /// Where its sites lie.
    pub table: TableGrid,
}

impl DestinationPlan {
    /// Its sites, as neural fields have them.
    ///
    /// # Errors
    /// The table's extents or the spacing are none.
    pub fn lattice(&self) -> Result<Lattice<2>, ParameterError> {
        let TableGrid { first, spacing, sites } = self.table;
        let axis =
            |axis: usize| Axis { sites: sites[axis] as usize, spacing, origin: first[axis], circular: false };
        Lattice::new([axis(0), axis(1)])
    }

    /// How they act on each other.
    ///
    /// # Errors
    /// A constant that is out of its range.
    pub fn interaction(&self) -> Result<Interaction<2>, ParameterError> {
        let (strength, sigma) = self.excitation;
        let area = TAU * sigma * sigma;
        let excitation = Gaussian { amplitude: strength / area, sigma: [sigma; 2] };
        Ok(Interaction::none(self.lattice()?)
            .with(excitation)?
            .with_inhibition_everywhere(self.inhibition / area))
    }
}
