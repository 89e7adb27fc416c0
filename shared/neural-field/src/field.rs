use crate::{ParameterError, Parameters, sigmoid};

/// One layer: a row of sites, divided into populations of equal width, each centred on its input.
///
/// Activity lives with the caller, in slices of [`Field::sites`] values; populations' values in slices of
/// [`Field::populations`] values. A slice of another length is a programming error and panics.
#[derive(Debug, Clone)]
pub struct Field {
    parameters: Parameters,
    populations: usize,
    width: usize,
    /// Excitation at distances 1, 2, .. sites, times dx; the sites' own at `centre`.
    taps: Vec<f64>,
    centre: f64,
    /// Gaussian input of strength 1 across one population.
    bump: Vec<f64>,
    /// f(u) of all sites, with a border of zeros on both sides as wide as the taps.
    output: Vec<f64>,
    /// Running sum of `output`, for inhibition of limited range.
    sum: Vec<f64>,
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
        let reach = (5.0 * kernel.sigma / spacing).ceil() as usize;
        let sites = populations * width;
        let middle = (width - 1) as f64 / 2.0;
        Ok(Self {
            parameters,
            populations,
            width,
            taps: (1..=reach)
                .map(|d| kernel.amplitude * spacing * gauss(d as f64 * spacing, kernel.sigma))
                .collect(),
            centre: kernel.amplitude * spacing,
            bump: (0..width).map(|site| gauss((site as f64 - middle) * spacing, input_sigma)).collect(),
            output: vec![0.0; sites + 2 * reach],
            sum: vec![0.0; sites + 1],
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
    /// `resting[m]` is h of population m. Costs one convolution of 10 sigma / dx taps and one exponential per site.
    pub fn step(&mut self, dt: f64, now: &[f64], input: &[f64], resting: &[f64], next: &mut [f64]) {
        let sites = self.sites();
        assert_eq!((now.len(), input.len(), next.len()), (sites, sites, sites));
        assert_eq!(resting.len(), self.populations);
        self.excite(now, next);
        self.inhibit(next);
        let rate = dt / self.parameters.tau;
        let tiles = next.chunks_exact_mut(self.width).zip(now.chunks_exact(self.width));
        for ((tile, &h), input) in tiles.zip(resting).zip(input.chunks_exact(self.width)) {
            let (next, now) = tile;
            for ((next, &u), &s) in next.iter_mut().zip(now).zip(input) {
                *next = u + rate * (h - u + s + *next);
            }
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
            *signal = (2.0 * sigmoid(centre, slope, threshold) - 1.0).max(0.0);
        }
    }

    /// Writes the Gaussian part of the interaction integral.
    fn excite(&mut self, now: &[f64], interaction: &mut [f64]) {
        let Parameters { slope, threshold, .. } = self.parameters;
        let (reach, sites) = (self.taps.len(), now.len());
        for (output, &u) in self.output[reach..].iter_mut().zip(now) {
            *output = sigmoid(u, slope, threshold);
        }
        let output = &self.output;
        for (interaction, &own) in interaction.iter_mut().zip(&output[reach..]) {
            *interaction = self.centre * own;
        }
        for (index, &weight) in self.taps.iter().enumerate() {
            let left = &output[reach - index - 1..][..sites];
            let right = &output[reach + index + 1..][..sites];
            for ((interaction, &left), &right) in interaction.iter_mut().zip(left).zip(right) {
                *interaction += weight * (left + right);
            }
        }
    }

    /// Subtracts the constant part of the interaction integral.
    fn inhibit(&mut self, interaction: &mut [f64]) {
        let Parameters { spacing, kernel, .. } = self.parameters;
        let reach = self.taps.len();
        let sites = interaction.len();
        let mut running = 0.0;
        for (sum, &output) in self.sum[1..].iter_mut().zip(&self.output[reach..]) {
            running += output;
            *sum = running;
        }
        let per_output = kernel.inhibition * spacing;
        match kernel.range {
            None => interaction.iter_mut().for_each(|interaction| *interaction -= per_output * running),
            Some(range) => {
                let range = (range / spacing) as usize;
                for (site, interaction) in interaction.iter_mut().enumerate() {
                    let (first, last) = (site.saturating_sub(range), (site + range + 1).min(sites));
                    *interaction -= per_output * (self.sum[last] - self.sum[first]);
                }
            }
        }
    }
}
