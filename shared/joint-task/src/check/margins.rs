use super::finding::{Finding, FindingKind};
use super::plan_state::PlanState;
use super::steady::{Race, Steady};
use super::subject::Subject;
use crate::{Act, Channel};
use coact_messages::{LayerKind, PERSON};
use std::collections::BTreeMap;

/// A loser with more than this share of the winner's input may win, or stand beside it: fields with noise decide
/// cleanly below it.
const CLEAN: f64 = 0.85;
/// Layers that decide something of their own; errors follow from them.
const LAYERS: [LayerKind; 3] =
    [LayerKind::ActionSimulation, LayerKind::Intention, LayerKind::ActionExecution];

/// What the person does in a state of the plan.
#[derive(Debug, Clone, Copy)]
enum Person {
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
pub(super) fn small(subject: &Subject) -> Vec<Finding> {
    let steady = Steady::of(&subject.plan);
    let mut worst: BTreeMap<(usize, usize), Worst> = BTreeMap::new();
    for state in PlanState::all(subject) {
        for person in deeds(subject, &state) {
            let inputs = steady.inputs(|channel| percept(subject, &state, person, channel));
            for race in LAYERS.into_iter().filter_map(|layer| steady.race(layer, &inputs)) {
                if race.ratio <= CLEAN {
                    continue;
                }
                let pair = (race.winner.min(race.loser), race.winner.max(race.loser));
                let situation = || format!("{}, {}", state.describe(subject), describe(subject, person));
                let known =
                    worst.entry(pair).or_insert_with(|| Worst { race, situation: situation(), count: 0 });
                known.count += 1;
                if race.ratio > known.race.ratio {
                    (known.race, known.situation) = (race, situation());
                }
            }
        }
    }
    worst.values().map(|worst| finding(subject, worst)).collect()
}

/// What the person may do: rest, or any chain whose part lies there and whose subgoal is open.
fn deeds(subject: &Subject, state: &PlanState) -> Vec<Person> {
    let mut deeds = vec![Person::Rests, Person::Idles];
    for (index, chain) in subject.task.chains.iter().enumerate() {
        let possible = state.parts(chain.from.index(), chain.kind) > 0;
        if possible && subject.served(index).any(|goal| state.is_open(subject, goal)) {
            deeds.push(Person::Shows(index));
            if matches!(chain.act, Act::Grasp { .. }) {
                deeds.push(Person::Carries(index));
            }
        }
    }
    deeds
}

/// What perception says, full evidence each.
fn percept(subject: &Subject, state: &PlanState, person: Person, channel: Channel) -> f64 {
    let task = &subject.task;
    let carried = match person {
        Person::Carries(chain) => Some(task.chains[chain].kind),
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
        Channel::Act(act) => match (task.acts[act], person) {
            (Act::Rest, Person::Rests | Person::Idles) | (Act::Idle, Person::Idles) => true,
            (Act::Reach, Person::Shows(chain)) => matches!(task.chains[chain].act, Act::Grasp { .. }),
            (act, Person::Shows(chain) | Person::Carries(chain)) => act == task.chains[chain].act,
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

fn finding(subject: &Subject, worst: &Worst) -> Finding {
    let Worst { race, situation, count } = worst;
    let [winner, loser] = [race.winner, race.loser].map(|index| &subject.plan.populations[index]);
    let layer = subject.plan.layers.iter().find(|layer| layer.populations.contains(&race.winner));
    let layer = layer.map_or("a layer", |layer| layer.kind.name());
    let place = match (winner.subgoal, winner.chain_index) {
        (Some(goal), _) => subject.place_of_subgoal(goal),
        (None, Some(chain)) => subject.place_of_chain(chain),
        (None, None) => subject.place(0..0),
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

fn describe(subject: &Subject, person: Person) -> String {
    let named = |chain: usize| {
        let chain = &subject.task.chains[chain];
        format!("{}: {}", chain.name, subject.task.kinds[chain.kind].name)
    };
    match person {
        Person::Rests => "while the person's hand rests".into(),
        Person::Idles => "while the person idles".into(),
        Person::Shows(chain) => format!("while the person shows {:?}", named(chain)),
        Person::Carries(chain) => format!("while the person carries out {:?}", named(chain)),
    }
}
