use crate::field::fire;
use crate::{Interaction, Lattice, MetricConstants, ParameterError};

/// A field over continuous dimensions: places on a table, an orientation, an aperture. A peak says that something is there, and where.
///
/// It obeys the chapter's equation 1 in as many dimensions. Activity lives with the caller, in slices of [`Lattice::sites`] values; a
/// slice of another length is a programming error and panics.
#[derive(Debug, Clone)]
pub struct MetricField<const D: usize> {
    constants: MetricConstants,
    interaction: Interaction<D>,
    /// f(u) of all sites.
    output: Vec<f64>,
}

impl<const D: usize> MetricField<D> {
    /// A field with this interaction, on its lattice.
    ///
    /// # Errors
    /// A constant that is out of its range.
    pub fn new(constants: MetricConstants, interaction: Interaction<D>) -> Result<Self, ParameterError> {
        constants.check()?;
        let output = vec![0.0; interaction.lattice().sites()];
        Ok(Self { constants, interaction, output })
    }

    /// Where its sites lie.
    pub fn lattice(&self) -> &Lattice<D> {
        self.interaction.lattice()
    }

    /// One explicit Euler step of `dt` (chapter, eq. 1) at the resting level `h`: reads `now`, writes `next`.
    pub fn step(&mut self, dt: f64, now: &[f64], input: &[f64], h: f64, next: &mut [f64]) {
        let sites = self.lattice().sites();
        assert_eq!((now.len(), input.len(), next.len()), (sites, sites, sites));
        fire(&mut self.output, now, self.constants.slope, self.constants.threshold);
        self.interaction.integrate(&self.output, next);
        relax(dt / self.constants.tau, now, input, h, next);
    }

    /// Writes f(u) of each site: what projections carry to other fields.
    pub fn fire(&self, activity: &[f64], output: &mut [f64]) {
        fire(output, activity, self.constants.slope, self.constants.threshold);
    }
}

/// Turns the interaction integral of each site into its next activity.
#[multiversion::multiversion(targets("x86_64+avx512f", "x86_64+avx2"))]
fn relax(rate: f64, now: &[f64], input: &[f64], h: f64, next: &mut [f64]) {
    for ((next, &u), &s) in next.iter_mut().zip(now).zip(input) {
        *next = u + rate * (h - u + s + *next);
    }
}
