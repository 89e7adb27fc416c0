use crate::field::sum;
use crate::separable::Separable;
use crate::{Gaussian, Lattice, ParameterError};

/// Lateral interaction on a lattice: which site excites or inhibits which other one, by how they lie to each other.
///
/// A sum of Gaussians, each the product of one along each axis (local excitation, inhibition around it), of an arbitrary kernel for
/// what is no such sum, and of a constant that reaches everywhere, so that all places compete (chapter, eq. 2, in more dimensions).
#[derive(Debug, Clone)]
pub struct Interaction<const D: usize> {
    lattice: Lattice<D>,
    separable: Vec<Separable<D>>,
    /// Of an arbitrary kernel: offsets in sites, and weights times the lattice's element.
    arbitrary: Vec<([i64; D], f64)>,
    /// Weight of the sum over all sites.
    everywhere: f64,
}

impl<const D: usize> Interaction<D> {
    /// No interaction yet.
    pub fn none(lattice: Lattice<D>) -> Self {
        Self { lattice, separable: Vec::new(), arbitrary: Vec::new(), everywhere: 0.0 }
    }

    /// With this Gaussian as well.
    ///
    /// # Errors
    /// A constant that is not finite, or a deviation that is not positive.
    pub fn with(mut self, gaussian: Gaussian<D>) -> Result<Self, ParameterError> {
        self.separable.push(Separable::new(&self.lattice, gaussian)?);
        Ok(self)
    }

    /// With a constant inhibition of each site by all, per unit of length, area or volume.
    pub fn with_inhibition_everywhere(mut self, inhibition: f64) -> Self {
        self.everywhere -= inhibition * self.lattice.element();
        self
    }

    /// With a kernel of any form: `weight` of each displacement up to `reach` along each axis, towards a site from another one. It
    /// costs a multiplication for each site and each displacement whose weight is not 0.
    pub fn with_kernel(mut self, reach: [f64; D], weight: impl Fn([f64; D]) -> f64) -> Self {
        let most = self.lattice.axes().iter().zip(reach).map(|(axis, reach)| (reach / axis.spacing) as i64);
        let most: Vec<i64> = most.collect();
        let count: i64 = most.iter().map(|most| 2 * most + 1).product();
        for mut number in 0..count {
            let mut offset = [0; D];
            for (offset, most) in offset.iter_mut().zip(&most).rev() {
                *offset = number % (2 * most + 1) - most;
                number /= 2 * most + 1;
            }
            let spacing = |axis: usize| self.lattice.axes()[axis].spacing;
            let weight = weight(std::array::from_fn(|axis| offset[axis] as f64 * spacing(axis)));
            if weight != 0.0 {
                self.arbitrary.push((offset, weight * self.lattice.element()));
            }
        }
        self
    }

    /// The lattice that it was made for.
    pub fn lattice(&self) -> &Lattice<D> {
        &self.lattice
    }

    /// Writes the interaction integral of each site. `output` is f(u) of each; what lies beyond an open edge is 0.
    pub fn integrate(&mut self, output: &[f64], integral: &mut [f64]) {
        let sites = self.lattice.sites();
        assert_eq!((output.len(), integral.len()), (sites, sites));
        let everywhere = if self.everywhere == 0.0 { 0.0 } else { self.everywhere * sum(output) };
        integral.fill(everywhere);
        for separable in &mut self.separable {
            separable.add(output, integral);
        }
        for (offset, weight) in &self.arbitrary {
            add_shifted(&self.lattice, *offset, *weight, output, integral);
        }
    }
}

/// Adds `weight` times the output that lies at `-offset` from each site.
fn add_shifted<const D: usize>(
    lattice: &Lattice<D>,
    offset: [i64; D],
    weight: f64,
    output: &[f64],
    integral: &mut [f64],
) {
    let last = lattice.axes()[D - 1];
    let rows = integral.chunks_exact_mut(last.sites).enumerate();
    for (row, integral) in rows {
        let Some(from) = shifted_row(lattice, row, offset) else { continue };
        let from = &output[from * last.sites..][..last.sites];
        let shift = offset[D - 1];
        if last.circular {
            let split = shift.rem_euclid(last.sites as i64) as usize;
            add_row(&mut integral[split..], weight, from);
            add_row(&mut integral[..split], weight, &from[last.sites - split..]);
        } else if shift.unsigned_abs() < last.sites as u64 {
            let by = shift.unsigned_abs() as usize;
            match shift >= 0 {
                true => add_row(&mut integral[by..], weight, from),
                false => add_row(integral, weight, &from[by..]),
            }
        }
    }
}

/// The row that lies at `-offset` from this one, by all axes but the last.
fn shifted_row<const D: usize>(lattice: &Lattice<D>, mut row: usize, offset: [i64; D]) -> Option<usize> {
    let (mut from, mut stride) = (0, 1);
    for (axis, offset) in lattice.axes().iter().zip(offset).take(D - 1).rev() {
        let number = (row % axis.sites) as i64 - offset;
        from += axis.site(number)? * stride;
        (row, stride) = (row / axis.sites, stride * axis.sites);
    }
    Some(from)
}

fn add_row(integral: &mut [f64], weight: f64, output: &[f64]) {
    for (integral, output) in integral.iter_mut().zip(output) {
        *integral += weight * output;
    }
}
