//! Metric fields against closed forms, and against sums that are computed without any trick.
#![allow(clippy::unwrap_used)]

use coact_neural_field::{
    Axis, Field, Gaussian, Interaction, Kernel, Lattice, MemoryTrace, MetricConstants, MetricField,
    Parameters, Projection,
};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

const STANDARD: MetricConstants = MetricConstants { tau: 20.0, slope: 5.0, threshold: 0.0 };

/// Axes of one kind or the other, with few sites.
fn axis() -> impl Strategy<Value = Axis> {
    let open = (2_usize..9, 0.3..1.5).prop_map(|(sites, spacing)| Axis {
        sites,
        spacing,
        origin: -1.0,
        circular: false,
    });
    let circular = (3_usize..9).prop_map(|sites| Axis::circular(0.0, TAU, sites));
    prop_oneof![open, circular]
}

/// Displacement along an axis from one site to another one, the short way round a circle; none where a kernel of this reach, in sites,
/// does not connect them.
fn displacement(axis: &Axis, from: f64, to: f64, reach: f64) -> Option<f64> {
    let sites = axis.sites as f64;
    let mut steps = ((to - from) / axis.spacing).round();
    let mut most = (reach / axis.spacing).ceil();
    if axis.circular {
        steps -= sites * (steps / sites).round();
        most = most.min(((axis.sites - 1) / 2) as f64);
    }
    (steps.abs() <= most).then_some(steps * axis.spacing)
}

/// The interaction integral by its definition: every site with every other one.
fn by_definition<const D: usize>(
    lattice: &Lattice<D>,
    gaussian: Gaussian<D>,
    inhibition: f64,
    output: &[f64],
) -> Vec<f64> {
    let weight = |from: usize, to: usize| {
        let (from, to) = (lattice.place(from), lattice.place(to));
        let mut exponent = 0.0;
        for (index, axis) in lattice.axes().iter().enumerate() {
            let sigma = gaussian.sigma[index];
            let Some(d) = displacement(axis, from[index], to[index], 5.0 * sigma) else { return 0.0 };
            exponent -= d * d / (2.0 * sigma * sigma);
        }
        gaussian.amplitude * exponent.exp()
    };
    let sum = |to: usize| -> f64 {
        (0..lattice.sites()).map(|from| (weight(from, to) - inhibition) * output[from]).sum()
    };
    (0..lattice.sites()).map(|to| sum(to) * lattice.element()).collect()
}

fn differ(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| (one - other).abs()).fold(0.0, f64::max)
}

proptest! {
    #[test]
    fn a_separable_interaction_is_the_sum_over_all_pairs_of_sites(
        axes in [axis(), axis()],
        sigma in [0.2..2.0, 0.2..2.0],
        amplitude in -2.0..3.0,
        inhibition in 0.0..0.5,
        seed in any::<u64>(),
    ) {
        let lattice = Lattice::new(axes).unwrap();
        let gaussian = Gaussian { amplitude, sigma };
        let mut interaction = Interaction::none(lattice).with(gaussian).unwrap();
        interaction = interaction.with_inhibition_everywhere(inhibition);
        let output: Vec<f64> = scattered(lattice.sites(), seed);
        let mut found = vec![0.0; lattice.sites()];
        interaction.integrate(&output, &mut found);
        // Twice: nothing of the first is left.
        interaction.integrate(&output, &mut found);
        prop_assert!(differ(&found, &by_definition(&lattice, gaussian, inhibition, &output)) < 1e-11);
    }

    #[test]
    fn an_arbitrary_kernel_that_is_a_gaussian_does_what_the_separable_one_does(
        axes in [axis(), axis(), axis()],
        sigma in 0.1..0.5_f64,
        seed in any::<u64>(),
    ) {
        // A reach within which no circle closes.
        let steps = |axis: &Axis| (5.0 * sigma / axis.spacing).ceil();
        prop_assume!(axes.iter().all(|axis| !axis.circular || steps(axis) <= (axis.sites as f64 - 1.0) / 2.0));
        let lattice = Lattice::new(axes).unwrap();
        let gaussian = Gaussian { amplitude: 1.5, sigma: [sigma; 3] };
        let reach = axes.map(|axis| steps(&axis) * axis.spacing * 1.000_001);
        let weight = |d: [f64; 3]| 1.5 * (-d.iter().map(|d| d * d).sum::<f64>() / (2.0 * sigma * sigma)).exp();
        let output = scattered(lattice.sites(), seed);
        let (mut one, mut other) = (vec![0.0; lattice.sites()], vec![0.0; lattice.sites()]);
        Interaction::none(lattice).with(gaussian).unwrap().integrate(&output, &mut one);
        Interaction::none(lattice).with_kernel(reach, weight).integrate(&output, &mut other);
        prop_assert!(differ(&one, &other) < 1e-11);
    }

    #[test]
    fn gathering_is_what_reading_is_turned_round(
        from in [axis(), axis()],
        to in [axis()],
        slope in [-0.5..0.5_f64, -0.5..0.5],
        seed in any::<u64>(),
    ) {
        let (plane, line) = (Lattice::new(from).unwrap(), Lattice::new(to).unwrap());
        let place = |[x]: [f64; 1]| Some([slope[0] * x, slope[1] * x + 0.2]);
        let reading = Projection::reading(&plane, &line, place);
        let gathering = Projection::gathering(&line, &plane, place);
        let (on_plane, on_line) = (scattered(plane.sites(), seed), scattered(line.sites(), !seed));
        let (mut read, mut gathered) = (vec![0.0; line.sites()], vec![0.0; plane.sites()]);
        reading.add(1.0, &on_plane, &mut read);
        gathering.add(1.0, &on_line, &mut gathered);
        let product = |one: &[f64], other: &[f64]| one.iter().zip(other).map(|(one, other)| one * other).sum::<f64>();
        let [one, other] = [product(&read, &on_line) * line.element(), product(&gathered, &on_plane) * plane.element()];
        prop_assert!((one - other).abs() < 1e-11, "{one} {other}");
    }

    #[test]
    fn a_trace_does_not_depend_on_the_length_of_its_steps(f in 0.0..1.0, start in 0.0..1.0, steps in 1..50) {
        let memory = MemoryTrace { build: 200.0, decay: 5000.0 };
        let (mut once, mut often) = ([start], [start]);
        memory.step(100.0, &[f], &mut once);
        (0..steps).for_each(|_| memory.step(100.0 / f64::from(steps), &[f], &mut often));
        prop_assert!((once[0] - often[0]).abs() < 1e-12);
    }
}

/// Numbers from 0 to 1 that a seed decides.
fn scattered(count: usize, seed: u64) -> Vec<f64> {
    let mut state = seed | 1;
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    (0..count).map(|_| next()).collect()
}

#[test]
fn in_one_dimension_a_metric_field_is_a_field_with_one_population() {
    let kernel = Kernel { amplitude: 3.0, sigma: 2.0, inhibition: 0.6, range: None };
    let parameters =
        Parameters { tau: 20.0, slope: 5.0, threshold: 0.0, spacing: 0.5, input_sigma: 2.0, kernel };
    let mut row = Field::new(parameters, 1, 101).unwrap();
    let lattice = Lattice::new([Axis::open(-25.0, 25.0, 0.5)]).unwrap();
    let interaction = Interaction::none(lattice).with(Gaussian { amplitude: 3.0, sigma: [2.0] }).unwrap();
    let mut metric = MetricField::new(STANDARD, interaction.with_inhibition_everywhere(0.6)).unwrap();
    let mut input = vec![0.0; 101];
    row.spread(&[4.0], &mut input);
    let (mut one, mut other, mut next) = (vec![-2.0; 101], vec![-2.0; 101], vec![0.0; 101]);
    for _ in 0..200 {
        row.step(1.0, &one, &input, &[-2.0], &mut next);
        std::mem::swap(&mut one, &mut next);
        metric.step(1.0, &other, &input, -2.0, &mut next);
        std::mem::swap(&mut other, &mut next);
    }
    assert!(one[50] > 1.0, "a peak stands");
    assert!(differ(&one, &other) < 1e-9, "{}", differ(&one, &other));
}

#[test]
fn without_interaction_each_site_relaxes_as_the_equation_says() {
    let lattice = Lattice::new([Axis::open(0.0, 3.0, 1.0), Axis::circular(0.0, TAU, 5)]).unwrap();
    let mut field = MetricField::new(STANDARD, Interaction::none(lattice)).unwrap();
    let (start, input) = (scattered(20, 7), scattered(20, 11));
    let (mut now, mut next) = (start.clone(), vec![0.0; 20]);
    for _ in 0..60 {
        field.step(1.0, &now, &input, -0.3, &mut next);
        std::mem::swap(&mut now, &mut next);
    }
    let left = (1.0_f64 - 1.0 / 20.0).powi(60);
    let expected: Vec<f64> = start.iter().zip(&input).map(|(u, s)| s - 0.3 + (u - s + 0.3) * left).collect();
    assert!(differ(&now, &expected) < 1e-12);
}

/// w integrated over a disc of this radius, as seen from its rim: 0 at -h is where a circular peak of that radius stands (S. Amari,
/// Biol. Cybern. 27, 1977, for one dimension; J. Taylor, Biol. Cybern. 80, 1999, for two).
fn over_disc(radius: f64, weight: impl Fn(f64) -> f64) -> f64 {
    const STEPS: usize = 400;
    let mut sum = 0.0;
    for ring in 0..STEPS {
        let r = radius * (ring as f64 + 0.5) / STEPS as f64;
        for step in 0..STEPS {
            let angle = TAU * (step as f64 + 0.5) / STEPS as f64;
            let d = (r * angle.cos() - radius).hypot(r * angle.sin());
            sum += weight(d) * r;
        }
    }
    sum * radius / STEPS as f64 * TAU / STEPS as f64
}

#[test]
fn a_peak_in_two_dimensions_is_as_wide_as_amaris_condition_says() {
    let (amplitude, sigma, inhibition, h) = (1.0, 2.0, 0.25, -2.0);
    let weight = |d: f64| amplitude * (-d * d / (2.0 * sigma * sigma)).exp() - inhibition;
    let (mut small, mut large) = (2.5, 8.0);
    assert!(over_disc(small, weight) > -h && over_disc(large, weight) < -h, "the stable radius lies between");
    for _ in 0..40 {
        let middle = f64::midpoint(small, large);
        if over_disc(middle, weight) > -h { small = middle } else { large = middle }
    }
    let lattice = Lattice::new([Axis::open(-10.0, 10.0, 0.25); 2]).unwrap();
    let interaction = Interaction::none(lattice).with(Gaussian { amplitude, sigma: [sigma; 2] }).unwrap();
    // So steep that a site is on or off.
    let steep = MetricConstants { tau: 100.0, slope: 100.0, threshold: 0.0 };
    let mut field = MetricField::new(steep, interaction.with_inhibition_everywhere(inhibition)).unwrap();
    let bump = |site: usize| {
        let [x, y] = lattice.place(site);
        6.0 * (-(x * x + y * y) / 8.0).exp()
    };
    let (input, nothing): (Vec<f64>, _) =
        ((0..lattice.sites()).map(bump).collect(), vec![0.0; lattice.sites()]);
    let (mut now, mut next) = (vec![h; lattice.sites()], vec![0.0; lattice.sites()]);
    for step in 0..3000 {
        field.step(1.0, &now, if step < 300 { &input } else { &nothing }, h, &mut next);
        std::mem::swap(&mut now, &mut next);
    }
    let area = now.iter().filter(|u| **u > 0.0).count() as f64 * lattice.element();
    let radius = (area / PI).sqrt();
    assert!((radius / small - 1.0).abs() < 0.02, "{radius}, expected {small}");
}

#[test]
fn of_two_places_in_a_plane_the_one_with_more_input_wins() {
    let lattice = Lattice::new([Axis::open(0.0, 40.0, 1.0), Axis::open(0.0, 30.0, 1.0)]).unwrap();
    let interaction = Interaction::none(lattice).with(Gaussian { amplitude: 1.0, sigma: [2.0; 2] }).unwrap();
    let mut field = MetricField::new(STANDARD, interaction.with_inhibition_everywhere(0.25)).unwrap();
    let bump = |site: usize, [x, y]: [f64; 2]| {
        let at = lattice.place(site);
        (-((at[0] - x).powi(2) + (at[1] - y).powi(2)) / 8.0).exp()
    };
    let input = |site| 4.0 * bump(site, [10.0, 8.0]) + 3.2 * bump(site, [28.0, 20.0]);
    let input: Vec<f64> = (0..lattice.sites()).map(input).collect();
    let (mut now, mut next) = (vec![-2.0; lattice.sites()], vec![0.0; lattice.sites()]);
    for _ in 0..400 {
        field.step(1.0, &now, &input, -2.0, &mut next);
        std::mem::swap(&mut now, &mut next);
    }
    let above = (0..lattice.sites()).filter(|site| now[*site] > 0.0).map(|site| lattice.place(site));
    let above: Vec<_> = above.collect();
    assert!(!above.is_empty());
    assert!(above.iter().all(|[x, y]| (x - 10.0).hypot(y - 8.0) < 8.0), "{above:?}");
}

#[test]
fn a_turned_and_moved_frame_shows_a_bump_where_it_then_is() {
    let plane = Lattice::new([Axis::open(-10.0, 10.0, 0.2); 2]).unwrap();
    let bump = |[x, y]: [f64; 2], [a, b]: [f64; 2]| (-((x - a).powi(2) + (y - b).powi(2)) / 2.0).exp();
    let world: Vec<f64> = (0..plane.sites()).map(|site| bump(plane.place(site), [3.0, 1.0])).collect();
    // The hand is at (1, -2), turned by a quarter and some.
    let (sin, cos) = 1.7_f64.sin_cos();
    let to_world = |[x, y]: [f64; 2]| Some([1.0 + cos * x - sin * y, -2.0 + sin * x + cos * y]);
    let mut seen = vec![0.0; plane.sites()];
    Projection::reading(&plane, &plane, to_world).add(1.0, &world, &mut seen);
    let in_hand = [cos * 2.0 + sin * 3.0, -sin * 2.0 + cos * 3.0];
    let expected: Vec<f64> = (0..plane.sites()).map(|site| bump(plane.place(site), in_hand)).collect();
    // Between two sites a Gaussian bends by d²/8 of its curvature.
    assert!(differ(&seen, &expected) < 2.0 * 0.2 * 0.2 / 8.0 * 1.01, "{}", differ(&seen, &expected));
}

#[test]
fn a_dimension_that_is_left_out_is_integrated_over() {
    let plane = Lattice::new([Axis::open(-8.0, 8.0, 0.25), Axis::circular(0.0, TAU, 40)]).unwrap();
    let line = Lattice::new([plane.axes()[0]]).unwrap();
    let value = |[x, angle]: [f64; 2]| (-x * x / 2.0).exp() * (1.0 + angle.cos());
    let on_plane: Vec<f64> = (0..plane.sites()).map(|site| value(plane.place(site))).collect();
    let mut found = vec![0.0; line.sites()];
    Projection::gathering(&plane, &line, |[x, _]: [f64; 2]| Some([x])).add(1.0, &on_plane, &mut found);
    let expected: Vec<f64> =
        (0..line.sites()).map(|site| TAU * (-line.place(site)[0].powi(2) / 2.0).exp()).collect();
    assert!(differ(&found, &expected) < 1e-10, "{}", differ(&found, &expected));
}

#[test]
fn a_trace_follows_what_stands_and_fades_where_nothing_does() {
    let memory = MemoryTrace { build: 200.0, decay: 5000.0 };
    let mut trace = [0.0, 1.0];
    (0..300).for_each(|_| memory.step(1.0, &[1.0, 0.0], &mut trace));
    let expected = [1.0 - (-300.0_f64 / 200.0).exp(), (-300.0_f64 / 5000.0).exp()];
    assert!(differ(&trace, &expected) < 1e-12);
}

#[test]
fn a_lattice_without_sites_or_with_too_many_is_refused() {
    let refused = |axes: [Axis; 2]| Lattice::new(axes).unwrap_err().name;
    let good = Axis::open(0.0, 9.0, 1.0);
    assert_eq!(refused([good, Axis { sites: 0, ..good }]), "number of sites");
    assert_eq!(refused([Axis { sites: usize::MAX, ..good }, good]), "number of sites");
    assert_eq!(refused([good, Axis { spacing: f64::NAN, ..good }]), "spacing");
    let lattice = Lattice::new([good; 2]).unwrap();
    let wide = Gaussian { amplitude: 1.0, sigma: [1.0, 1e9] };
    assert_eq!(Interaction::none(lattice).with(wide).unwrap_err().name, "sigma");
}
