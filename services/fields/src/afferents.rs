use coact_joint_task::{NetworkPlan, Pool, Synapse};

/// What each population receives, laid out for one pass in the order of memory.
#[derive(Debug, Clone)]
pub(crate) struct Afferents {
    /// Synapses whose sources add up.
    summed: Vec<Link>,
    /// Groups of synapses that count as one.
    pooled: Vec<Group>,
    /// Sources of all groups, one group after the other.
    sources: Vec<u32>,
}

#[derive(Debug, Clone, Copy)]
struct Link {
    from: u32,
    to: u32,
    weight: f64,
}

#[derive(Debug, Clone, Copy)]
struct Group {
    pool: Pool,
    to: u32,
    /// Weight of each of its synapses.
    weight: f64,
    /// How many of the sources are its own.
    sources: u32,
}

impl Afferents {
    pub fn of(plan: &NetworkPlan) -> Self {
        let (mut summed, mut pooled, mut sources) = (Vec::new(), Vec::new(), Vec::new());
        for group in plan.synapses.chunk_by(|a, b| (a.to, a.rule) == (b.to, b.rule)) {
            let Synapse { to, weight, rule, .. } = group[0];
            let to = to as u32;
            match plan.pools[rule] {
                Pool::Sum => summed.extend(group.iter().map(|synapse| Link {
                    from: synapse.from as u32,
                    to,
                    weight: synapse.weight,
                })),
                pool => {
                    pooled.push(Group { pool, to, weight, sources: group.len() as u32 });
                    sources.extend(group.iter().map(|synapse| synapse.from as u32));
                }
            }
        }
        Self { summed, pooled, sources }
    }

    /// Input strength of each population from the signals of all sources (chapter, eq. 4, without K).
    pub fn gather(&self, signal: &[f64], strength: &mut [f64]) {
        strength.fill(0.0);
        for &Link { from, to, weight } in &self.summed {
            strength[to as usize] += weight * signal[from as usize];
        }
        let mut rest = self.sources.as_slice();
        for &Group { pool, to, weight, sources } in &self.pooled {
            let (own, others) = rest.split_at(sources as usize);
            rest = others;
            let signals = own.iter().map(|&from| signal[from as usize]);
            let counts = match pool {
                Pool::Every => signals.fold(f64::INFINITY, f64::min),
                Pool::Any | Pool::Sum => signals.fold(0.0, f64::max),
            };
            strength[to as usize] += weight * counts;
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use std::path::Path;

    /// A plan whose only synapses are those of three rules from sources 0 to 2 to target 0.
    fn gathered(signal: [f64; 3]) -> f64 {
        let task = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
        let (_, mut plan) = NetworkPlan::load(&task).unwrap();
        plan.pools = vec![Pool::Sum, Pool::Any, Pool::Every];
        let synapse = |rule, from| Synapse { from, to: 0, weight: [1.0, 10.0, 100.0][rule], rule };
        plan.synapses = (0..3).flat_map(|rule| (0..3).map(move |from| synapse(rule, from))).collect();
        let mut strength = [0.0; 3];
        Afferents::of(&plan).gather(&signal, &mut strength);
        assert_eq!(strength[1..], [0.0; 2]);
        strength[0]
    }

    #[test]
    fn sources_add_up_as_their_rule_says() {
        assert_eq!(gathered([0.0; 3]), 0.0);
        assert_eq!(gathered([1.0, 0.0, 1.0]), 2.0 + 10.0);
        assert_eq!(gathered([1.0, 0.5, 0.5]), 2.0 + 10.0 + 50.0);
    }
}
