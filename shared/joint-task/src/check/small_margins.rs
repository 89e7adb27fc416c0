use super::examined_task::ExaminedTask;
use super::finding::{Finding, FindingKind};
use super::plan_state::PlanState;
use super::steady_state::{Race, SteadyState};
use crate::{Act, Channel};
use coact_messages::{LayerKind, PERSON};
use std::collections::BTreeMap;

/// Largest fraction of the winner's input at which a loser is suppressed cleanly. In simulations of one decision layer,
/// losers with up to 0.83 of it are, and from 0.93 on both peaks stand side by side; between them noise decides.
const CLEAN: f64 = 0.85;
/// Layers that decide something of their own; errors follow from them.
const LAYERS: [LayerKind; 3] =
    [LayerKind::ActionSimulation, LayerKind::Intention, LayerKind::ActionExecution];

/// What the person does in a state of the plan.
#[derive(Debug, Clone, Copy)]
enum PersonActivity {
    Rests,
    Idles,
    /// Shows a chain (index): the hand is on its way.
    Shows(usize),
    /// Carries a part in that chain.
    Carries(usize),
}

/// The worst race of one layer between the same two, and in how many situations it is too close.
struct Worst {
    race: Race,
    situation: String,
    count: usize,
}

/// Decisions in which the loser comes too near, over the states of the plan and what the person may do in each.
pub(super) fn find(examined: &ExaminedTask) -> Vec<Finding> {
    let steady = SteadyState::of(&examined.plan);
    let mut worst: BTreeMap<(usize, usize), Worst> = BTreeMap::new();
    for state in PlanState::all(examined) {
        for person in activities(examined, &state) {
            let inputs = steady.inputs(|channel| percept(examined, &state, person, channel));
            for race in LAYERS.into_iter().filter_map(|layer| steady.race(layer, &inputs)) {
                if race.ratio <= CLEAN {
                    continue;
                }
                let pair = (race.winner.min(race.loser), race.winner.max(race.loser));
                let situation = || format!("{}, {}", state.describe(examined), describe(examined, person));
                let known =
                    worst.entry(pair).or_insert_with(|| Worst { race, situation: situation(), count: 0 });
                known.count += 1;
                if race.ratio > known.race.ratio {
                    (known.race, known.situation) = (race, situation());
                }
            }
        }
    }
    worst.values().map(|worst| finding(examined, worst)).collect()
}

/// What the person may do: rest, or any chain whose part lies there and whose subgoal is open.
fn activities(examined: &ExaminedTask, state: &PlanState) -> Vec<PersonActivity> {
    let mut activities = vec![PersonActivity::Rests, PersonActivity::Idles];
    for (index, chain) in examined.task.chains.iter().enumerate() {
        let possible = state.parts(chain.from.index(), chain.kind) > 0;
        if possible && examined.served(index).any(|goal| state.is_open(examined, goal)) {
            activities.push(PersonActivity::Shows(index));
            if matches!(chain.act, Act::Grasp { .. }) {
                activities.push(PersonActivity::Carries(index));
            }
        }
    }
    activities
}

/// What perception says, full evidence each.
fn percept(examined: &ExaminedTask, state: &PlanState, person: PersonActivity, channel: Channel) -> f64 {
    let task = &examined.task;
    let carried = match person {
        PersonActivity::Carries(chain) => Some(task.chains[chain].kind),
        _ => None,
    };
    let lies = |workspace: usize, kind: usize| {
        let mut state = state.clone();
        if workspace == PERSON && carried == Some(kind) {
            state.take(workspace, kind);
        }
        state.parts(workspace, kind) > 0
    };
    let yes = match channel {
        Channel::Always => true,
        Channel::Act(act) | Channel::Hold { act, .. } => match (task.acts[act], person) {
            (Act::Rest, PersonActivity::Rests | PersonActivity::Idles)
            | (Act::Idle, PersonActivity::Idles) => true,
            (Act::Reach, PersonActivity::Shows(chain)) => matches!(task.chains[chain].act, Act::Grasp { .. }),
            // Where the hand goes for a part, the destination field tells.
            (Act::Grasp { .. }, PersonActivity::Shows(_)) => false,
            (act, PersonActivity::Shows(chain) | PersonActivity::Carries(chain)) => {
                act == task.chains[chain].act
            }
            _ => false,
        },
        Channel::Destination { grip, kind } => match person {
            PersonActivity::Shows(chain) => task.chains[chain].act == Act::Grasp { grip, kind },
            _ => false,
        },
        Channel::BoundFor(kind) => match person {
            PersonActivity::Shows(chain) => {
                task.chains[chain].kind == kind && matches!(task.chains[chain].act, Act::Grasp { .. })
            }
            _ => false,
        },
        Channel::Seen { workspace, kind } => lies(workspace, kind),
        Channel::Gone { workspace, kind } => !lies(workspace, kind),
        Channel::Achieved(goal) => state.is_achieved(goal),
        Channel::Open(goal) => !state.is_achieved(goal),
        Channel::PersonHolds(kind) => carried == Some(kind),
        Channel::RobotHolds(_) | Channel::Lost(_) => false,
    };
    f64::from(u8::from(yes))
}

fn finding(examined: &ExaminedTask, worst: &Worst) -> Finding {
    let Worst { race, situation, count } = worst;
    let [winner, loser] = [race.winner, race.loser].map(|index| &examined.plan.populations[index]);
    let layer = examined.plan.layer_of(race.winner).map_or("a layer", |layer| layer.kind.name());
    let place = match (winner.subgoal, winner.chain_index) {
        (Some(goal), _) => examined.place_of_subgoal(goal),
        (None, Some(chain)) => examined.place_of_chain(chain),
        (None, None) => examined.place(0..0),
    };
    Finding {
        kind: FindingKind::SmallMargin,
        place,
        what: format!(
            "in {layer}, {:?} has {:.0} % of the input of {:?} ({:.2}) {situation}; too much in {count} situations",
            loser.label,
            100.0 * race.ratio,
            winner.label,
            race.input
        ),
        why: "above 85 % noise decides, or two peaks stand side by side".into(),
        advice: "let one subgoal come after the other, give the kinds another side, workspace or grip, or change the \
                 weights in the network file (`coact task show` tells what each population receives)"
            .into(),
    }
}

fn describe(examined: &ExaminedTask, person: PersonActivity) -> String {
    let named = |chain: usize| {
        let chain = &examined.task.chains[chain];
        format!("{}: {}", chain.name, examined.task.kinds[chain.kind].name)
    };
    match person {
        PersonActivity::Rests => "while the person's hand rests".into(),
        PersonActivity::Idles => "while the person idles".into(),
        PersonActivity::Shows(chain) => format!("while the person shows {:?}", named(chain)),
        PersonActivity::Carries(chain) => format!("while the person carries out {:?}", named(chain)),
    }
}
