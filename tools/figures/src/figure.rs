use crate::heat_map::HeatMap;
use crate::layer_page::{Column, LayerPage};
use crate::page::Caption;
use crate::prediction::Prediction;
use crate::{FigureError, Quantity, RunTrace, Scenario, single_field, table_view};
use coact_drawing::{Lettering, Sheet};
use coact_messages::LayerKind;

/// Least input of a population that is shown, as a fraction of what ignites it: less cannot be seen in the colours. Chosen
/// by hand.
const MATTERS: f32 = 0.1;

/// One of the chapter's figures.
#[derive(Debug, Clone, Copy)]
pub struct Figure {
    /// Its number in the chapter.
    pub number: u32,
    /// What it shows.
    pub title: &'static str,
    content: Content,
}

#[derive(Debug, Clone, Copy)]
enum Content {
    Activation,
    Decision,
    ObjectMemory,
    Prediction,
    Layers(&'static [Scenario], &'static [Panel]),
}

/// A layer in a figure: its letter there, and whether its input is shown above its activity.
type Panel = (&'static str, LayerKind, bool);

impl Figure {
    /// All of them, by number.
    pub const ALL: [Self; 11] = [
        Self {
            number: 3,
            title: "resting state, response below threshold and self-stabilised peak of a population",
            content: Content::Activation,
        },
        Self {
            number: 4,
            title: "decision making in a field of different actions, A1 to A4",
            content: Content::Decision,
        },
        Self {
            number: 6,
            title: "objects on the table and their representation in the object memory (OML)",
            content: Content::ObjectMemory,
        },
        Self {
            number: 7,
            title: "currently available subgoals (CSGL)",
            content: Content::Layers(&[Scenario::Proactive], &[("", LayerKind::SubgoalsAvailable, false)]),
        },
        Self {
            number: 8,
            title: "pro-active behaviour and goal inference: action simulation (ASL) and action execution (AEL)",
            content: Content::Layers(
                &[Scenario::Proactive],
                &[("A", LayerKind::ActionSimulation, true), ("B", LayerKind::ActionExecution, true)],
            ),
        },
        Self {
            number: 9,
            title: "inferred goals of the person (IL)",
            content: Content::Layers(&[Scenario::Proactive], &[("", LayerKind::Intention, false)]),
        },
        Self {
            number: 11,
            title: "a partly hidden action: subgoals (CSGL), object memory (OML) and action simulation (ASL)",
            content: Content::Layers(
                &[Scenario::Occlusion],
                &[
                    ("A", LayerKind::SubgoalsAvailable, false),
                    ("B", LayerKind::ObjectMemoryRobot, false),
                    ("B", LayerKind::ObjectMemoryPerson, false),
                    ("C", LayerKind::ActionSimulation, true),
                ],
            ),
        },
        Self {
            number: 12,
            title: "the person's next subgoals, opened by the prediction of what she is about to achieve",
            content: Content::Prediction,
        },
        Self {
            number: 13,
            title: "anticipatory action selection (AEL)",
            content: Content::Layers(&[Scenario::Occlusion], &[("", LayerKind::ActionExecution, true)]),
        },
        Self {
            number: 15,
            title: "error detection and interpretation of a request in its context: action simulation (ASL)",
            content: Content::Layers(
                &[Scenario::Proactive, Scenario::Errors],
                &[("", LayerKind::ActionSimulation, true)],
            ),
        },
        Self {
            number: 16,
            title: "subgoals (CSGL), inferred goals (IL), detected errors (EML) and actions (AEL)",
            content: Content::Layers(
                &[Scenario::Errors],
                &[
                    ("A", LayerKind::SubgoalsAvailable, false),
                    ("B", LayerKind::Intention, false),
                    ("C", LayerKind::ErrorMonitoring, false),
                    ("D", LayerKind::ActionExecution, false),
                ],
            ),
        },
    ];

    /// The figures of these numbers; all, when none is given.
    ///
    /// # Errors
    /// A number that no figure has, with those that there are.
    pub fn select(numbers: &[u32]) -> Result<Vec<Self>, FigureError> {
        let all = Self::ALL;
        if let Some(&number) = numbers.iter().find(|number| all.iter().all(|known| known.number != **number))
        {
            let known: Vec<String> = all.iter().map(|figure| figure.number.to_string()).collect();
            return Err(FigureError::Unknown { number, known: known.join(", ") });
        }
        Ok(all.into_iter().filter(|one| numbers.is_empty() || numbers.contains(&one.number)).collect())
    }

    /// The runs that it shows.
    pub fn scenarios(&self) -> &'static [Scenario] {
        match self.content {
            Content::Activation | Content::Decision => &[],
            Content::ObjectMemory => &[Scenario::Proactive],
            Content::Prediction => &[Scenario::Occlusion],
            Content::Layers(scenarios, _) => scenarios,
        }
    }

    /// The layers that it shows.
    pub fn layers(&self) -> Vec<LayerKind> {
        match self.content {
            Content::Activation | Content::Decision => Vec::new(),
            Content::ObjectMemory => vec![LayerKind::ObjectMemoryRobot, LayerKind::ObjectMemoryPerson],
            Content::Prediction => vec![LayerKind::SubgoalsAvailable, LayerKind::Intention],
            Content::Layers(_, panels) => panels.iter().map(|(_, layer, _)| *layer).collect(),
        }
    }

    /// Draws it from these runs, in the order of [`scenarios`](Self::scenarios).
    ///
    /// # Errors
    /// A field that cannot be made.
    pub fn draw(&self, runs: &[&RunTrace], seed: u64, letters: &Lettering) -> Result<Sheet, FigureError> {
        let caption = self.caption(runs, seed);
        Ok(match (self.content, runs) {
            (Content::Activation, _) => single_field::activation(caption, letters)?,
            (Content::Decision, _) => single_field::decision(caption, letters)?,
            (Content::ObjectMemory, [run]) => table_view::object_memory(caption, run, letters),
            (Content::Prediction, [run]) => Prediction::of(run).page(caption).draw(letters),
            (Content::Layers(_, panels), runs) => layers(caption, runs, panels).draw(letters),
            (Content::ObjectMemory | Content::Prediction, _) => caption.sheet(letters).0,
        })
    }

    fn caption(&self, runs: &[&RunTrace], seed: u64) -> Caption {
        let mut notes = Vec::new();
        match runs.first() {
            None => notes.push("One field by itself, kernel and constants of our own.".into()),
            Some(run) => {
                let scripts: Vec<String> = runs
                    .iter()
                    .map(|run| format!("{} (section {})", run.scenario.file(), run.scenario.section()))
                    .collect();
                let scripts = scripts.join(", then ");
                notes.push(format!("Task: {}; person: {scripts}; seed {seed}.", run.task.name));
                if !matches!(self.content, Content::ObjectMemory) {
                    notes.push(
                        "White is the threshold of activity, or no input; red above, blue below.".into(),
                    );
                }
            }
        }
        Caption { number: self.number, title: self.title.to_owned(), notes }
    }
}

/// Layers over the whole time of the runs.
fn layers(mut caption: Caption, runs: &[&RunTrace], panels: &[Panel]) -> LayerPage {
    let mut maps = Vec::new();
    let mut partly = Vec::new();
    for &(letter, layer, with_input) in panels {
        let rows = rows_that_matter(layer, runs);
        let all = runs.first().map_or(0, |run| run.plan.populations_of(layer).len());
        if rows.len() < all {
            partly.push(format!("{} of {all} of {}", rows.len(), layer.name()));
        }
        if with_input {
            maps.push(map(runs, letter, layer, Quantity::Input, &rows));
        }
        maps.push(map(runs, letter, layer, Quantity::Activity, &rows));
    }
    if !partly.is_empty() {
        let percent = 100.0 * MATTERS;
        caption.notes.push(format!(
            "Only populations that got at some time more than {percent} % of the input that ignites them: {}.",
            partly.join(", ")
        ));
    }
    LayerPage { caption, columns: runs.iter().map(|run| Column::of(run, 0.0, run.end_ms())).collect(), maps }
}

fn map(runs: &[&RunTrace], letter: &str, layer: LayerKind, quantity: Quantity, rows: &[usize]) -> HeatMap {
    let surfaces = runs.iter().map(|run| run.surface(layer, quantity).only(rows)).collect();
    let constants = runs.first().map_or((1.0, -1.0), |run| {
        let plan = run.plan.layer(layer);
        (plan.gain as f32, plan.resting as f32)
    });
    HeatMap::of(letter, layer, quantity, surfaces, constants)
}

/// Populations of a layer that a figure shows: all of object memory and plan, of the others those that got input.
fn rows_that_matter(layer: LayerKind, runs: &[&RunTrace]) -> Vec<usize> {
    let all = runs.first().map_or(0, |run| run.plan.populations_of(layer).len());
    let shown_in_full = [
        LayerKind::ObjectMemoryRobot,
        LayerKind::ObjectMemoryPerson,
        LayerKind::SubgoalsAchieved,
        LayerKind::SubgoalsAvailable,
    ];
    if shown_in_full.contains(&layer) {
        return (0..all).collect();
    }
    let reached = |run: &&RunTrace| {
        run.surface(layer, Quantity::Input).reaching(MATTERS * run.plan.layer(layer).gain as f32)
    };
    let reached: Vec<usize> = runs.iter().flat_map(reached).collect();
    (0..all).filter(|row| reached.contains(row)).collect()
}
