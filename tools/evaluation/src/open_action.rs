use crate::ErrorKind;
use crate::first_goal::FirstGoal;
use coact_joint_task::{Act, Agent, Chain, NetworkPlan, Population, Role, Task};
use coact_messages::{LayerKind, PartnerError, Truth};

/// The person's present action, as far as it says what should come of it.
#[derive(Debug, Clone)]
pub(crate) struct OpenAction {
    /// Its population of IL: what should be inferred.
    pub goal: Option<usize>,
    /// Its populations of EML: what should be detected.
    pub errors: Vec<usize>,
    /// Its complementary action: index into `Task::actions`.
    pub answer: Option<usize>,
    /// Whether it is a reach for a part on the person's side.
    pub reaches: bool,
    /// The first goal that stood on the way.
    pub first: FirstGoal,
    /// Since when its goal has been the highest peak of IL, after the hand has turned.
    pub stands_since: Option<u64>,
}

/// What the truth says of an action.
#[derive(Debug, Clone)]
pub(crate) struct Meant {
    pub open: OpenAction,
    /// What the person does, e.g. "insert: wheel".
    pub chain: String,
    /// The subgoal that is meant.
    pub subgoal: String,
    /// What is wrong with it.
    pub error: Option<ErrorKind>,
}

/// What the person's present action is for, and what should come of it; none where the truth names no chain or subgoal.
pub(crate) fn meant(task: &Task, plan: &NetworkPlan, truth: &Truth) -> Option<Meant> {
    let (chain, subgoal) = (truth.chain as usize, truth.subgoal as usize);
    let (rule, goal) = (task.chains.get(chain)?, task.subgoals.get(subgoal)?);
    let error = error(truth, matches!(rule.act, Act::Gesture(_)));
    let counts = |meaning: &Population| match error {
        None => false,
        Some(ErrorKind::AtHand) => meaning.role == Role::Means && meaning.kind == Some(rule.kind),
        Some(ErrorKind::Early) => meaning.role == Role::Goal && meaning.subgoal == Some(subgoal),
        Some(ErrorKind::Done) => meaning.role == Role::Done && meaning.subgoal == Some(subgoal),
        Some(ErrorKind::Requested) => {
            [Role::Goal, Role::Done].contains(&meaning.role) && meaning.subgoal == Some(subgoal)
        }
    };
    let row = plan.layer(LayerKind::ErrorMonitoring).populations.clone();
    let errors = row.filter(|&index| counts(&plan.populations[index])).collect();
    let answer = task.complement(chain, subgoal);
    Some(Meant {
        open: OpenAction {
            goal: plan.goal(chain, subgoal),
            errors,
            answer,
            reaches: is_reach(rule),
            first: FirstGoal::default(),
            stands_since: None,
        },
        chain: format!("{}: {}", rule.name, task.kinds[rule.kind].name),
        subgoal: goal.name.clone(),
        error,
    })
}

/// Whether that is a reach for a part on the person's side.
pub(crate) fn is_reach(rule: &Chain) -> bool {
    matches!(rule.act, Act::Grasp { .. }) && rule.from == Agent::Person
}

/// What is wrong with an action that `requests` something, or not.
fn error(truth: &Truth, requests: bool) -> Option<ErrorKind> {
    match truth.error {
        error if error == PartnerError::None as u32 => None,
        error if error == PartnerError::AtHand as u32 => Some(ErrorKind::AtHand),
        _ if requests => Some(ErrorKind::Requested),
        error if error == PartnerError::Done as u32 => Some(ErrorKind::Done),
        _ => Some(ErrorKind::Early),
    }
}
