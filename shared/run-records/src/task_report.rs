use crate::Event;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What was done and said in a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct TaskReport {
    /// How many subgoals the plan asks for: all that no choice of the assembly that came furthest has spared.
    pub subgoals: usize,
    /// How many of them were achieved in the assembly that came furthest.
    pub achieved: usize,
    /// Their names, in the order in which that assembly achieved them.
    pub order: Vec<String>,
    /// How long the first complete assembly took; without one, how long the run lasted.
    pub duration_s: f64,
    /// Assemblies that were completed.
    pub assemblies: u64,
    /// What the robot decided, in order.
    pub decisions: Vec<Decided>,
    /// What the robot said, in order.
    pub utterances: Vec<Said>,
}

/// A decision of the robot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Decided {
    /// When, s from the start of the run.
    pub at_s: f64,
    /// Name of the action.
    pub action: String,
}

/// A sentence of the robot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Said {
    /// When, s from the start of the run.
    pub at_s: f64,
    /// The sentence.
    pub text: String,
}

impl TaskReport {
    /// From the events of a run that lasted `run_s` seconds, with a plan that asks for `needed` subgoals where those of a mask are achieved
    /// (bit i: subgoal i).
    pub fn new(needed: impl Fn(u64) -> usize, events: &[Event], run_s: f64) -> Self {
        let mut assemblies: BTreeMap<u64, (u64, Vec<String>)> = BTreeMap::new();
        let mut report = Self {
            subgoals: 0,
            achieved: 0,
            order: Vec::new(),
            duration_s: run_s,
            assemblies: 0,
            decisions: Vec::new(),
            utterances: Vec::new(),
        };
        let seconds = |at_ms: &u64| *at_ms as f64 / 1e3;
        for event in events {
            match event {
                Event::Subgoal { assembly, subgoal, name, .. } => {
                    let (achieved, order) = assemblies.entry(*assembly).or_default();
                    *achieved |= 1 << subgoal;
                    order.push(name.clone());
                }
                Event::Assembly { at_ms, completed } => {
                    if report.assemblies == 0 {
                        report.duration_s = seconds(at_ms);
                    }
                    report.assemblies = *completed;
                }
                Event::Decision { at_ms, action } => {
                    report.decisions.push(Decided { at_s: seconds(at_ms), action: action.clone() });
                }
                Event::Utterance { at_ms, text } => {
                    report.utterances.push(Said { at_s: seconds(at_ms), text: text.clone() });
                }
                Event::Perceived { .. }
                | Event::Forgotten { .. }
                | Event::Action(_)
                | Event::Wait(_)
                | Event::Span(_)
                | Event::Fault(_)
                | Event::Blind { .. } => {}
            }
        }
        let furthest = assemblies.into_values().rev().max_by_key(|(_, order)| order.len());
        let (achieved, order) = furthest.unwrap_or_default();
        (report.subgoals, report.order) = (needed(achieved), order);
        report.achieved = report.order.len();
        report
    }
}
