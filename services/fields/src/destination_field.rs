//! The destination field: over the table, in it the places that the person's hand may go to compete. A peak is where it is going.

use crate::likely::Likely;
use crate::selection_field::{CUT_OFF, signal};
use coact_joint_task::SelectionPlan;
use coact_messages::MAX_KINDS;

/// What drives it: of each place, by how much more than mere chance it is what the movement may lead to, as far as that tells anything. Places hold
/// each other back before the field does: each counts by its share of all (divisive normalisation, Carandini and Heeger 2012).
pub(crate) fn drives(likely: Likely) -> impl Iterator<Item = ([f64; 2], f64)> {
    let (all, kinds) = likely.all();
    let chance = if kinds > 1 { 1.0 / kinds as f64 } else { 0.0 };
    let told = likely.destinations.told / (1.0 - chance);
    let fits = likely.iter().filter(move |(_, _, fit)| all > 0.0 && *fit > chance * all);
    fits.map(move |(_, place, fit)| (place, told * (fit / all - chance)))
}

/// Of each kind of part, the signal of the highest peak at one of its parts. Where other kinds lie at the same place, the place tells nothing of them
/// apart, and each has its share by how well it fits.
pub(crate) fn signals(plan: &SelectionPlan, activity: &[f64], likely: Likely) -> [f64; MAX_KINDS] {
    let mut signals = [0.0_f64; MAX_KINDS];
    for (kind, place, fit) in likely.iter() {
        let Some(kind) = kind.filter(|_| fit > 0.0) else { continue };
        let signal = signal(plan, activity, place);
        if signal > 0.0 {
            let beside = beside(likely, kind, place, plan.input_sigma);
            signals[kind] = signals[kind].max(signal * fit / (fit + beside));
        }
    }
    signals
}

/// How well other kinds fit that lie where this one does.
fn beside(likely: Likely, kind: usize, place: [f64; 2], sigma: [f64; 2]) -> f64 {
    let others = likely.iter().filter(|(other, _, _)| *other != Some(kind));
    let near = others.filter_map(|(_, other, fit)| {
        let along = |axis: usize| ((other[axis] - place[axis]) / sigma[axis]).powi(2);
        let deviations = along(0) + along(1);
        (deviations < CUT_OFF * CUT_OFF).then(|| fit * (-0.5 * deviations).exp())
    });
    near.sum()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use crate::due_kinds::Beforehand;
    use crate::selection_field::SelectionField;
    use coact_joint_task::NetworkPlan;
    use coact_messages::Destinations;
    use std::path::Path;

    /// Three kinds of part, and a place where nothing is taken, m.
    const PLACES: [(Option<usize>, [f64; 2]); 4] =
        [(Some(0), [-1.0, 0.2]), (Some(1), [-1.0, 0.26]), (Some(2), [-0.95, 0.5]), (None, [-0.6, 0.15])];

    struct Bench {
        plan: SelectionPlan,
        field: SelectionField,
        activity: Vec<f64>,
    }

    impl Bench {
        fn new() -> Self {
            let task = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
            let plan = NetworkPlan::load(&task).unwrap().1.destinations;
            let field = SelectionField::new(&plan).unwrap();
            Self { activity: vec![plan.resting; field.sites()], plan, field }
        }

        /// Goes on for so many ms, nothing being likelier than anything else beforehand; then each kind's signal.
        fn run(&mut self, ms: usize, told: &Destinations) -> [f64; 3] {
            self.run_expecting(ms, told, Beforehand([1.0; MAX_KINDS]))
        }

        fn run_expecting(&mut self, ms: usize, told: &Destinations, beforehand: Beforehand) -> [f64; 3] {
            let likely = Likely { destinations: told, beforehand: &beforehand };
            for _ in 0..ms {
                let now = self.activity.clone();
                self.field.step(1.0, drives(likely), &now, &mut self.activity);
            }
            let signals = signals(&self.plan, &self.activity, likely);
            [signals[0], signals[1], signals[2]]
        }

        /// Place of the highest activity, m, and whether it is a peak.
        fn highest(&self) -> ([f64; 2], bool) {
            let by_activity =
                |one: &usize, other: &usize| self.activity[*one].total_cmp(&self.activity[*other]);
            let site = (0..self.activity.len()).max_by(by_activity).unwrap();
            (self.plan.grid.place(site), self.activity[site] > 0.0)
        }
    }

    fn told(places: impl IntoIterator<Item = (Option<usize>, [f64; 2], f64)>) -> Destinations {
        let mut destinations = Destinations { told: 1.0, ..bytemuck::Zeroable::zeroed() };
        places.into_iter().for_each(|(kind, place, fit)| destinations.push(kind, place, fit));
        destinations
    }

    fn fitting(fits: [f64; 4]) -> Destinations {
        told(PLACES.into_iter().zip(fits).map(|((kind, place), fit)| (kind, place, fit)))
    }

    #[test]
    fn the_place_that_fits_best_by_far_gets_the_peak_and_its_neighbour_none() {
        for best in 0..3 {
            let mut fits = [0.05; 4];
            fits[best] = 1.0;
            let mut bench = Bench::new();
            let signals = bench.run(100, &fitting(fits));
            let ([x, y], is_peak) = bench.highest();
            let [expected_x, expected_y] = PLACES[best].1;
            assert!(
                is_peak && (x - expected_x).hypot(y - expected_y) < bench.plan.grid.spacing[0],
                "{x} {y}"
            );
            for (kind, signal) in signals.into_iter().enumerate() {
                assert_eq!(signal > 0.5, kind == best, "{best}: {signals:?}");
            }
        }
    }

    #[test]
    fn between_places_that_fit_alike_nothing_is_decided() {
        for fits in [[1.0, 1.0, 0.0, 0.0], [1.0, 0.0, 1.0, 0.0], [1.0, 0.0, 0.0, 1.0], [1.0, 0.9, 0.8, 0.0]] {
            let mut bench = Bench::new();
            assert_eq!(bench.run(500, &fitting(fits)), [0.0; 3], "{fits:?}");
            assert!(!bench.highest().1);
        }
    }

    /// Only a part of the first kind is due.
    fn first_is_due() -> Beforehand {
        let mut likely = [0.3; MAX_KINDS];
        likely[0] = 1.0;
        Beforehand(likely)
    }

    #[test]
    fn between_places_that_fit_alike_the_plan_decides() {
        for fits in [[1.0, 1.0, 0.0, 0.0], [1.0, 0.0, 1.0, 0.0]] {
            let signals = Bench::new().run_expecting(100, &fitting(fits), first_is_due());
            assert!(signals[0] > 0.5 && signals[1..] == [0.0; 2], "{fits:?}: {signals:?}");
        }
    }

    #[test]
    fn wherever_between_sites_they_lie_the_plan_decides_between_places_that_fit_alike() {
        let spacing = Bench::new().plan.grid.spacing[0];
        for quarters in 0..4 {
            let aside = 0.25 * f64::from(quarters) * spacing;
            let places = PLACES[..2].iter().map(|(kind, [x, y])| (*kind, [x + aside, y + aside], 1.0));
            let signals = Bench::new().run_expecting(200, &told(places), first_is_due());
            assert!(signals[0] > 0.5 && signals[1] == 0.0, "{quarters}: {signals:?}");
        }
    }

    #[test]
    fn a_movement_that_is_plain_shows_what_the_plan_does_not_expect() {
        for other in [1, 2] {
            let mut fits = [0.05; 4];
            fits[other] = 1.0;
            let signals = Bench::new().run_expecting(100, &fitting(fits), first_is_due());
            assert!(signals[other] > 0.5 && signals[0] == 0.0, "{signals:?}");
        }
    }

    #[test]
    fn several_parts_of_one_kind_do_not_hide_which_kind_it_is() {
        let places =
            [(Some(0), [-1.0, 0.2], 1.0), (Some(0), [-1.0, 0.4], 0.95), (Some(1), [-0.95, 0.55], 0.05)];
        let signals = Bench::new().run(100, &told(places));
        assert!(signals[0] > 0.5 && signals[1] == 0.0, "{signals:?}");
    }

    #[test]
    fn of_kinds_at_one_place_each_has_its_share() {
        let places = [(Some(0), [-1.0, 0.2], 1.0), (Some(1), [-1.0, 0.2], 0.25)];
        let signals = Bench::new().run(100, &told(places));
        assert!((signals[0] / signals[1] - 4.0).abs() < 1e-9, "{signals:?}");
    }

    #[test]
    fn the_peak_goes_with_the_movement_and_follows_it_to_another_place() {
        let mut bench = Bench::new();
        assert!(bench.run(100, &fitting([1.0, 0.0, 0.0, 0.0]))[0] > 0.5);
        let turned = bench.run(100, &fitting([0.05, 0.0, 1.0, 0.0]));
        assert!(turned[0] == 0.0 && turned[2] > 0.5, "{turned:?}");
        let still = Destinations { told: 0.0, ..fitting([0.05, 0.0, 1.0, 0.0]) };
        assert_eq!(bench.run(100, &still), [0.0; 3]);
    }

    #[test]
    fn places_beside_the_table_are_left_out() {
        let mut bench = Bench::new();
        let far = [(Some(0), [1e3, -1e3], 1.0), (Some(1), [-1e300, 1e300], 1.0)];
        assert_eq!(bench.run(10, &told(far)), [0.0; 3]);
    }
}
