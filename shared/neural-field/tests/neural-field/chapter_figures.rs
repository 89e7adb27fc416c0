//! Figures 3 and 4 of the chapter, and the limits of peak existence, found in simulation.
#![allow(clippy::unwrap_used)]

use coact_neural_field::{Existence, Field, Forgetting, Kernel, Parameters, forget};
use proptest::prelude::*;

const KERNEL: Kernel = Kernel { amplitude: 3.0, sigma: 2.0, inhibition: 0.6, range: None };
/// 30 units of length: five peaks' widths.
const WIDTH: usize = 60;

fn parameters(kernel: Kernel) -> Parameters {
    Parameters { tau: 20.0, slope: 5.0, threshold: 0.0, spacing: 0.5, input_sigma: 2.0, kernel }
}

/// A field at rest that can be driven for a while.
struct Bench {
    field: Field,
    resting: Vec<f64>,
    activity: Vec<f64>,
    input: Vec<f64>,
}

impl Bench {
    fn new(parameters: Parameters, populations: usize, h: f64) -> Self {
        let field = Field::new(parameters, populations, WIDTH).unwrap();
        let sites = field.sites();
        Self { field, resting: vec![h; populations], activity: vec![h; sites], input: vec![0.0; sites] }
    }

    fn drive(&mut self, steps: usize, strength: &[f64]) -> Vec<f64> {
        let mut next = self.activity.clone();
        for _ in 0..steps {
            self.field.spread(strength, &mut self.input);
            self.field.step(1.0, &self.activity, &self.input, &self.resting, &mut next);
            std::mem::swap(&mut self.activity, &mut next);
        }
        let mut signal = vec![0.0; strength.len()];
        self.field.signals(&self.activity, &mut signal);
        signal
    }

    fn highest(&self, population: usize) -> f64 {
        self.activity[population * WIDTH..][..WIDTH].iter().copied().fold(f64::MIN, f64::max)
    }
}

#[test]
fn figure_3_strong_input_leaves_a_peak_that_sustains_itself() {
    let mut bench = Bench::new(parameters(KERNEL), 1, -2.0);
    bench.drive(300, &[3.0]);
    assert!(bench.drive(3000, &[0.0])[0] > 0.99);
}

#[test]
fn figure_3_weak_input_leaves_a_pattern_below_threshold_that_fades() {
    let mut bench = Bench::new(parameters(KERNEL), 1, -2.0);
    assert_eq!(bench.drive(3000, &[0.9]), [0.0]);
    let preshape = bench.highest(0);
    assert!(-1.2 < preshape && preshape < -0.3, "preshaped to {preshape}");
    bench.drive(3000, &[0.0]);
    assert!((bench.highest(0) + 2.0).abs() < 0.01);
}

#[test]
fn figure_3_a_field_without_input_stays_at_rest() {
    let mut bench = Bench::new(parameters(KERNEL), 3, -2.0);
    assert_eq!(bench.drive(3000, &[0.0; 3]), [0.0; 3]);
    // The resting state of a sigmoid is not exactly h: every site's small output reaches all others.
    assert!(bench.activity.iter().all(|u| (u + 2.0).abs() < 0.02));
}

#[test]
fn figure_4_the_population_with_the_strongest_input_wins_and_suppresses_the_others() {
    let kernel = Kernel { inhibition: 1.5, ..KERNEL };
    let mut bench = Bench::new(parameters(kernel), 4, -3.0);
    // All four are preshaped: below threshold, none decided.
    let preshape = [1.5, 1.5, 1.2, 1.8];
    assert_eq!(bench.drive(1000, &preshape), [0.0; 4]);
    let before = bench.highest(3);
    // The additional input to A2 triggers the decision.
    let signal = bench.drive(1000, &[1.5, 3.0, 1.2, 1.8]);
    assert!(signal[1] > 0.99);
    assert_eq!([signal[0], signal[2], signal[3]], [0.0; 3]);
    assert!(
        bench.highest(3) < before && bench.highest(3) < -3.0,
        "suppressed below rest: {}",
        bench.highest(3)
    );
}

/// Whether a peak that strong input made at a high resting level survives at `h` without input.
fn peak_stands_at(kernel: Kernel, h: f64) -> bool {
    // Steep and fine-grained, as the condition assumes: 0.1 between sites.
    let steep = Parameters { slope: 40.0, tau: 60.0, spacing: 0.1, ..parameters(kernel) };
    let field = Field::new(steep, 1, 5 * WIDTH).unwrap();
    let sites = field.sites();
    let mut bench =
        Bench { field, resting: vec![-1.0], activity: vec![-1.0; sites], input: vec![0.0; sites] };
    bench.drive(600, &[4.0]);
    bench.resting = vec![h];
    bench.drive(3000, &[0.0])[0] > 0.5
}

#[test]
fn peaks_cease_to_exist_where_amari_s_condition_says() {
    for inhibition in [0.6, 1.0, 1.5] {
        let kernel = Kernel { inhibition, ..KERNEL };
        let limit = -Existence::of(&kernel).unwrap().largest_integral;
        // Bisect the resting level at which the peak is lost in simulation.
        let (mut holds, mut lost) = (limit + 1.0, limit - 1.0);
        assert!(peak_stands_at(kernel, holds) && !peak_stands_at(kernel, lost));
        while holds - lost > 0.02 {
            let middle = f64::midpoint(holds, lost);
            if peak_stands_at(kernel, middle) { holds = middle } else { lost = middle }
        }
        // The sigmoid is not quite a step, and sites stand apart: 3 % of the limit.
        assert!((lost - limit).abs() < 0.03 * limit.abs(), "derived {limit}, simulated {lost}");
    }
}

#[test]
fn a_memory_whose_support_is_gone_is_given_up_and_can_be_formed_again() {
    let kernel = Kernel { inhibition: 1.0, range: Some(12.0), ..KERNEL };
    let forgetting = Forgetting { h_max: -2.0, h_min: -6.0, r_min: 0.02, r_max: 0.02 };
    let mut bench = Bench::new(parameters(kernel), 2, -2.0);
    bench.drive(300, &[3.0, 3.0]);
    for _ in 0..500 {
        bench.resting[0] = forget(bench.resting[0], 1.0, 1.0, &forgetting);
        bench.drive(1, &[0.0; 2]);
    }
    let signal = bench.drive(1, &[0.0; 2]);
    assert!(signal[0] == 0.0 && signal[1] > 0.99, "only the first is forgotten: {signal:?}");
    for _ in 0..500 {
        bench.resting[0] = forget(bench.resting[0], 0.0, 1.0, &forgetting);
    }
    bench.drive(300, &[3.0, 0.0]);
    assert!(bench.drive(1000, &[0.0; 2]).iter().all(|&signal| signal > 0.99));
}

#[test]
fn a_memory_forms_between_others_in_whatever_order_they_were_formed() {
    // With inhibition across populations the peaks of the outer pairs pushed each other towards the middle one, which never came.
    let kernel = Kernel { inhibition: 1.0, range: Some(6.0), ..KERNEL };
    for middle in 0..5 {
        let mut bench = Bench::new(parameters(kernel), 5, -2.0);
        let mut input = [3.0; 5];
        input[middle] = 0.0;
        assert_eq!(bench.drive(2000, &input)[middle], 0.0);
        let signal = bench.drive(200, &[3.0; 5]);
        assert!(signal.iter().all(|&signal| signal > 0.99), "{middle} comes last: {signal:?}");
    }
}

proptest! {
    #[test]
    fn a_decision_layer_never_holds_two_peaks(first in 1.0..2.5f64, ratio in 0.0..0.99f64) {
        let kernel = Kernel { amplitude: 4.3, inhibition: 2.8, ..KERNEL };
        let mut bench = Bench::new(parameters(kernel), 3, -3.0);
        let winner = 2.38 * first;
        let signal = bench.drive(1500, &[winner, winner * ratio, 0.0]);
        prop_assert!(signal.iter().filter(|&&signal| signal > 0.0).count() <= 1, "{:?}", signal);
    }

    #[test]
    fn stable_width_satisfies_amari_s_condition(inhibition in 0.3..1.8f64, depth in 0.05..0.95f64) {
        let kernel = Kernel { inhibition, ..KERNEL };
        let existence = Existence::of(&kernel).unwrap();
        let h = -depth * existence.largest_integral;
        let width = existence.stable_width(&kernel, h).unwrap();
        prop_assert!(kernel.weight(width) < 0.0, "stable where w(a) < 0");
        // W(a) by a plain sum, independent of the crate's own rule.
        let steps = 20_000;
        let step = width / f64::from(steps);
        let integral: f64 = (0..steps).map(|i| kernel.weight((f64::from(i) + 0.5) * step) * step).sum();
        prop_assert!((integral + h).abs() < 1e-6);
    }
}
