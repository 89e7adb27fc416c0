use crate::Kernel;

/// When a self-sustained peak can stand, from Amari's condition (Amari 1977; steep threshold, infinite field, u0 = 0).
///
/// With W(a) = integral of w from 0 to a, a peak of width a exists without input if W(a) = -h, and is stable if
/// w(a) < 0. Peaks stand for -W_max < h < 0, where W_max is the largest value of W.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Existence {
    /// Width at which W is largest: w(a) = 0.
    pub critical_width: f64,
    /// W_max: the resting level at which peaks cease to exist is its negative.
    pub largest_integral: f64,
}

impl Existence {
    /// The limits of `kernel`; `None` when its inhibition is too weak or too strong for localised peaks.
    pub fn of(kernel: &Kernel) -> Option<Self> {
        let Kernel { amplitude, sigma, inhibition, .. } = *kernel;
        if !(inhibition > 0.0 && amplitude > inhibition) {
            return None;
        }
        let critical_width = sigma * (2.0 * (amplitude / inhibition).ln()).sqrt();
        Some(Self { critical_width, largest_integral: integral(kernel, critical_width) })
    }

    /// Width of the stable peak at resting level `h` without input; `None` where none exists.
    pub fn stable_width(&self, kernel: &Kernel, h: f64) -> Option<f64> {
        if h >= 0.0 || -h >= self.largest_integral {
            return None;
        }
        // W falls beyond the critical width: double until it is below -h, then halve.
        let (mut low, mut high) = (self.critical_width, 2.0 * self.critical_width);
        while integral(kernel, high) > -h {
            (low, high) = (high, 2.0 * high);
        }
        for _ in 0..80 {
            let middle = f64::midpoint(low, high);
            if integral(kernel, middle) > -h { low = middle } else { high = middle }
        }
        Some(f64::midpoint(low, high))
    }
}

/// W(a), by Simpson's rule: the integrand is smooth, 200 intervals give more than ten digits.
fn integral(kernel: &Kernel, a: f64) -> f64 {
    const INTERVALS: usize = 200;
    let step = a / INTERVALS as f64;
    let weight = |index: usize| kernel.weight(index as f64 * step);
    let odd: f64 = (1..INTERVALS).step_by(2).map(weight).sum();
    let even: f64 = (2..INTERVALS).step_by(2).map(weight).sum();
    (weight(0) + 4.0 * odd + 2.0 * even + weight(INTERVALS)) * step / 3.0
}
