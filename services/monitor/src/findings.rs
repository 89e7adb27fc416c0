use crate::metrics::{END_TO_END, execution_name, hop_name, wakeup_name};
use crate::{Metrics, ProcessCounters, Rules, percentiles, verdict};
use coact_joint_task::Task;
use coact_messages::Refusal;
use coact_period::PERIOD_NS;
use coact_run_records::{
    AnticipationReport, Environment, Event, FaultReport, Judgement, MotionReport, OperatorStopReport,
    OutageReport, Percentiles, ProcessReport, ReactionReport, SeparationReport, Summary, TaskReport,
    TrackingReport,
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
    /// When each process was requested to end, ns of `CLOCK_MONOTONIC`: up to then cycles were due.
    pub stop_requested: &'a BTreeMap<String, u64>,
    /// When an operator had the robot stand.
    pub operator_stops: Vec<OperatorStopReport>,
    /// How the arm moved.
    pub motion: MotionReport,
    /// How near robot and person came.
    pub separation: SeparationReport,
    /// For how long the monitor saw nothing, s.
    pub blind_s: f64,
    /// How well the arm followed its setpoints.
    pub tracking: TrackingReport,
    /// From decisions to movements.
    pub reaction: ReactionReport,
    /// Messages that the monitor ignored, by the number of their [`Refusal`].
    pub refused: [u32; Refusal::COUNT],
    /// Start of the run, ns of `CLOCK_MONOTONIC`.
    pub start_ns: u64,
    /// End of the run, likewise.
    pub end_ns: u64,
    /// What it had to reach.
    pub rules: &'a Rules,
}

impl Findings<'_> {
    /// Draws the conclusions.
    pub fn summary(self) -> Summary {
        let (processes, command_outage) = (self.processes(), self.command_outage());
        let duration_s = self.end_ns.saturating_sub(self.start_ns) as f64 / 1e9;
        let Self {
            task,
            environment,
            events,
            metrics,
            operator_stops,
            motion,
            separation,
            blind_s,
            tracking,
            reaction,
            refused,
            start_ns,
            rules,
            ..
        } = self;
        let mut summary = Summary {
            environment,
            processes,
            hops: metrics.map(hops).unwrap_or_default(),
            end_to_end_ns: metrics.map(|own| percentiles_of(own, END_TO_END)).unwrap_or_default(),
            command_outage,
            motion,
            separation,
            blind_s,
            tracking_error_rad: tracking,
            movement_reaction_ms: reaction,
            anticipation: AnticipationReport::new(events),
            task: TaskReport::new(|achieved| task.needed(achieved), events, duration_s),
            refused: ignored(metrics, refused.map(u64::from)),
            operator_stops,
            faults: FaultReport::all(events, start_ns),
            work: Judgement::default(),
            timing: Judgement::default(),
        };
        summary.work = Judgement::new(verdict::work(&summary, events, duration_s, rules));
        summary.timing = Judgement::new(verdict::timing(&summary, rules));
        summary
    }

    fn processes(&self) -> BTreeMap<String, ProcessReport> {
        let Some(metrics) = self.metrics else { return BTreeMap::new() };
        let names = metrics.nodes().iter().map(|node| &node.process);
        names.map(|name| (name.clone(), self.process(metrics, name))).collect()
    }

    /// A process that never published anything has no counters, and its cycles were due all the same.
    fn process(&self, metrics: &Metrics, name: &str) -> ProcessReport {
        let counters = metrics.counters().get(name).cloned().unwrap_or_default();
        ProcessReport {
            cycles: counters.cycles,
            missed: counters.missed,
            longest_miss_run: counters.longest_miss_run,
            skipped: counters.skipped,
            unseen: counters.unseen,
            restarts: counters.restarts,
            outage: counters.outage.until(self.due(name)),
            wakeup_ns: percentiles_of(metrics, &wakeup_name(name)),
            execution_ns: percentiles_of(metrics, &execution_name(name)),
        }
    }

    fn command_outage(&self) -> OutageReport {
        let nodes = self.metrics.map(Metrics::nodes).unwrap_or_default();
        let Some(last) = nodes.iter().find(|node| node.last) else { return OutageReport::default() };
        let counters = self.metrics.and_then(|metrics| metrics.counters().get(&last.process));
        let outage = counters.map(|counters: &ProcessCounters| counters.outage_on_fresh_data);
        outage.unwrap_or_default().until(self.due(&last.process))
    }

    /// Cycles of a process whose deadline had passed when its end was requested.
    fn due(&self, process: &str) -> u64 {
        let end_ns = self.stop_requested.get(process).copied().unwrap_or(self.end_ns);
        end_ns.saturating_sub(self.start_ns) / PERIOD_NS
    }
}

fn percentiles_of(metrics: &Metrics, name: &str) -> Percentiles {
    metrics.histograms().get(name).map(|own| percentiles(own.total())).unwrap_or_default()
}

/// What each process ignored, by reason; processes that ignored nothing are left out.
fn ignored(
    metrics: Option<&Metrics>,
    monitor: [u64; Refusal::COUNT],
) -> BTreeMap<String, BTreeMap<String, u64>> {
    let processes = metrics.into_iter().flat_map(Metrics::counters);
    let processes = processes.map(|(name, counters)| (name.as_str(), counters.refused));
    let by_reason = |counts: [u64; Refusal::COUNT]| {
        let counts = Refusal::ALL.iter().zip(counts).filter(|(_, count)| *count > 0);
        counts.map(|(reason, count)| (reason.name().to_owned(), count)).collect::<BTreeMap<_, _>>()
    };
    processes
        .chain([("monitor", monitor)])
        .map(|(name, counts)| (name.to_owned(), by_reason(counts)))
        .filter(|(_, reasons)| !reasons.is_empty())
        .collect()
}

fn hops(metrics: &Metrics) -> BTreeMap<String, Percentiles> {
    let edges = metrics.nodes().iter().filter_map(|node| Some((node.input_from.as_ref()?, &node.process)));
    edges
        .filter(|(from, to)| metrics.histograms().contains_key(&hop_name(from, to)))
        .map(|(from, to)| (format!("{from}->{to}"), percentiles_of(metrics, &hop_name(from, to))))
        .collect()
}
