use crate::heat_map::HeatMap;
use crate::layer_page::{Column, LayerPage};
use crate::page::Caption;
use crate::{Peak, Quantity, RunTrace};
use coact_messages::LayerKind;

/// Time shown before and after the inference, ms: what it opens has happened within a second. Chosen by hand.
const AROUND: [f64; 2] = [500.0, 1500.0];

/// What an inferred goal does to the plan before it is reached.
#[derive(Debug, Clone)]
pub struct Prediction<'a> {
    trace: &'a RunTrace,
    /// The first goal that was inferred.
    pub goal: Option<&'a Peak>,
    /// Subgoals that became available on it while what comes before them was not achieved: indices.
    pub opened: Vec<usize>,
}

impl<'a> Prediction<'a> {
    /// Finds the first inference of a run and the subgoals that it opened.
    pub fn of(trace: &'a RunTrace) -> Self {
        let goal = trace.peaks_of(LayerKind::Intention).next();
        let early = |peak: &&Peak| {
            let done = trace.peaks_of(LayerKind::SubgoalsAchieved).filter(|done| done.from_ms < peak.from_ms);
            let subgoals = done.filter(|done| done.population < trace.task.subgoals.len());
            let achieved = subgoals.fold(0, |mask, done| mask | 1 << done.population);
            goal.is_some_and(|goal| peak.from_ms >= goal.from_ms)
                && !trace.task.is_prepared(peak.population, achieved)
        };
        let mut opened: Vec<usize> =
            trace.peaks_of(LayerKind::SubgoalsAvailable).filter(early).map(|peak| peak.population).collect();
        opened.sort_unstable();
        opened.dedup();
        Self { trace, goal, opened }
    }

    /// The subgoals of now, the inferred goal, and the subgoals that it opens, around the instant of inference.
    pub(crate) fn page(&self, mut caption: Caption) -> LayerPage {
        let (from, to) = match self.goal {
            Some(goal) => (goal.from_ms - AROUND[0], (goal.from_ms + AROUND[1]).min(self.trace.end_ms())),
            None => (0.0, self.trace.end_ms()),
        };
        caption.notes.push(match self.goal {
            Some(goal) => format!(
                "\u{201c}{}\u{201d} is inferred at {:.2} s. C: what this opens before it is achieved; one layer, two panels.",
                goal.label,
                goal.from_ms / 1000.0
            ),
            None => "No goal was inferred in this run.".into(),
        });
        let available = LayerKind::SubgoalsAvailable;
        let now: Vec<usize> =
            (0..self.trace.task.subgoals.len()).filter(|subgoal| !self.opened.contains(subgoal)).collect();
        let intention = self.trace.surface(LayerKind::Intention, Quantity::Activity);
        let goals = intention.reaching(0.0);
        let map = |letter: &str, layer, quantity, rows: &[usize]| {
            let surface = self.trace.surface(layer, quantity).only(rows).between(from, to);
            let plan = self.trace.plan.layer(layer);
            HeatMap::of(letter, layer, quantity, vec![surface], (plan.gain as f32, plan.resting as f32))
        };
        LayerPage {
            caption,
            columns: vec![Column::of(self.trace, from, to)],
            maps: vec![
                map("A", available, Quantity::Activity, &now),
                map("B", LayerKind::Intention, Quantity::Activity, &goals),
                map("C", available, Quantity::Input, &self.opened),
                map("C", available, Quantity::Activity, &self.opened),
            ],
        }
    }
}
