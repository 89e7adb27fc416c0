use crate::{
    AnticipationReport, Environment, FaultReport, Judgement, MotionReport, OperatorStopReport, OutageReport,
    Percentiles, ProcessReport, ReactionReport, RecordError, SeparationReport, TaskReport, TrackingReport,
};
use coact_input_file::LONGEST_LOG;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io::ErrorKind;
use std::path::Path;

/// `summary.json`: what a run was like. Programs of users read it, so keys are added, but not renamed without need.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Summary {
    /// Where it ran.
    pub environment: Environment,
    /// How regular each process was; none in lockstep, where no process runs.
    pub processes: BTreeMap<String, ProcessReport>,
    /// Hop of each edge, by `<from>-><to>`.
    pub hops: BTreeMap<String, Percentiles>,
    /// From the sensor sample's stamp to the publication of the command.
    pub end_to_end_ns: Percentiles,
    /// Cycles without a timely command that descends from a sensor sample young enough to be used, over cycles due.
    pub command_outage: OutageReport,
    /// How the arm moved, measured at its joints.
    pub motion: MotionReport,
    /// How near robot and person came.
    #[serde(default)]
    pub separation: SeparationReport,
    /// For how long the monitor itself lost what it watches, s.
    pub blind_s: f64,
    /// How well the arm followed its setpoints.
    pub tracking_error_rad: TrackingReport,
    /// From a changed decision to the first command that it changes, ms.
    pub movement_reaction_ms: ReactionReport,
    /// Whether decisions came in time.
    pub anticipation: AnticipationReport,
    /// What was done and said.
    pub task: TaskReport,
    /// How many messages each process ignored because they were not good, by process and reason; processes that ignored none
    /// are left out.
    #[serde(default)]
    pub refused: BTreeMap<String, BTreeMap<String, u64>>,
    /// When an operator had the robot stand.
    #[serde(default)]
    pub operator_stops: Vec<OperatorStopReport>,
    /// Faults, and the recovery from each.
    pub faults: Vec<FaultReport>,
    /// The work: task, anticipation, safety, nothing lost.
    pub work: Judgement,
    /// The timing, which is this machine's as well: outage, end to end.
    pub timing: Judgement,
}

impl Summary {
    /// Name of the file in the report directory.
    pub const FILE: &'static str = "summary.json";

    /// Of a run whose monitor did not live to measure it: what was logged, and a verdict that says why there is no more.
    pub fn unmeasured(task: TaskReport, reason: String) -> Self {
        Self {
            environment: Environment::default(),
            processes: BTreeMap::new(),
            hops: BTreeMap::new(),
            end_to_end_ns: Percentiles::default(),
            command_outage: OutageReport::default(),
            motion: MotionReport::default(),
            separation: SeparationReport::default(),
            blind_s: 0.0,
            tracking_error_rad: TrackingReport::default(),
            movement_reaction_ms: ReactionReport::default(),
            anticipation: AnticipationReport::new(&[]),
            task,
            refused: BTreeMap::new(),
            operator_stops: Vec::new(),
            faults: Vec::new(),
            work: Judgement::new(vec![reason.clone()]),
            timing: Judgement::new(vec![reason]),
        }
    }

    /// Reads the summary of a report directory.
    ///
    /// # Errors
    /// There is none, or it is damaged.
    pub fn read(report: &Path) -> Result<Self, RecordError> {
        let path = report.join(Self::FILE);
        let text = coact_input_file::read_text_within(&path, LONGEST_LOG)
            .map_err(|cause| RecordError::File { path: path.clone(), cause })?;
        serde_json::from_str(&text).map_err(|cause| RecordError::Summary { path, cause })
    }

    /// Writes the summary into a report directory.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, report: &Path) -> Result<(), RecordError> {
        let path = report.join(Self::FILE);
        serde_json::to_string_pretty(self)
            .map_err(std::io::Error::from)
            .and_then(|text| std::fs::write(&path, text + "\n"))
            .map_err(|cause| RecordError::File { path, cause })
    }

    /// Removes what an earlier run left in a report directory, so that no reader takes it for this run's.
    ///
    /// # Errors
    /// There is one, and it cannot be removed.
    pub fn remove(report: &Path) -> Result<(), RecordError> {
        let path = report.join(Self::FILE);
        match std::fs::remove_file(&path) {
            Err(cause) if cause.kind() != ErrorKind::NotFound => Err(RecordError::File { path, cause }),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use crate::{Event, MachineReport};

    fn summary() -> Summary {
        let machine = Some(MachineReport { wakeups: 1000, late: 3, p999_ns: 500_000, longest_ns: 2_345_678 });
        Summary {
            environment: Environment { machine, ..Environment::default() },
            processes: BTreeMap::new(),
            hops: BTreeMap::new(),
            end_to_end_ns: Percentiles::default(),
            command_outage: OutageReport::default(),
            motion: MotionReport::default(),
            separation: SeparationReport::default(),
            blind_s: 0.0,
            tracking_error_rad: TrackingReport::default(),
            movement_reaction_ms: ReactionReport::default(),
            anticipation: AnticipationReport::new(&[]),
            task: TaskReport::new(|_| 2, &[Event::Assembly { at_ms: 1200, completed: 1 }], 2.0),
            refused: BTreeMap::new(),
            operator_stops: Vec::new(),
            faults: Vec::new(),
            work: Judgement::new(vec!["only 0 of 2 subgoals were achieved".into()]),
            timing: Judgement::default(),
        }
    }

    #[test]
    fn what_was_written_is_read_back_until_it_is_removed() {
        let report = tempfile::tempdir().unwrap();
        summary().write(report.path()).unwrap();
        assert_eq!(Summary::read(report.path()).unwrap(), summary());
        Summary::remove(report.path()).unwrap();
        Summary::remove(report.path()).unwrap();
        let error = Summary::read(report.path()).unwrap_err().to_string();
        assert!(error.contains("summary.json: No such file"), "{error}");
    }

    #[test]
    fn a_file_that_is_no_summary_is_refused_with_the_place_of_the_damage() {
        let report = tempfile::tempdir().unwrap();
        std::fs::write(report.path().join(Summary::FILE), "{\n  \"environment\": 3\n}\n").unwrap();
        let error = Summary::read(report.path()).unwrap_err().to_string();
        assert!(
            error.contains("summary.json: not a summary of a run: ") && error.contains("line 2"),
            "{error}"
        );
    }
}
