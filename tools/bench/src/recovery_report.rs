use crate::ReadersOutage;
use coact_monitor::{histogram, percentiles};
use coact_run_records::{FaultReport, Judgement, OutageReport, Percentiles, ProcessReport, Summary};
use serde::Serialize;
use std::collections::BTreeMap;

/// What many faults of a running set cost.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RecoveryReport {
    /// What was done to the processes.
    pub fault: &'static str,
    /// Of each process that was struck: all faults.
    pub processes: BTreeMap<String, Recovery>,
    /// The same without those during which the machine itself was late: the idle thread by half a period or more, or the stage that
    /// starts the chain, which nobody strikes, by a cycle.
    pub machine_in_time: BTreeMap<String, Recovery>,
    /// Of each stage that was struck and has a standby: what its readers went without, after the faults and otherwise.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub readers: BTreeMap<String, ReadersOutage>,
    /// Cycles without a timely command, over the whole run.
    pub command_outage: OutageReport,
    /// Wake-ups of the idle thread that came late by a period meanwhile; none where there was no such thread.
    pub machine_late: Option<u64>,
    /// The verdict on the work of the whole run.
    pub work: Judgement,
}

/// What the faults of one process cost.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Recovery {
    /// Faults.
    pub count: u64,
    /// From its last good output to its replacement's first, ns. Those that never recovered count in `lost` only.
    pub recovered: Percentiles,
    /// Faults without a recovery.
    pub lost: u64,
    /// Faults in which no other process went without a timely output.
    pub others_missed_none: u64,
    /// Where it has a standby: how many faults left the stage's readers so many cycles without a timely message.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub without_output: BTreeMap<u64, u64>,
}

impl RecoveryReport {
    /// Of a run in which this `fault` was injected into processes other than `first`, the stage that starts the chain.
    pub fn new(fault: &'static str, first: &str, summary: &Summary) -> Self {
        let struck = summary.faults.iter().filter(|report| report.fault == fault);
        let in_time = struck.clone().filter(|report| machine_in_time(report, first));
        let has_standby = |process: &str| summary.processes.contains_key(&standby_of(process));
        Self {
            fault,
            readers: readers(struck.clone(), &summary.processes),
            processes: by_process(struck, has_standby),
            machine_in_time: by_process(in_time, has_standby),
            command_outage: summary.command_outage,
            machine_late: summary.environment.machine.map(|machine| machine.late),
            work: summary.work.clone(),
        }
    }
}

fn machine_in_time(report: &FaultReport, first: &str) -> bool {
    report.machine_late_ms == 0.0 && report.survivors_missed_by.get(first).is_none_or(|missed| *missed == 0)
}

fn by_process<'a>(
    faults: impl Iterator<Item = &'a FaultReport>,
    has_standby: impl Fn(&str) -> bool,
) -> BTreeMap<String, Recovery> {
    let mut struck: BTreeMap<&str, Vec<&FaultReport>> = BTreeMap::new();
    faults.for_each(|fault| struck.entry(&fault.process).or_default().push(fault));
    let recovery = |(name, own): (&str, Vec<_>)| (name.to_owned(), Recovery::of(&own, has_standby(name)));
    struck.into_iter().map(recovery).collect()
}

fn readers<'a>(
    faults: impl Iterator<Item = &'a FaultReport>,
    processes: &BTreeMap<String, ProcessReport>,
) -> BTreeMap<String, ReadersOutage> {
    let mut struck: BTreeMap<&str, ReadersOutage> = BTreeMap::new();
    for fault in faults {
        if let Some(standby) = processes.get(&standby_of(&fault.process)) {
            let outage =
                struck.entry(&fault.process).or_insert_with(|| ReadersOutage::before_any(&standby.outage));
            outage.add(fault, missed_by_standby(fault));
        }
    }
    struck.into_iter().map(|(stage, outage)| (stage.to_owned(), outage)).collect()
}

impl Recovery {
    fn of(faults: &[&FaultReport], has_standby: bool) -> Self {
        let mut times = histogram();
        for ms in faults.iter().filter_map(|fault| fault.recovered_ms) {
            times.saturating_record((ms * NS_PER_MS) as u64);
        }
        let mut without_output = BTreeMap::new();
        for fault in faults.iter().filter(|_| has_standby) {
            *without_output.entry(missed_by_standby(fault)).or_default() += 1;
        }
        let count = faults.len() as u64;
        let others_missed_none = faults.iter().filter(|fault| fault.survivors_missed == 0).count() as u64;
        Self {
            count,
            recovered: percentiles(&times),
            lost: count - times.len(),
            others_missed_none,
            without_output,
        }
    }
}

const NS_PER_MS: f64 = 1e6;

/// Name of the standby of a stage.
fn standby_of(stage: &str) -> String {
    format!("{stage}-standby")
}

/// Cycles that the standby of the stage that was struck left without a timely message of its own.
fn missed_by_standby(fault: &FaultReport) -> u64 {
    fault.survivors_missed_by.get(&standby_of(&fault.process)).copied().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::MissedCycles;

    fn fault(recovered_ms: Option<f64>, standby_missed: u64) -> FaultReport {
        FaultReport {
            process: "fields".into(),
            fault: "kill".into(),
            at_s: 1.0,
            detected_ms: Some(2.0),
            recovered_ms,
            survivors_missed: standby_missed,
            survivors_missed_by: BTreeMap::from([("fields-standby".into(), standby_missed)]),
            machine_late_ms: 0.0,
        }
    }

    #[test]
    fn percentiles_are_those_of_what_recovered_and_what_did_not_is_told() {
        let faults: Vec<_> =
            (1..=100).map(|ms| fault(Some(f64::from(ms)), 0)).chain([fault(None, 2)]).collect();
        let recovery = Recovery::of(&faults.iter().collect::<Vec<_>>(), true);
        assert_eq!((recovery.count, recovery.lost, recovery.recovered.count), (101, 1, 100));
        // The histogram has three digits.
        let ms = |ns: u64| (ns as f64 / NS_PER_MS).round();
        let Percentiles { p50, p99, max, .. } = recovery.recovered;
        assert_eq!([p50, p99, max].map(ms), [50.0, 99.0, 100.0]);
        assert_eq!(recovery.without_output, BTreeMap::from([(0, 100), (2, 1)]));
        assert_eq!(recovery.others_missed_none, 100);
        assert_eq!(Recovery::of(&[], true), Recovery::default());
    }

    #[test]
    fn a_fault_that_met_a_late_machine_says_so() {
        let late = FaultReport { machine_late_ms: 0.6, ..fault(None, 0) };
        assert!(machine_in_time(&fault(None, 2), "world"), "the standby alone missed cycles");
        assert!(!machine_in_time(&late, "world"));
        assert!(!machine_in_time(&fault(None, 2), "fields-standby"), "the first stage itself missed cycles");
    }

    #[test]
    fn what_the_standby_missed_is_told_apart_from_what_it_misses_anyway() {
        let outage = OutageReport { due: 10_000, without_output: 30, ..OutageReport::default() };
        let standby = ProcessReport { outage, ..ProcessReport::default() };
        let faults = [fault(Some(6.0), 1), fault(Some(4.0), 0), fault(None, 7)];
        let found = readers(faults.iter(), &BTreeMap::from([("fields-standby".into(), standby)]));
        let expected = ReadersOutage {
            during_faults: MissedCycles { missed: 1, due: 10 },
            otherwise: MissedCycles { missed: 29, due: 9990 },
        };
        assert_eq!(found, BTreeMap::from([("fields".into(), expected)]));
        assert_eq!(found["fields"].during_faults.per_thousand(), 100.0);
        assert!(readers(faults.iter(), &BTreeMap::new()).is_empty(), "nobody stands by");
    }

    #[test]
    fn each_process_has_its_own_row() {
        let control = FaultReport { process: "control".into(), ..fault(Some(3.0), 0) };
        let faults = [fault(Some(7.0), 0), control, fault(None, 1)];
        let rows = by_process(faults.iter(), |process| process == "fields");
        let counts: Vec<_> =
            rows.iter().map(|(process, row)| (process.as_str(), row.count, row.lost)).collect();
        assert_eq!(counts, [("control", 1, 0), ("fields", 2, 1)]);
        assert!(rows["control"].without_output.is_empty(), "it has no standby");
    }
}
