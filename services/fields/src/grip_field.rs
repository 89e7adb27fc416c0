//! The grip field: over the hand's pitch and the width that it opens for, in it the grips compete in which the hand may take a part, or holds one.
//! A peak is the grip.

use crate::likely::Likely;
use crate::selection_field::{CUT_OFF, signal};
use coact_joint_task::SelectionPlan;
use coact_messages::{Grips, MAX_KINDS, Percept};

/// What drives it: at the pitch of each grip and the width of each kind, by how much the hand looks like the grip beyond mere chance, and by how far
/// the hand goes to a part of the kind, or holds one.
pub(crate) fn drives<'a>(
    percept: &'a Percept,
    likely: Likely<'a>,
    widths: &'a [f64],
) -> impl Iterator<Item = ([f64; 2], f64)> {
    let parts = parts(percept, likely);
    let grips = &percept.grips;
    let all: f64 = grips.iter().map(|(_, _, fit)| fit).sum();
    let chance = if grips.count > 1 { 1.0 / f64::from(grips.count) } else { 0.0 };
    let plain = grips.iter().filter(move |(_, _, fit)| all > 0.0 && *fit > chance * all);
    plain.flat_map(move |(_, pitch, fit)| {
        let beyond_chance = (fit / all - chance) / (1.0 - chance);
        widths.iter().zip(parts).map(move |(width, part)| ([pitch, *width], beyond_chance * part))
    })
}

/// How far the hand goes to a part of each kind, by its share of all that the movement may lead to, or holds one.
fn parts(percept: &Percept, likely: Likely) -> [f64; MAX_KINDS] {
    let told = likely.destinations.told;
    let (all, _) = likely.all();
    let mut parts = percept.person_holds;
    for (kind, _, fit) in likely.iter() {
        if let Some(kind) = kind.filter(|_| all > 0.0) {
            parts[kind] = parts[kind].max(told * fit / all);
        }
    }
    parts
}

/// The signal of the peak at a grip and the width of a part, as far as that grip is meant and none beside it; 1 where nothing tells grips apart.
pub(crate) fn signal_of(
    plan: &SelectionPlan,
    activity: &[f64],
    grips: &Grips,
    grip: usize,
    width: f64,
) -> f64 {
    let Some((_, pitch, fit)) = grips.iter().nth(grip) else { return 1.0 };
    let signal = signal(plan, activity, [pitch, width]);
    if signal <= 0.0 || fit <= 0.0 {
        return 0.0;
    }
    let others = grips.iter().filter(|(other, _, _)| *other != grip);
    let beside = others.map(|(_, other, fit)| {
        let deviations = (other - pitch).abs() / plan.input_sigma[0];
        if deviations < CUT_OFF { fit * (-0.5 * deviations * deviations).exp() } else { 0.0 }
    });
    signal * fit / (fit + beside.sum::<f64>())
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use crate::due_kinds::Beforehand;
    use crate::selection_field::SelectionField;
    use coact_joint_task::NetworkPlan;
    use std::path::Path;

    /// From above, and from the side, rad.
    const PITCHES: [f64; 2] = [-1.31, -0.17];
    /// Widths of two kinds of part, m.
    const WIDTHS: [f64; 2] = [0.025, 0.055];

    struct Bench {
        plan: SelectionPlan,
        field: SelectionField,
        activity: Vec<f64>,
        percept: Box<Percept>,
    }

    impl Bench {
        /// A hand that looks so much like each grip.
        fn of(fit: [f64; 2]) -> Self {
            let task = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
            let plan = NetworkPlan::load(&task).unwrap().1.grips;
            let field = SelectionField::new(&plan).unwrap();
            let mut percept: Box<Percept> = bytemuck::zeroed_box();
            percept.grips.count = 2;
            percept.grips.pitch[..2].copy_from_slice(&PITCHES);
            let mut bench = Self { activity: vec![plan.resting; field.sites()], plan, field, percept };
            bench.fit(fit);
            bench
        }

        fn fit(&mut self, fit: [f64; 2]) {
            self.percept.grips.fit[..2].copy_from_slice(&fit);
        }

        /// It goes to a part of each kind, if so much fits each.
        fn goes_to(mut self, fit: [f64; 2]) -> Self {
            let destinations = &mut self.percept.destinations;
            (destinations.told, destinations.count) = (1.0, 0);
            fit.into_iter()
                .enumerate()
                .for_each(|(kind, fit)| destinations.push(Some(kind), [-1.0, 0.3], fit));
            self
        }

        /// Goes on for so many ms; then the signal of each grip, by kind.
        fn run(&mut self, ms: usize) -> [[f64; 2]; 2] {
            let beforehand = Beforehand([1.0; MAX_KINDS]);
            let likely = Likely { destinations: &self.percept.destinations, beforehand: &beforehand };
            for _ in 0..ms {
                let now = self.activity.clone();
                self.field.step(1.0, drives(&self.percept, likely, &WIDTHS), &now, &mut self.activity);
            }
            let grips = &self.percept.grips;
            [0, 1].map(|grip| WIDTHS.map(|width| signal_of(&self.plan, &self.activity, grips, grip, width)))
        }
    }

    #[test]
    fn the_grip_that_the_hand_looks_like_gets_the_peak_at_the_width_of_what_it_goes_to() {
        for (grip, kind) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
            let (mut looks, mut goes) = ([0.1; 2], [0.1; 2]);
            (looks[grip], goes[kind]) = (1.0, 1.0);
            let signals = Bench::of(looks).goes_to(goes).run(100);
            for (other, of_grip) in signals.into_iter().enumerate() {
                for (part, signal) in of_grip.into_iter().enumerate() {
                    let expected = (other, part) == (grip, kind);
                    assert_eq!(signal > 0.5, expected, "{grip} {kind}: {signals:?}");
                }
            }
        }
    }

    #[test]
    fn a_hand_that_looks_like_either_grip_has_none() {
        assert_eq!(Bench::of([1.0, 1.0]).goes_to([1.0, 0.1]).run(500), [[0.0; 2]; 2]);
        assert_eq!(Bench::of([1.0, 0.9]).goes_to([1.0, 0.1]).run(500), [[0.0; 2]; 2]);
    }

    #[test]
    fn a_peak_outlasts_a_frame_that_fits_another_grip_and_follows_a_hand_that_turns() {
        let mut bench = Bench::of([1.0, 0.1]).goes_to([1.0, 0.0]);
        assert!(bench.run(100)[0][0] > 0.5);
        bench.fit([0.4, 1.0]);
        let [[before, _], [other, _]] = bench.run(10);
        assert!(before > 0.2 && other == 0.0, "{before} {other}");
        bench.fit([0.1, 1.0]);
        let [[before, _], [after, _]] = bench.run(100);
        assert!(before == 0.0 && after > 0.5, "{before} {after}");
    }

    #[test]
    fn a_hand_at_rest_has_no_grip_and_one_that_holds_a_part_has_one() {
        let mut bench = Bench::of([1.0, 0.1]);
        assert_eq!(bench.run(200), [[0.0; 2]; 2]);
        bench.percept.person_holds[1] = 1.0;
        let [[narrow, wide], side] = bench.run(100);
        assert!(wide > 0.5 && narrow < 0.5 && side == [0.0; 2], "{narrow} {wide} {side:?}");
    }

    #[test]
    fn where_nothing_tells_grips_apart_each_is_possible_and_out_of_sight_none_is() {
        let mut bench = Bench::of([0.0; 2]).goes_to([1.0, 0.0]);
        assert_eq!(bench.run(100), [[0.0; 2]; 2]);
        bench.percept.grips.count = 0;
        assert_eq!(bench.run(100), [[1.0; 2]; 2]);
    }
}
