use crate::pooled_input::PooledInput;
use coact_joint_task::{NetworkPlan, Pool};

/// Where each source projects to, laid out so that silent sources cost nothing: most of a network is silent.
#[derive(Debug, Clone)]
pub(crate) struct Projections {
    /// What each target gets while all sources are silent.
    in_silence: Vec<f64>,
    /// Of each source, the synapses that add up at their target.
    summed: Vec<Vec<Link>>,
    /// Of each source, the groups that it belongs to.
    pooled: Vec<Vec<u32>>,
    /// Groups of synapses that count as one.
    groups: Vec<Group>,
    /// What each group has received from its sources in this step.
    inputs: Vec<PooledInput>,
    /// The groups that have received anything in this step.
    active: Vec<u32>,
}

#[derive(Debug, Clone, Copy)]
struct Link {
    to: u32,
    weight: f64,
}

#[derive(Debug, Clone, Copy)]
struct Group {
    pool: Pool,
    to: u32,
    /// Weight of each of its synapses.
    weight: f64,
    sources: u32,
}

impl Projections {
    pub fn of(plan: &NetworkPlan) -> Self {
        let sources = plan.populations.len() + plan.channels.len();
        let (mut summed, mut pooled) = (vec![Vec::new(); sources], vec![Vec::new(); sources]);
        let mut in_silence = vec![0.0; plan.populations.len()];
        let mut groups = Vec::new();
        for group in plan.synapses.chunk_by(|a, b| (a.to, a.rule) == (b.to, b.rule)) {
            let (to, weight, pool) = (group[0].to as u32, group[0].weight, plan.pools[group[0].rule]);
            for synapse in group {
                match pool {
                    Pool::Sum => summed[synapse.from].push(Link { to, weight: synapse.weight }),
                    Pool::Absent => {
                        in_silence[synapse.to] += synapse.weight;
                        summed[synapse.from].push(Link { to, weight: -synapse.weight });
                    }
                    Pool::Any | Pool::Every => pooled[synapse.from].push(groups.len() as u32),
                }
            }
            if matches!(pool, Pool::Any | Pool::Every) {
                groups.push(Group { pool, to, weight, sources: group.len() as u32 });
            }
        }
        let inputs = vec![PooledInput::NOTHING; groups.len()];
        Self { in_silence, summed, pooled, active: Vec::with_capacity(groups.len()), groups, inputs }
    }

    /// Input strength of each population from the signals of all sources, each between 0 and 1 (chapter, eq. 4,
    /// without K).
    pub fn gather(&mut self, signal: &[f64], strength: &mut [f64]) {
        strength.copy_from_slice(&self.in_silence);
        for (source, &signal) in signal.iter().enumerate().filter(|(_, signal)| **signal > 0.0) {
            for &Link { to, weight } in &self.summed[source] {
                strength[to as usize] += weight * signal;
            }
            for &group in &self.pooled[source] {
                let input = &mut self.inputs[group as usize];
                if input.is_nothing() {
                    self.active.push(group);
                }
                input.add(signal);
            }
        }
        for group in self.active.drain(..) {
            let Group { pool, to, weight, sources } = self.groups[group as usize];
            let input = std::mem::replace(&mut self.inputs[group as usize], PooledInput::NOTHING);
            strength[to as usize] += weight * input.counts(pool, sources);
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use coact_joint_task::Synapse;
    use std::path::Path;

    /// A plan whose only synapses are those of four rules from sources 0 to 2 to target 0.
    fn gathered(signal: [f64; 3]) -> f64 {
        let task = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
        let (_, mut plan) = NetworkPlan::load(&task).unwrap();
        plan.pools = vec![Pool::Sum, Pool::Any, Pool::Every, Pool::Absent];
        let synapse = |rule, from| Synapse { from, to: 0, weight: [1.0, 10.0, 100.0, -1000.0][rule], rule };
        plan.synapses = (0..4).flat_map(|rule| (0..3).map(move |from| synapse(rule, from))).collect();
        let mut strength = vec![0.0; plan.populations.len()];
        Projections::of(&plan).gather(&signal, &mut strength);
        assert!(strength[1..].iter().all(|strength| *strength == 0.0));
        strength[0]
    }

    #[test]
    fn sources_add_up_as_their_rule_says() {
        assert_eq!(gathered([0.0; 3]), -3000.0);
        assert_eq!(gathered([1.0, 0.0, 1.0]), 2.0 + 10.0 - 1000.0);
        assert_eq!(gathered([1.0, 0.5, 0.5]), 2.0 + 10.0 + 50.0 - 1000.0);
    }
}
