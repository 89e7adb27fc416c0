use crate::figures::{END_TO_END, execution_name, hop_name, wakeup_name};
use crate::{
    ActionEvent, Environment, Event, FaultEvent, Figures, ReactionReport, Rules, TaskReport, TrackingReport,
    verdict,
};
use coact_joint_task::Task;
use hdrhistogram::Histogram;
use serde::Serialize;
use std::collections::BTreeMap;

/// `summary.json`: what a run was like. Others read it: keys stay.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// Where it ran.
    pub environment: Environment,
    /// How regular each process was.
    pub processes: BTreeMap<String, ProcessReport>,
    /// Hop of each edge, by `<from>-><to>`.
    pub hops: BTreeMap<String, Percentiles>,
    /// From the sensor sample's stamp to the publication of the command.
    pub end_to_end_ns: Percentiles,
    /// How well the arm followed its commands.
    pub tracking_error_rad: TrackingReport,
    /// From a changed decision to the first command that it changes, ms.
    pub movement_reaction_ms: ReactionReport,
    /// Whether decisions came in time.
    pub anticipation: AnticipationReport,
    /// What was done and said.
    pub task: TaskReport,
    /// Faults, and how the set came over them.
    pub faults: Vec<FaultReport>,
    /// "pass" or "fail".
    pub verdict: &'static str,
    /// Why not "pass": one sentence for each rule that was not kept.
    pub reasons: Vec<String>,
}

/// A histogram's figures, ns.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[allow(missing_docs, reason = "the names are the percentiles")]
pub struct Percentiles {
    /// How many durations were recorded.
    pub count: u64,
    pub p50: u64,
    pub p99: u64,
    pub p999: u64,
    /// The longest one.
    pub max: u64,
}

/// How regular one process was.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ProcessReport {
    /// Cycles that published an output.
    pub cycles: u64,
    /// Deadline misses.
    pub missed: u64,
    /// Longest run of them.
    pub longest_miss_run: u64,
    /// Periods without a cycle, because the one before overran.
    pub skipped: u64,
    /// How often it was restarted.
    pub restarts: u32,
    /// Actual minus scheduled start.
    pub wakeup_ns: Percentiles,
    /// From start to publication.
    pub execution_ns: Percentiles,
}

/// Whether decisions came in time.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AnticipationReport {
    /// The partner's actions to which an answer was expected.
    pub actions: usize,
    /// Those about which something was decided before grasp completion.
    pub decided_before_grasp: usize,
    /// Those of them that were decided rightly.
    pub correct: usize,
    /// Decision lead of all actions that were answered rightly, late ones included.
    pub lead_ms: LeadPercentiles,
    /// Every action.
    pub events: Vec<ActionEvent>,
}

/// Decision leads, ms; negative ones came too late; null without any.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[allow(missing_docs, reason = "the names are the percentiles")]
pub struct LeadPercentiles {
    pub p5: Option<i64>,
    pub p50: Option<i64>,
    pub p95: Option<i64>,
}

/// One fault.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FaultReport {
    /// Name of the process.
    pub process: String,
    /// What was done to it, or how it died.
    pub fault: String,
    /// Instant of the fault, s from the start of the run.
    pub at_s: f64,
    /// From the fault until the supervisor saw it.
    pub detected_ms: Option<f64>,
    /// From the fault until the first good output.
    pub recovered_ms: Option<f64>,
    /// Deadline misses of all other processes between fault and recovery.
    pub survivors_missed: u64,
    /// The same, by process.
    pub survivors_missed_by: BTreeMap<String, u64>,
}

/// What a summary is made from.
#[derive(Debug)]
pub struct Findings<'a> {
    /// The task.
    pub task: &'a Task,
    /// Where it ran.
    pub environment: Environment,
    /// Every event of the run.
    pub events: &'a [Event],
    /// Latencies and deadline accounts; none in lockstep, where no clock runs.
    pub figures: Option<&'a Figures>,
    /// How well the arm followed its commands.
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

impl Summary {
    /// Draws the conclusions.
    pub fn new(findings: Findings) -> Self {
        let Findings { task, environment, events, figures, tracking, reaction, start_ns, duration_s, rules } =
            findings;
        let mut summary = Self {
            environment,
            processes: figures.map(processes).unwrap_or_default(),
            hops: figures.map(hops).unwrap_or_default(),
            end_to_end_ns: figures.map(|own| percentiles(own, END_TO_END)).unwrap_or_default(),
            tracking_error_rad: tracking,
            movement_reaction_ms: reaction,
            anticipation: AnticipationReport::new(events),
            task: TaskReport::new(task, events, duration_s),
            faults: faults(events, start_ns),
            verdict: "pass",
            reasons: Vec::new(),
        };
        summary.reasons = verdict::reasons(&summary, events, duration_s, rules);
        summary.verdict = if summary.reasons.is_empty() { "pass" } else { "fail" };
        summary
    }
}

impl Percentiles {
    /// Of a histogram; all 0 when it is empty.
    pub fn of(histogram: &Histogram<u64>) -> Self {
        Self {
            count: histogram.len(),
            p50: histogram.value_at_quantile(0.5),
            p99: histogram.value_at_quantile(0.99),
            p999: histogram.value_at_quantile(0.999),
            max: histogram.max(),
        }
    }
}

impl AnticipationReport {
    /// From the events of a run.
    pub fn new(events: &[Event]) -> Self {
        let actions: Vec<ActionEvent> = events.iter().filter_map(Event::as_action).cloned().collect();
        let expected = || actions.iter().filter(|action| action.expected.is_some());
        let mut leads: Vec<i64> =
            expected().filter(|action| action.correct).filter_map(|action| action.lead_ms).collect();
        leads.sort_unstable();
        Self {
            actions: expected().count(),
            decided_before_grasp: expected().filter(|action| action.decided_before_grasp()).count(),
            correct: expected().filter(|action| action.anticipated()).count(),
            lead_ms: LeadPercentiles::of(&leads),
            events: actions,
        }
    }
}

impl LeadPercentiles {
    /// Of leads in ascending order, by nearest rank.
    fn of(sorted: &[i64]) -> Self {
        let rank = |share: f64| ((share * sorted.len() as f64).ceil() as usize).max(1) - 1;
        let at = |share| sorted.get(rank(share)).copied();
        Self { p5: at(0.05), p50: at(0.5), p95: at(0.95) }
    }
}

fn percentiles(figures: &Figures, name: &str) -> Percentiles {
    figures.histograms().get(name).map(|own| Percentiles::of(own.total())).unwrap_or_default()
}

fn processes(figures: &Figures) -> BTreeMap<String, ProcessReport> {
    let report = |name: &str, account: &crate::Account| ProcessReport {
        cycles: account.cycles,
        missed: account.missed,
        longest_miss_run: account.longest_miss_run,
        skipped: account.skipped,
        restarts: account.restarts,
        wakeup_ns: percentiles(figures, &wakeup_name(name)),
        execution_ns: percentiles(figures, &execution_name(name)),
    };
    figures.accounts().iter().map(|(name, account)| (name.clone(), report(name, account))).collect()
}

fn hops(figures: &Figures) -> BTreeMap<String, Percentiles> {
    let edges = figures.links().iter().filter_map(|link| Some((link.input_from.as_ref()?, &link.process)));
    edges
        .filter(|(from, to)| figures.histograms().contains_key(&hop_name(from, to)))
        .map(|(from, to)| (format!("{from}->{to}"), percentiles(figures, &hop_name(from, to))))
        .collect()
}

fn faults(events: &[Event], start_ns: u64) -> Vec<FaultReport> {
    let faults = events.iter().filter_map(|event| match event {
        Event::Fault(fault) => Some(fault),
        _ => None,
    });
    let report = |fault: &FaultEvent| FaultReport {
        process: fault.process.clone(),
        fault: fault.fault.clone(),
        at_s: fault.at_ns.saturating_sub(start_ns) as f64 / 1e9,
        detected_ms: fault.detected_ms,
        recovered_ms: fault.recovered_ms,
        survivors_missed: fault.survivors_missed.values().sum(),
        survivors_missed_by: fault.survivors_missed.clone(),
    };
    faults.map(report).collect()
}
