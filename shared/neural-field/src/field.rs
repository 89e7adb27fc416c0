use crate::convolution::Convolution;
use crate::taps::{CUT_OFF, Taps};
use crate::{Axis, ParameterError, Parameters, sigmoid};

/// One layer: a row of sites, divided into populations of equal width, each centred on its input.
///
/// Activity lives with the caller, in slices of [`Field::sites`] values; populations' values in slices of
/// [`Field::populations`] values. A slice of another length is a programming error and panics.
#[derive(Debug, Clone)]
pub struct Field {
    parameters: Parameters,
    populations: usize,
    width: usize,
    /// Of all sites that interact: all, or those of one population where each is alone. Inhibition that reaches everywhere is not in it.
    interaction: Convolution,
    /// Gaussian input of strength 1 across one population.
    bump: Vec<f64>,
    /// f(u) of all sites.
    output: Vec<f64>,
}

impl Field {
    /// A field of `populations` populations with `width` sites each.
    ///
    /// # Errors
    /// A constant that is out of its range.
    pub fn new(parameters: Parameters, populations: usize, width: usize) -> Result<Self, ParameterError> {
        parameters.check()?;
        let Parameters { spacing, input_sigma, kernel, .. } = parameters;
        let gauss = |d: f64, sigma: f64| (-d * d / (2.0 * sigma * sigma)).exp();
        // A layer without interaction has no taps to pay for.
        let excited = if kernel.amplitude > 0.0 { CUT_OFF * kernel.sigma } else { 0.0 };
        let reach = (excited.max(kernel.range.unwrap_or(0.0)) / spacing).ceil() as usize;
        let interaction = |site: usize| {
            let d = site as f64 * spacing;
            let inhibition =
                if kernel.range.is_some_and(|range| d <= range) { kernel.inhibition } else { 0.0 };
            (kernel.amplitude * gauss(d, kernel.sigma) - inhibition) * spacing
        };
        let taps = Taps { centre: interaction(0), beyond: (1..=reach).map(interaction).collect() };
        let sites = populations * width;
        let together = if kernel.range.is_some() { width } else { sites };
        let row = Axis { sites: together, spacing, origin: 0.0, circular: false };
        let middle = (width - 1) as f64 / 2.0;
        Ok(Self {
            parameters,
            populations,
            width,
            interaction: Convolution::new(&row, 1, taps),
            bump: (0..width).map(|site| gauss((site as f64 - middle) * spacing, input_sigma)).collect(),
            output: vec![0.0; sites],
        })
    }

    /// Number of sites.
    pub fn sites(&self) -> usize {
        self.populations * self.width
    }

    /// Number of populations.
    pub fn populations(&self) -> usize {
        self.populations
    }

    /// The constants that it was made with.
    pub fn parameters(&self) -> &Parameters {
        &self.parameters
    }

    /// Writes S(x) of one Gaussian of strength `strength[m]` on each population m (chapter, eq. 4).
    pub fn spread(&self, strength: &[f64], input: &mut [f64]) {
        assert_eq!((strength.len(), input.len()), (self.populations, self.sites()));
        for (tile, &strength) in input.chunks_exact_mut(self.width).zip(strength) {
            for (input, bump) in tile.iter_mut().zip(&self.bump) {
                *input = strength * bump;
            }
        }
    }

    /// One explicit Euler step of `dt` (chapter, eq. 1): reads `now`, writes `next`.
    ///
    /// `resting[m]` is h of population m. Costs 5 sigma / dx multiplications and one exponential per site.
    pub fn step(&mut self, dt: f64, now: &[f64], input: &[f64], resting: &[f64], next: &mut [f64]) {
        let sites = self.sites();
        assert_eq!((now.len(), input.len(), next.len()), (sites, sites, sites));
        assert_eq!(resting.len(), self.populations);
        let everywhere = self.interact(now, next);
        let rate = dt / self.parameters.tau;
        let tiles = next.chunks_exact_mut(self.width).zip(now.chunks_exact(self.width));
        for ((tile, &h), input) in tiles.zip(resting).zip(input.chunks_exact(self.width)) {
            let (next, now) = tile;
            for ((next, &u), &s) in next.iter_mut().zip(now).zip(input) {
                *next = u + rate * (h - u + s + *next - everywhere);
            }
        }
    }

    /// Writes the interaction integral of each site (chapter, eq. 1 and 2), but for inhibition that reaches everywhere,
    /// which is the same for all sites and returned.
    fn interact(&mut self, now: &[f64], integral: &mut [f64]) -> f64 {
        let Parameters { slope, threshold, spacing, kernel, .. } = self.parameters;
        integral.fill(0.0);
        if kernel.amplitude == 0.0 && kernel.inhibition == 0.0 {
            return 0.0;
        }
        fire(&mut self.output, now, slope, threshold);
        self.interaction.add_each(&self.output, integral);
        match kernel.range {
            None => kernel.inhibition * spacing * sum(&self.output),
            Some(_) => 0.0,
        }
    }

    /// Signal c of each population: 0 while its centre is below threshold, growing to 1 with its peak.
    ///
    /// Equation 4 asks for a function that signals the existence or evolution of a peak: c = max(0, 2 f(u) - 1).
    pub fn signals(&self, activity: &[f64], signal: &mut [f64]) {
        assert_eq!((activity.len(), signal.len()), (self.sites(), self.populations));
        let Parameters { slope, threshold, .. } = self.parameters;
        for (signal, tile) in signal.iter_mut().zip(activity.chunks_exact(self.width)) {
            let centre = f64::midpoint(tile[(self.width - 1) / 2], tile[self.width / 2]);
            // Most populations are below threshold, and need no exponential to say so.
            *signal = if centre > threshold { 2.0 * sigmoid(centre, slope, threshold) - 1.0 } else { 0.0 };
        }
    }
}

/// Writes f(u) of all sites.
///
/// The hot loops, this and those of convolution, are compiled for wider registers as well, and chosen at run time: none fuses or
/// reorders operations, so that every machine computes the same bits.
#[multiversion::multiversion(targets("x86_64+avx512f", "x86_64+avx2"))]
pub(crate) fn fire(output: &mut [f64], now: &[f64], slope: f64, threshold: f64) {
    for (output, &u) in output.iter_mut().zip(now) {
        *output = sigmoid(u, slope, threshold);
    }
}

/// Sum of all outputs, in eight partial sums: one alone would wait for each addition.
pub(crate) fn sum(output: &[f64]) -> f64 {
    let mut partial = [0.0; 8];
    let chunks = output.chunks_exact(8);
    let rest: f64 = chunks.remainder().iter().sum();
    for chunk in chunks {
        for (partial, output) in partial.iter_mut().zip(chunk) {
            *partial += output;
        }
    }
    rest + partial.iter().sum::<f64>()
}
