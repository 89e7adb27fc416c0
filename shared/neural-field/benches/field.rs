//! Steps per second of one field, at the sizes that other simulators publish.
#![allow(missing_docs)]

use coact_neural_field::{Field, Kernel, Parameters};
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

criterion_group!(benches, step);
criterion_main!(benches);
