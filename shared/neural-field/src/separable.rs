use crate::taps::{self, Taps};
use crate::{Axis, Gaussian, Lattice, ParameterError};

/// A Gaussian as taps along each axis: convolved along one after the other, it costs the sum of their lengths for each site, not their
/// product.
#[derive(Debug, Clone)]
pub(crate) struct Separable<const D: usize> {
    taps: [Taps; D],
    /// Between the axes; one is read while the other is written.
    between: [Vec<f64>; 2],
    /// A stretch along the last axis with its borders.
    bordered: Vec<f64>,
    /// What lies beyond an open edge.
    nothing: Vec<f64>,
}

/// So many sites are computed at a time, in registers, while all taps are gone through.
const BLOCK: usize = 32;

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
        let taps = std::array::from_fn(|axis| {
            // The first axis carries the amplitude.
            let amplitude = if axis == 0 { amplitude } else { 1.0 };
            Taps::gaussian(&lattice.axes()[axis], amplitude, sigma[axis])
        });
        let sites = lattice.sites();
        let last = lattice.axes()[D - 1].sites + 2 * taps[D - 1].beyond.len();
        let widest = (0..D).map(|axis| lattice.strides(axis).1).max().unwrap_or(0);
        Ok(Self {
            taps,
            between: [vec![0.0; sites], vec![0.0; sites]],
            bordered: vec![0.0; last],
            nothing: vec![0.0; widest],
        })
    }

    /// Adds the convolution of `output` to `integral`.
    pub fn add(&mut self, lattice: &Lattice<D>, output: &[f64], integral: &mut [f64]) {
        let Self { taps, between, bordered, nothing } = self;
        let last = &lattice.axes()[D - 1];
        let [read, write] = between;
        for (output, write) in output.chunks_exact(last.sites).zip(write.chunks_exact_mut(last.sites)) {
            border(last, &taps[D - 1], output, bordered);
            along_row(bordered, &taps[D - 1], write);
        }
        for axis in (0..D - 1).rev() {
            std::mem::swap(read, write);
            let (_, stride) = lattice.strides(axis);
            let stretch = stride * lattice.axes()[axis].sites;
            for (from, to) in read.chunks_exact(stretch).zip(write.chunks_exact_mut(stretch)) {
                across_rows(&lattice.axes()[axis], from, &taps[axis], &nothing[..stride], to);
            }
        }
        for (integral, own) in integral.iter_mut().zip(&*write) {
            *integral += own;
        }
    }
}

/// Copies a stretch, with what lies beyond its ends.
fn border(axis: &Axis, taps: &Taps, output: &[f64], bordered: &mut [f64]) {
    let (reach, sites) = (taps.beyond.len(), output.len());
    bordered[reach..reach + sites].copy_from_slice(output);
    // Beyond an open end there is nothing, and was nothing before.
    if axis.circular {
        bordered[..reach].copy_from_slice(&output[sites - reach..]);
        bordered[reach + sites..].copy_from_slice(&output[..reach]);
    }
}

/// Convolves a stretch that has its borders.
#[multiversion::multiversion(targets("x86_64+avx512f", "x86_64+avx2"))]
fn along_row(bordered: &[f64], taps: &Taps, to: &mut [f64]) {
    let reach = taps.beyond.len();
    let mut at = 0;
    for block in to.chunks_mut(BLOCK) {
        let width = block.len();
        let row = |offset: usize| &bordered[at + offset..][..width];
        convolve(block, taps, |tap| [row(reach - tap), row(reach + tap)]);
        at += width;
    }
}

/// Convolves rows that lie beside each other, across them.
#[multiversion::multiversion(targets("x86_64+avx512f", "x86_64+avx2"))]
fn across_rows(axis: &Axis, from: &[f64], taps: &Taps, nothing: &[f64], to: &mut [f64]) {
    let stride = nothing.len();
    for (number, to) in to.chunks_exact_mut(stride).enumerate() {
        let mut at = 0;
        for block in to.chunks_mut(BLOCK) {
            let width = block.len();
            let row = |number: i64| {
                let row = axis.site(number).map_or(nothing, |site| &from[site * stride..][..stride]);
                &row[at..][..width]
            };
            let number = number as i64;
            convolve(block, taps, |tap| [row(number - tap as i64), row(number + tap as i64)]);
            at += width;
        }
    }
}

/// Writes one block; `at` returns what lies so many sites to both sides of it.
#[inline(always)]
fn convolve<'a>(block: &mut [f64], taps: &Taps, at: impl Fn(usize) -> [&'a [f64]; 2]) {
    let [own, _] = at(0);
    let beyond = taps.beyond.iter().enumerate();
    let Ok(full) = <&mut [f64; BLOCK]>::try_from(&mut *block) else {
        block.iter_mut().zip(own).for_each(|(sum, own)| *sum = taps.centre * own);
        for (index, weight) in beyond {
            let [left, right] = at(index + 1);
            for ((sum, left), right) in block.iter_mut().zip(left).zip(right) {
                *sum += weight * (left + right);
            }
        }
        return;
    };
    // As an array of known length the sums stay in registers.
    let mut sums: [f64; BLOCK] = std::array::from_fn(|site| taps.centre * own[site]);
    for (index, weight) in beyond {
        let [left, right] = at(index + 1).map(|row| &row[..BLOCK]);
        for ((sum, left), right) in sums.iter_mut().zip(left).zip(right) {
            *sum += weight * (left + right);
        }
    }
    *full = sums;
}
