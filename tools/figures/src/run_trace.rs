use crate::interval_tracker::IntervalTracker;
use crate::{FigureError, Interval, Scenario, Surface};
use coact_joint_task::{LayerPlan, NetworkPlan, Task};
use coact_lockstep::Lockstep;
use coact_messages::{FieldFrame, LayerKind, PartnerPhase, SceneView};
use coact_period::cycles;
use std::path::Path;
use std::time::Duration;

/// Time between two samples, ticks: a run of ten seconds has about one for each pixel of the page.
const SAMPLE_EVERY: u64 = cycles(Duration::from_millis(10));
/// How long a run goes on when the person has come to rest, ticks: what the robot decides on that is seen as well.
const AFTERWARDS: u64 = cycles(Duration::from_secs(1));
/// How long it lasts at most, ticks: the end of a scenario that gets stuck. Chosen by hand, longer than any takes.
const LONGEST: u64 = cycles(Duration::from_secs(90));

/// All that the figures show of a run, sample by sample.
#[derive(Debug, Clone)]
pub struct RunTrace {
    /// What the person did.
    pub scenario: Scenario,
    /// The task.
    pub task: Task,
    /// The network.
    pub plan: NetworkPlan,
    /// What the person really did, one thing after the other.
    pub intervals: Vec<Interval>,
    /// Peaks of all layers, in the order in which they begin.
    pub peaks: Vec<Peak>,
    /// Instants at which the person's fingers had closed (or a gesture was shown), ms.
    pub grasps_ms: Vec<f64>,
    /// Instants at which a part really came to its place, ms.
    pub achievements_ms: Vec<f64>,
    /// What the robot's camera saw before the person began.
    pub scene: SceneView,
    layers: Vec<[Surface; 2]>,
}

/// Which quantity of a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quantity {
    /// S(x, t) of the chapter's equation 1.
    Input = 0,
    /// u(x, t).
    Activity = 1,
}

/// A self-sustained pattern of one population, from threshold to threshold.
#[derive(Debug, Clone, PartialEq)]
pub struct Peak {
    /// Its layer.
    pub layer: LayerKind,
    /// Index of the population in its layer.
    pub population: usize,
    /// What the population stands for.
    pub label: String,
    /// When it crossed threshold, ms.
    pub from_ms: f64,
    /// When it fell below again; the end of the run if it did not, ms.
    pub to_ms: f64,
}

impl RunTrace {
    /// When the scene is copied: all parts have been seen, and the person has not begun.
    pub const SCENE_MS: f64 = 1500.0;

    /// Runs a scenario to its end; `progress` is called with the time of the run, ms, at each sample.
    ///
    /// # Errors
    /// A file that a stage refuses.
    pub fn of(
        scenario: Scenario,
        configuration: &Path,
        seed: u64,
        progress: &mut dyn FnMut(u64),
    ) -> Result<Self, FigureError> {
        let mut stages = Lockstep::new(&scenario.settings(configuration, seed))?;
        let mut trace = Self::empty(scenario, &stages);
        let (mut tracker, mut rested, mut achieved, mut grasp) = (IntervalTracker::default(), 0, 0, 0);
        while stages.ticks() < LONGEST && rested < AFTERWARDS {
            stages.step();
            let (tick, truth) = (stages.ticks(), &stages.truth);
            let ms = tick as f64;
            tracker.observe(ms, truth);
            trace.follow_peaks(&stages.frame, ms);
            if truth.grasp_cycle > grasp {
                trace.grasps_ms.push(ms);
            }
            if tick > 1 && truth.achieved & !achieved != 0 {
                trace.achievements_ms.push(ms);
            }
            (grasp, achieved) = (truth.grasp_cycle, truth.achieved);
            if ms == Self::SCENE_MS {
                trace.scene = stages.sample.scene;
            }
            if tick.is_multiple_of(SAMPLE_EVERY) {
                trace.sample(&stages.frame);
                progress(tick);
            }
            let over = truth.actions == scenario.actions() && truth.phase == PartnerPhase::Idle as u32;
            rested = if over { rested + 1 } else { 0 };
        }
        let end = stages.ticks() as f64;
        trace.intervals = tracker.intervals(stages.task(), scenario.first_interval(), end);
        trace.peaks.iter_mut().for_each(|peak| peak.to_ms = peak.to_ms.min(end));
        Ok(trace)
    }

    /// A quantity of a layer during the whole run.
    pub fn surface(&self, layer: LayerKind, quantity: Quantity) -> &Surface {
        &self.layers[layer as usize][quantity as usize]
    }

    /// Its end, ms.
    pub fn end_ms(&self) -> f64 {
        self.intervals.last().map_or(0.0, |interval| interval.to_ms)
    }

    /// Peaks of a layer.
    pub fn peaks_of(&self, layer: LayerKind) -> impl Iterator<Item = &Peak> {
        self.peaks.iter().filter(move |peak| peak.layer == layer)
    }

    fn empty(scenario: Scenario, stages: &Lockstep) -> Self {
        let plan = stages.plan();
        let surface = |layer: &LayerPlan| Surface {
            labels: plan
                .populations_of(layer.kind)
                .iter()
                .map(|population| population.label.clone())
                .collect(),
            sites: plan.sites_per_population,
            start_ms: SAMPLE_EVERY as f64,
            period_ms: SAMPLE_EVERY as f64,
            values: Vec::new(),
        };
        Self {
            scenario,
            task: stages.task().clone(),
            plan: plan.clone(),
            intervals: Vec::new(),
            peaks: Vec::new(),
            grasps_ms: Vec::new(),
            achievements_ms: Vec::new(),
            scene: stages.sample.scene,
            layers: plan.layers.iter().map(|layer| [surface(layer), surface(layer)]).collect(),
        }
    }

    fn sample(&mut self, frame: &FieldFrame) {
        for (index, surfaces) in self.layers.iter_mut().enumerate() {
            let first = frame.layers.first_site[index] as usize;
            let sites = first..first + frame.layers.sites[index] as usize;
            for (surface, row) in surfaces.iter_mut().zip([&frame.input, &frame.activity]) {
                surface.values.extend(row[sites.clone()].iter().map(|&value| value as f32));
            }
        }
    }

    fn follow_peaks(&mut self, frame: &FieldFrame, ms: f64) {
        for layer in &self.plan.layers {
            for (population, index) in layer.populations.clone().enumerate() {
                let same = |peak: &&mut Peak| (peak.layer, peak.population) == (layer.kind, population);
                let standing =
                    self.peaks.iter_mut().rev().find(same).filter(|peak| peak.to_ms == f64::INFINITY);
                match (frame.signal[index] > 0.0, standing) {
                    (true, None) => self.peaks.push(Peak {
                        layer: layer.kind,
                        population,
                        label: self.plan.populations[index].label.clone(),
                        from_ms: ms,
                        to_ms: f64::INFINITY,
                    }),
                    (false, Some(peak)) => peak.to_ms = ms,
                    _ => {}
                }
            }
        }
    }
}
