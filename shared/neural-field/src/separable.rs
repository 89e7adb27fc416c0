use crate::convolution::Convolution;
use crate::taps::{self, Taps};
use crate::{Gaussian, Lattice, ParameterError};

/// A Gaussian as taps along each axis: convolved along one after the other, it costs the sum of their lengths for each site, not their
/// product.
#[derive(Debug, Clone)]
pub(crate) struct Separable<const D: usize> {
    along: [Convolution; D],
    /// Between the axes; one is read while the other is written.
    between: [Vec<f64>; 2],
}

impl<const D: usize> Separable<D> {
    pub fn new(lattice: &Lattice<D>, gaussian: Gaussian<D>) -> Result<Self, ParameterError> {
        let Gaussian { amplitude, sigma } = gaussian;
        ParameterError::unless_finite("amplitude", amplitude)?;
        for (sigma, axis) in sigma.into_iter().zip(lattice.axes()) {
            if !(sigma > 0.0 && taps::CUT_OFF * sigma / axis.spacing < 1e6) {
                let expected = "above 0, and less than 200000 times the spacing";
                return Err(ParameterError { name: "sigma", value: sigma, expected });
            }
        }
        let along = std::array::from_fn(|number| {
            let axis = &lattice.axes()[number];
            // The first axis carries the amplitude.
            let amplitude = if number == 0 { amplitude } else { 1.0 };
            Convolution::new(axis, lattice.strides(number).1, Taps::gaussian(axis, amplitude, sigma[number]))
        });
        let between = if D > 1 { lattice.sites() } else { 0 };
        Ok(Self { along, between: [vec![0.0; between], vec![0.0; between]] })
    }

    /// Adds the convolution of `output` to `integral`.
    pub fn add(&mut self, output: &[f64], integral: &mut [f64]) {
        let [mut read, mut write] = self.between.each_mut();
        for axis in (0..D).rev() {
            let from = if axis == D - 1 { output } else { &*read };
            let to = if axis == 0 { &mut *integral } else { &mut *write };
            if axis > 0 {
                to.fill(0.0);
            }
            self.along[axis].add_each(from, to);
            std::mem::swap(&mut read, &mut write);
        }
    }
}
