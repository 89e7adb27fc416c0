use crate::metrics::{END_TO_END, execution_name, hop_name, wakeup_name};
use crate::{Metrics, ProcessCounters, Rules, percentiles, verdict};
use coact_joint_task::Task;
use coact_run_records::{
    AnticipationReport, Environment, Event, FaultReport, Percentiles, ProcessReport, ReactionReport, Summary,
    TaskReport, TrackingReport, Verdict,
};
use std::collections::BTreeMap;

/// What a summary is made from.
#[derive(Debug)]
pub struct Findings<'a> {
    /// The task.
    pub task: &'a Task,
    /// Where it ran.
    pub environment: Environment,
    /// Every event of the run.
    pub events: &'a [Event],
    /// Latencies and counters; none in lockstep, where no clock runs.
    pub metrics: Option<&'a Metrics>,
    /// How well the arm followed its setpoints.
    pub tracking: TrackingReport,
    /// From decisions to movements.
    pub reaction: ReactionReport,
    /// Start of the run, ns of `CLOCK_MONOTONIC`.
    pub start_ns: u64,
    /// How long the run lasted, s.
    pub duration_s: f64,
    /// What it had to reach.
    pub rules: &'a Rules,
}

impl Findings<'_> {
    /// Draws the conclusions.
    pub fn summary(self) -> Summary {
        let Self { task, environment, events, metrics, tracking, reaction, start_ns, duration_s, rules } =
            self;
        let mut summary = Summary {
            environment,
            processes: metrics.map(processes).unwrap_or_default(),
            hops: metrics.map(hops).unwrap_or_default(),
            end_to_end_ns: metrics.map(|own| percentiles_of(own, END_TO_END)).unwrap_or_default(),
            tracking_error_rad: tracking,
            movement_reaction_ms: reaction,
            anticipation: AnticipationReport::new(events),
            task: TaskReport::new(task.subgoals.len(), events, duration_s),
            faults: FaultReport::all(events, start_ns),
            verdict: Verdict::Pass,
            reasons: Vec::new(),
        };
        summary.reasons = verdict::reasons(&summary, events, duration_s, rules);
        if !summary.reasons.is_empty() {
            summary.verdict = Verdict::Fail;
        }
        summary
    }
}

fn percentiles_of(metrics: &Metrics, name: &str) -> Percentiles {
    metrics.histograms().get(name).map(|own| percentiles(own.total())).unwrap_or_default()
}

fn processes(metrics: &Metrics) -> BTreeMap<String, ProcessReport> {
    let report = |name: &str, counters: &ProcessCounters| ProcessReport {
        cycles: counters.cycles,
        missed: counters.missed,
        longest_miss_run: counters.longest_miss_run,
        skipped: counters.skipped,
        restarts: counters.restarts,
        wakeup_ns: percentiles_of(metrics, &wakeup_name(name)),
        execution_ns: percentiles_of(metrics, &execution_name(name)),
    };
    metrics.counters().iter().map(|(name, counters)| (name.clone(), report(name, counters))).collect()
}

fn hops(metrics: &Metrics) -> BTreeMap<String, Percentiles> {
    let edges = metrics.nodes().iter().filter_map(|node| Some((node.input_from.as_ref()?, &node.process)));
    edges
        .filter(|(from, to)| metrics.histograms().contains_key(&hop_name(from, to)))
        .map(|(from, to)| (format!("{from}->{to}"), percentiles_of(metrics, &hop_name(from, to))))
        .collect()
}
