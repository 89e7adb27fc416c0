use crate::{Figure, Peak, RunTrace};
use coact_messages::LayerKind;
use serde::Serialize;

/// `figures.json`: what the pictures show, for programs. Times in s from the start of the run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Index {
    /// Seed of the runs.
    pub seed: u64,
    /// The figures, by number.
    pub figures: Vec<FigureEntry>,
}

/// One figure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FigureEntry {
    /// Its number in the chapter.
    pub figure: u32,
    /// What it shows.
    pub title: &'static str,
    /// Its files, in the folder of the index.
    pub files: [String; 2],
    /// The runs that it shows.
    pub runs: Vec<RunEntry>,
}

/// One run of a figure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RunEntry {
    /// The task's name.
    pub task: String,
    /// The person's script, below `rt-config/scenarios`.
    pub scenario: &'static str,
    /// What the person did.
    pub intervals: Vec<IntervalEntry>,
    /// What the robot decided: peaks of AEL.
    pub decisions: Vec<PeakEntry>,
    /// Peaks of the layers that the figure shows.
    pub peaks: Vec<PeakEntry>,
}

/// What the person did in an interval, and what the robot decided in it.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct IntervalEntry {
    pub name: String,
    pub doing: String,
    pub from_s: f64,
    pub to_s: f64,
    pub decisions: Vec<String>,
}

/// A peak from threshold to threshold.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct PeakEntry {
    pub layer: &'static str,
    pub population: String,
    pub from_s: f64,
    pub to_s: f64,
}

impl Index {
    pub(crate) fn new(seed: u64) -> Self {
        Self { seed, figures: Vec::new() }
    }

    pub(crate) fn add(&mut self, figure: &Figure, runs: &[&RunTrace], files: [String; 2]) {
        let layers = figure.layers();
        let run = |run: &&RunTrace| RunEntry {
            task: run.task.name.clone(),
            scenario: run.scenario.file(),
            intervals: intervals(run),
            decisions: run.peaks_of(LayerKind::ActionExecution).map(PeakEntry::of).collect(),
            peaks: run.peaks.iter().filter(|peak| layers.contains(&peak.layer)).map(PeakEntry::of).collect(),
        };
        let runs = runs.iter().map(run).collect();
        self.figures.push(FigureEntry { figure: figure.number, title: figure.title, files, runs });
    }
}

fn intervals(run: &RunTrace) -> Vec<IntervalEntry> {
    let done = |interval: &crate::Interval| {
        let inside = |peak: &&Peak| (interval.from_ms..interval.to_ms).contains(&peak.from_ms);
        let decisions = run.peaks_of(LayerKind::ActionExecution).filter(inside);
        IntervalEntry {
            name: interval.name.clone(),
            doing: interval.doing.clone(),
            from_s: interval.from_ms / 1000.0,
            to_s: interval.to_ms / 1000.0,
            decisions: decisions.map(|peak| peak.label.clone()).collect(),
        }
    };
    run.intervals.iter().map(done).collect()
}

impl PeakEntry {
    fn of(peak: &Peak) -> Self {
        Self {
            layer: peak.layer.name(),
            population: peak.label.clone(),
            from_s: peak.from_ms / 1000.0,
            to_s: peak.to_ms / 1000.0,
        }
    }
}
