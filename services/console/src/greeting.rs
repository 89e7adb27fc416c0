use crate::PictureMaker;
use crate::supervisor_link::tasks;
use coact_joint_task::{Act, Agent, Chain, Choice, NetworkPlan, Shape, Subgoal, Task};
use coact_messages::{LayerKind, MotionPhase};
use coact_motion::{Capsule, Solid};
use coact_pipeline::{Pipeline, RunSettings, Trigger};
use coact_supervisor::Fault;
use serde_json::{Value, json};

/// The first thing that a page is told: what the run is, and how the pictures are to be read.
#[derive(Debug)]
pub struct Greeting<'a> {
    /// Name of the run.
    pub run: &'a str,
    /// What it is made of.
    pub settings: &'a RunSettings,
    /// Its process table.
    pub pipeline: &'a Pipeline,
    /// What makes its pictures.
    pub maker: &'a PictureMaker,
    /// Whether it is over, and was recorded.
    pub recorded: bool,
}

/// Version of what page and server say to each other.
const VERSION: u32 = 1;

/// The chapter's names of the layers, section 3.
const TITLES: [&str; 9] = [
    "action observation layer",
    "object memory layer: the robot's side",
    "object memory layer: the person's side",
    "common subgoals layer: achieved",
    "common subgoals layer: available now",
    "action simulation layer",
    "intention layer",
    "error monitoring layer",
    "action execution layer",
];

impl Greeting<'_> {
    /// As it is sent. The role is each page's own.
    pub fn to_json(&self) -> Value {
        let Self { run, settings, pipeline, maker, recorded } = self;
        let (task, plan) = (maker.task(), maker.plan());
        let processes = pipeline.processes.iter().map(|entry| {
            let has_cycles = entry.trigger != Trigger::None;
            json!({ "name": entry.name, "core": entry.core, "priority": entry.priority, "realtime": entry.realtime,
                    "cycles": has_cycles })
        });
        let faults =
            Fault::ALL.map(|fault| json!({ "name": fault.name(), "description": fault.description() }));
        json!({
            "kind": "hello",
            "version": VERSION,
            "run": {
                "id": run,
                // Names of runs come again; each has a folder of its own.
                "report": settings.report.file_name().map(|name| name.to_string_lossy()),
                "task": task.name,
                "partner": settings.partner,
                "world": settings.world,
                "layout": settings.layout,
                "seed": settings.seed,
                "recorded": recorded,
            },
            "task": of_task(task),
            "robot": maker.forms().map(of_form).collect::<Vec<_>>(),
            "layers": LayerKind::ALL.map(|kind| of_layer(plan, kind)),
            "sites_per_population": plan.sites_per_population,
            "phases": MotionPhase::ALL.map(|phase| format!("{phase:?}").to_lowercase()),
            "sizes": {
                "forms": maker.forms().len(),
                "parts": task.parts.len(),
                "path": PictureMaker::WAY,
                "warmest": PictureMaker::WARMEST,
                "populations": plan.populations.len(),
            },
            "tasks": names_of_tasks(settings, *recorded),
            "faults": faults,
            "processes": processes.collect::<Vec<_>>(),
        })
    }
}

/// Tasks that can be played after this one; none of a run that is over.
fn names_of_tasks(settings: &RunSettings, recorded: bool) -> Vec<String> {
    let tasks = if recorded { Vec::new() } else { tasks(&settings.task) };
    tasks.into_iter().map(|(name, _)| name).collect()
}

fn of_task(task: &Task) -> Value {
    let shape = |shape: Shape| match shape {
        Shape::Cylinder { radius, height } => json!({ "cylinder": { "radius": radius, "height": height } }),
        Shape::Box { size } => json!({ "box": size }),
    };
    let kinds = task.kinds.iter().map(|kind| json!({ "name": kind.name, "shape": shape(kind.shape) }));
    let subgoals = task.subgoals.iter().map(
        |Subgoal { name, kind, side, socket, axis, after, after_choices, .. }| {
            let socket = json!({ "at": socket, "axis": axis });
            let after = json!({ "subgoals": after, "choices": after_choices });
            json!({ "name": name, "kind": kind, "side": agent(*side), "after": after, "socket": socket })
        },
    );
    let choices = task.choices.iter().map(|Choice { name, of, count, spares }| {
        json!({ "name": name, "of": of, "count": count, "spares": spares })
    });
    let postures = |name: &str, pitch: f64| json!({ "name": name, "pitch_deg": pitch.to_degrees() });
    let scene = &task.scene;
    json!({
        "kinds": kinds.collect::<Vec<_>>(),
        "subgoals": subgoals.collect::<Vec<_>>(),
        "choices": choices.collect::<Vec<_>>(),
        "actions": task.actions.iter().map(|action| &action.name).collect::<Vec<_>>(),
        "grips": task.grips.iter().map(|grip| postures(&grip.name, grip.pitch)).collect::<Vec<_>>(),
        "gestures": task.gestures.iter().map(|gesture| postures(&gesture.name, gesture.pitch)).collect::<Vec<_>>(),
        "pointing": task.chains.iter().find(|chain| chain.pointing).map(|chain| json!({
            "workspace": agent(chain.from), "leads_to": chain.name
        })),
        "grasps": grasps(task),
        "phrases": phrases(task),
        "scene": {
            "table": { "height": scene.table_height, "centre": scene.table_centre, "size": scene.table_size },
            "platform": { "at": scene.platform, "radius": scene.platform_radius, "height": scene.platform_height },
            "handover": scene.handover,
            "person_rest": scene.person_rest,
            "person_shoulder": scene.person_shoulder,
            "workspaces": { "robot": scene.workspace[0], "person": scene.workspace[1] },
        },
    })
}

/// A form of the robot, in its own frame: boxes and cylinders are centred on it, cylinders stand along z.
fn of_form(form: &Solid) -> Value {
    match form {
        Solid::Box(size) => json!({ "box": [size.x, size.y, size.z] }),
        Solid::Cylinder { radius, height } => {
            json!({ "cylinder": { "radius": radius, "height": height } })
        }
        Solid::Capsule(Capsule { start, end, radius }) => {
            json!({ "capsule": { "from": [start.x, start.y, start.z], "to": [end.x, end.y, end.z], "radius": radius } })
        }
    }
}

fn agent(side: Agent) -> &'static str {
    match side {
        Agent::Robot => "robot",
        Agent::Person => "person",
    }
}

/// What is read from each grip and gesture, once.
fn grasps(task: &Task) -> Vec<Value> {
    let read = |chain: &Chain| match chain.act {
        Act::Grasp { grip, .. } => Some(json!({
            "grip": task.grips[grip].name, "workspace": agent(chain.from), "leads_to": chain.name
        })),
        Act::Gesture(gesture) => Some(
            json!({ "gesture": task.gestures[gesture].name, "workspace": agent(chain.from), "leads_to": chain.name }),
        ),
        _ => None,
    };
    let mut grasps = Vec::new();
    for grasp in task.chains.iter().filter_map(read) {
        if !grasps.contains(&grasp) {
            grasps.push(grasp);
        }
    }
    grasps
}

/// Sentences that are understood: the first phrase of each chain, as the person would say it.
fn phrases(task: &Task) -> Vec<&str> {
    let mut phrases: Vec<&str> =
        task.chains.iter().filter_map(|chain| chain.says.first()).map(String::as_str).collect();
    phrases.sort_unstable();
    phrases.dedup();
    phrases
}

fn of_layer(plan: &NetworkPlan, kind: LayerKind) -> Value {
    let layer = plan.layer(kind);
    let labels: Vec<_> = plan.populations_of(kind).iter().map(|population| &population.label).collect();
    json!({
        "name": kind.name(),
        "title": TITLES[kind as usize],
        "first": layer.populations.start,
        "count": layer.populations.len(),
        "resting": layer.resting,
        "threshold": 0.0,
        "populations": labels,
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn phases_stand_at_their_numbers() {
        MotionPhase::ALL.iter().enumerate().for_each(|(index, phase)| assert_eq!(*phase as usize, index));
    }
}
