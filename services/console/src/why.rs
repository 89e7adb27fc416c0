//! Why a population holds a peak or none, as a page is told it.

use coact_fields::{Explanation, Share};
use coact_joint_task::NetworkPlan;
use serde_json::{Value, json};
use std::fmt::Write as _;

/// What gives or takes less than this is not told, in units of the input that ignites a population.
const TOLD: f64 = 0.005;
/// So many shares are named in the sentence.
const NAMED: usize = 3;

/// The explanation of a population at `cycle`: what it gets from which synapses, in numbers and in a sentence.
pub(crate) fn to_json(plan: &NetworkPlan, explained: &Explanation, cycle: u64) -> Value {
    let told =
        explained.shares.iter().filter(|share| share.amount.abs() >= TOLD || share.missing().is_some());
    let share = |share: &Share| {
        let standing = share.sources.iter().filter(|(_, signal)| *signal > 0.0).count();
        json!({
            "amount": share.amount,
            "weight": share.weight,
            "from": share.from(plan),
            "signal": share.decisive().1,
            "others": standing.saturating_sub(1),
            "pool": share.pool.name(),
            "reason": plan.reasons[share.rule],
            "missing": share.missing().map(|source| plan.name(source)),
        })
    };
    json!({
        "kind": "why",
        "at_ms": cycle,
        "population": explained.population,
        "name": plan.name(explained.population),
        "since_ms": explained.since,
        "signal": explained.signal,
        "input": explained.input(),
        "shares": told.map(share).collect::<Vec<_>>(),
        "sentence": sentence(plan, explained, cycle),
    })
}

fn sentence(plan: &NetworkPlan, explained: &Explanation, cycle: u64) -> String {
    let mut text = plan.name(explained.population);
    // To write to a string cannot fail.
    let _ = match explained.since {
        Some(since) => write!(text, " stands since {:.2} s: ", cycle.saturating_sub(since) as f64 / 1000.0),
        None => write!(text, " does not stand: "),
    };
    let told: Vec<_> =
        explained.shares.iter().filter(|share| share.amount.abs() >= TOLD).take(NAMED).collect();
    if told.is_empty() {
        text.push_str("it gets nothing");
    }
    for (index, share) in told.iter().enumerate() {
        let comma = if index == 0 { "" } else { ", " };
        let _ = write!(text, "{comma}{:.2} from {}", share.amount, share.from(plan));
    }
    if explained.since.is_none()
        && let Some((share, missing)) =
            explained.shares.iter().find_map(|share| Some((share, share.missing()?)))
    {
        let _ = write!(text, "; {:.2} more if {} stood as well", share.weight, plan.name(missing));
    }
    text + "."
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use coact_messages::LayerKind;
    use std::path::Path;

    #[test]
    fn a_goal_says_from_what_it_stands_and_what_it_lacks() {
        let task = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
        let (_, plan) = NetworkPlan::load(&task).unwrap();
        let goal = plan.layer(LayerKind::Intention).populations.start;
        let mut signals = vec![0.0; plan.populations.len() + plan.channels.len()];
        let silent = to_json(&plan, &Explanation::of_signals(&plan, goal, &signals, 0), 500);
        assert!(silent["sentence"].as_str().unwrap().contains("does not stand: it gets nothing"));
        signals[..plan.populations.len()].fill(1.0);
        let explained = Explanation::of_signals(&plan, goal, &signals, 290);
        let told = to_json(&plan, &explained, 500);
        let sentence = told["sentence"].as_str().unwrap();
        assert!(sentence.starts_with("IL ") && sentence.contains("stands since 0.21 s: "), "{sentence}");
        let sum: f64 =
            told["shares"].as_array().unwrap().iter().map(|share| share["amount"].as_f64().unwrap()).sum();
        assert!((sum - explained.input()).abs() < 0.05, "{sum} of {}", explained.input());
    }
}
