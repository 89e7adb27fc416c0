//! Steps per second of one field, at the sizes that other simulators publish.
#![allow(missing_docs)]

use coact_neural_field::{
    Axis, Field, Gaussian, Interaction, Kernel, Lattice, MetricConstants, MetricField, Parameters, Projection,
};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

fn step(criterion: &mut Criterion) {
    let kernel = Kernel { amplitude: 3.0, sigma: 2.0, inhibition: 0.6, range: None };
    let parameters =
        Parameters { tau: 20.0, slope: 5.0, threshold: 0.0, spacing: 0.5, input_sigma: 2.0, kernel };
    let mut group = criterion.benchmark_group("field step");
    for sites in [181, 1000, 2400] {
        let mut field = Field::new(parameters, 1, sites).expect("constants are in range");
        let input = vec![2.5; sites];
        let (mut now, mut next) = (vec![-2.0; sites], vec![0.0; sites]);
        group.throughput(Throughput::Elements(1));
        group.bench_function(BenchmarkId::from_parameter(sites), |bencher| {
            bencher.iter(|| {
                field.step(1.0, &now, &input, &[-2.0], &mut next);
                std::mem::swap(&mut now, &mut next);
            });
        });
    }
    group.finish();
}

/// A field over a table: 100 x 100 sites, local excitation of 3 sites, inhibition everywhere.
fn metric_step(criterion: &mut Criterion) {
    let lattice = Lattice::new([Axis::open(0.0, 99.0, 1.0); 2]).expect("constants are in range");
    let excitation = Gaussian { amplitude: 0.3, sigma: [3.0, 3.0] };
    let interaction = Interaction::none(lattice).with(excitation).expect("constants are in range");
    let constants = MetricConstants { tau: 20.0, slope: 5.0, threshold: 0.0 };
    let field = MetricField::new(constants, interaction.with_inhibition_everywhere(0.01));
    let mut field = field.expect("constants are in range");
    let input: Vec<f64> = (0..lattice.sites()).map(|site| if site % 997 < 9 { 6.0 } else { 0.0 }).collect();
    let (mut now, mut next) = (vec![-3.0; lattice.sites()], vec![0.0; lattice.sites()]);
    let mut group = criterion.benchmark_group("metric field step");
    group.throughput(Throughput::Elements(1));
    group.bench_function("100 x 100", |bencher| {
        bencher.iter(|| {
            field.step(1.0, &now, &input, -3.0, &mut next);
            std::mem::swap(&mut now, &mut next);
        });
    });
    group.finish();
}

/// Twelve fields in a ring, each of which reads its two neighbours.
fn coupled_step(criterion: &mut Criterion) {
    const FIELDS: usize = 12;
    let lattice = Lattice::new([Axis::open(0.0, 90.0, 0.5)]).expect("constants are in range");
    let excitation = Gaussian { amplitude: 3.0, sigma: [2.0] };
    let interaction = Interaction::none(lattice).with(excitation).expect("constants are in range");
    let constants = MetricConstants { tau: 20.0, slope: 5.0, threshold: 0.0 };
    let field = MetricField::new(constants, interaction.with_inhibition_everywhere(0.6));
    let mut fields = vec![field.expect("constants are in range"); FIELDS];
    let projection = Projection::reading(&lattice, &lattice, |place: [f64; 1]| Some(place));
    let sites = lattice.sites();
    let (mut now, mut next) = (vec![vec![-2.0; sites]; FIELDS], vec![vec![0.0; sites]; FIELDS]);
    let (mut output, mut input) = (vec![vec![0.0; sites]; FIELDS], vec![0.0; sites]);
    let mut group = criterion.benchmark_group("coupled step");
    group.throughput(Throughput::Elements(1));
    group.bench_function("12 fields of 181, 24 projections", |bencher| {
        bencher.iter(|| {
            for (index, field) in fields.iter().enumerate() {
                field.fire(&now[index], &mut output[index]);
            }
            for (index, field) in fields.iter_mut().enumerate() {
                input.fill(if index == 0 { 2.5 } else { 0.0 });
                for neighbour in [index + 1, index + FIELDS - 1] {
                    projection.add(0.5, &output[neighbour % FIELDS], &mut input);
                }
                field.step(1.0, &now[index], &input, -2.0, &mut next[index]);
            }
            std::mem::swap(&mut now, &mut next);
        });
    });
    group.finish();
}

criterion_group!(benches, step, metric_step, coupled_step);
criterion_main!(benches);
