use crate::due_kinds::DueKinds;
use crate::{Share, sources};
use coact_joint_task::{NetworkPlan, Pool, Synapse};
use coact_messages::{FieldFrame, Percept};

/// Why a population holds a peak, or holds none: what it gets right now, synapse by synapse (chapter, eq. 4).
#[derive(Debug, Clone, PartialEq)]
pub struct Explanation {
    /// The population: place in the plan's row of all.
    pub population: usize,
    /// Its signal, 0 at rest, 1 with a full peak.
    pub signal: f64,
    /// Cycle at which its peak crossed threshold; `None` while it holds none.
    pub since: Option<u64>,
    /// What it gets from its synapses, those that give most, or take most, first. Those that give nothing stand at the end.
    pub shares: Vec<Share>,
}

impl Explanation {
    /// Explains a population of the network of `plan` from the newest frame and percept: the input from which the next frame is
    /// computed, without its noise.
    pub fn of(plan: &NetworkPlan, population: usize, frame: &FieldFrame, percept: Option<&Percept>) -> Self {
        Self::of_signals(plan, population, &signals(plan, frame, percept), frame.since[population])
    }

    /// The same from the [`signals`] of an instant, and the cycle since which the population's peak stood then, 0 without one.
    pub fn of_signals(plan: &NetworkPlan, population: usize, signals: &[f64], since: u64) -> Self {
        let of_it = plan.synapses.iter().filter(|synapse| synapse.to == population);
        let of_it: Vec<Synapse> = of_it.copied().collect();
        let mut shares: Vec<Share> = of_it
            .chunk_by(|one, other| one.rule == other.rule)
            .flat_map(|group| shares(group, plan.pools[group[0].rule], signals))
            .collect();
        shares.sort_by(|one, other| other.amount.abs().total_cmp(&one.amount.abs()));
        Self {
            population,
            signal: signals[population],
            since: Some(since).filter(|since| *since > 0),
            shares,
        }
    }

    /// All that it gets: 1 ignites a population at rest.
    pub fn input(&self) -> f64 {
        self.shares.iter().map(|share| share.amount).sum()
    }
}

/// What all synapses start from: the signals of all populations of the newest frame, then the values of the percept's channels.
pub fn signals(plan: &NetworkPlan, frame: &FieldFrame, percept: Option<&Percept>) -> Vec<f64> {
    let mut signals = vec![0.0; plan.populations.len() + plan.channels.len()];
    let percept = percept.filter(|percept| sources::is_fresh(frame.header.cycle + 1, percept));
    let beforehand = DueKinds::of(plan).beforehand(&frame.signal);
    sources::collect(plan, percept, frame, &beforehand, &mut signals);
    signals
}

/// Synapses that add up are shares of their own.
fn shares(group: &[Synapse], pool: Pool, signals: &[f64]) -> Vec<Share> {
    let source = |synapse: &Synapse| (synapse.from, signals[synapse.from]);
    let Synapse { rule, weight, .. } = group[0];
    match pool {
        Pool::Sum | Pool::Absent => {
            let single = |synapse: &Synapse| Share::new(rule, pool, synapse.weight, vec![source(synapse)]);
            group.iter().map(single).collect()
        }
        Pool::Any | Pool::Every => {
            vec![Share::new(rule, pool, weight, group.iter().map(source).collect())]
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use crate::Projections;
    use coact_messages::MAX_PLACES;
    use rand::{RngExt, SeedableRng};
    use std::path::Path;

    #[test]
    fn the_shares_are_what_the_network_gathers() {
        let task = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
        let (_, plan) = NetworkPlan::load(&task).unwrap();
        let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(18);
        let mut given = 0;
        for _ in 0..20 {
            let mut frame: Box<FieldFrame> = bytemuck::zeroed_box();
            for signal in &mut frame.signal[..plan.populations.len()] {
                *signal = if random.random_bool(0.4) { random.random_range(0.0..1.0) } else { 0.0 };
            }
            let mut percept: Box<Percept> = bytemuck::zeroed_box();
            percept.act.fill_with(|| random.random_range(0.0..1.0));
            percept.achieved.fill_with(|| random.random_range(0.0..1.0));
            (percept.grips.count, frame.shapes) = (2, plan.grips.grid);
            percept.grips.fit[..2].copy_from_slice(&[1.0, 0.2]);
            frame.grip.fill(0.4);
            percept.destinations.push(Some(1), [-1.0, 0.3], 1.0);
            (frame.table, frame.destination) = (plan.destinations.grid, [0.4; MAX_PLACES]);
            let mut signals = vec![0.0; plan.populations.len() + plan.channels.len()];
            let mut strength = vec![0.0; plan.populations.len()];
            let beforehand = DueKinds::of(&plan).beforehand(&frame.signal);
            sources::collect(&plan, Some(&percept), &frame, &beforehand, &mut signals);
            Projections::of(&plan).gather(&signals, &mut strength);
            for (population, strength) in strength.iter().enumerate() {
                let explained = Explanation::of(&plan, population, &frame, Some(&percept));
                assert!(
                    (explained.input() - strength).abs() < 1e-9,
                    "{population}: {explained:?}, {strength}"
                );
                given += usize::from(*strength != 0.0);
            }
        }
        assert!(given > 1000, "hardly any population got anything: {given}");
    }

    #[test]
    fn of_sources_that_are_all_needed_the_missing_one_decides() {
        let share = Share::new(0, Pool::Every, 1.2, vec![(3, 1.0), (5, 0.0), (7, 0.5)]);
        assert_eq!((share.amount, share.decisive()), (0.0, (5, 0.0)));
        let share = Share::new(0, Pool::Any, 1.2, vec![(3, 0.25), (5, 0.5)]);
        assert_eq!((share.amount, share.decisive()), (0.6, (5, 0.5)));
    }
}
