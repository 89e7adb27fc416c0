use crate::{
    Act, Action, ActionType, Chain, Choice, Gesture, Kind, Part, PersonGrip, Scene, Subgoal, TaskError,
};
use std::path::Path;

/// A joint task as its file describes it: parts, plan, what the person's hand can show, what the robot can do.
///
/// All references between the lists are indices, checked when the file is loaded. The index of an act, kind,
/// subgoal, chain or action in these lists is its index in every message.
#[derive(Debug, Clone, PartialEq)]
pub struct Task {
    /// The task's name.
    pub name: String,
    /// Kinds of part.
    pub kinds: Vec<Kind>,
    /// Single parts, and where they lie at the start.
    pub parts: Vec<Part>,
    /// The plan: subgoals in partial order.
    pub subgoals: Vec<Subgoal>,
    /// The plan's alternatives.
    pub choices: Vec<Choice>,
    /// Grips that tell what is meant.
    pub grips: Vec<PersonGrip>,
    /// Gestures of the empty hand.
    pub gestures: Vec<Gesture>,
    /// What perception can observe of the person: one population of the action observation layer each.
    pub acts: Vec<Act>,
    /// Action chains of the person, one for each rule and kind of part: one population of ASL each.
    pub chains: Vec<Chain>,
    /// The robot's actions: one population of AEL each.
    pub actions: Vec<Action>,
    /// The table, the base and the places on it.
    pub scene: Scene,
    /// Hash of the task's and the network's file contents: two frames with the same fingerprint fit each other.
    pub fingerprint: u64,
}

impl Task {
    /// Reads a task file; see `rt-config/tasks/toy-vehicle.toml` for what stands in one.
    ///
    /// # Errors
    /// A [`TaskError`] that names file, line, key and what was expected.
    pub fn load(path: &Path) -> Result<Self, TaskError> {
        crate::NetworkPlan::load(path).map(|(task, _)| task)
    }

    /// Whether all that the plan puts before `subgoal` is achieved, and every choice made; bit i of `achieved` is set when subgoal i is
    /// achieved, here and below.
    pub fn is_prepared(&self, subgoal: usize, achieved: u64) -> bool {
        let Subgoal { after, after_choices, .. } = &self.subgoals[subgoal];
        after.iter().all(|&before| is_set(achieved, before))
            && after_choices.iter().all(|&choice| self.choices[choice].is_made(achieved))
    }

    /// Whether the turn of `subgoal` has come: it is prepared, and neither achieved nor spared.
    pub fn is_available(&self, subgoal: usize, achieved: u64) -> bool {
        !is_set(achieved, subgoal)
            && self.is_prepared(subgoal, achieved)
            && !self.is_spared(subgoal, achieved)
    }

    /// How many parts of `kind` there are; none where the task lists no parts of it.
    pub fn count(&self, kind: usize) -> Option<usize> {
        let count = self.parts.iter().filter(|part| part.kind == kind).count();
        (count > 0).then_some(count)
    }

    /// Whether nobody needs `subgoal` any more: it is not achieved, and another one was chosen.
    pub fn is_spared(&self, subgoal: usize, achieved: u64) -> bool {
        let spares = |choice: &Choice| choice.spares.contains(&subgoal) && choice.is_made(achieved);
        !is_set(achieved, subgoal) && self.choices.iter().any(spares)
    }

    /// How many subgoals the plan asks for: all but those that choices have spared.
    pub fn needed(&self, achieved: u64) -> usize {
        (0..self.subgoals.len()).filter(|&subgoal| !self.is_spared(subgoal, achieved)).count()
    }

    /// Whether the plan is carried out.
    pub fn is_complete(&self, achieved: u64) -> bool {
        (0..self.subgoals.len()).all(|subgoal| is_set(achieved, subgoal) || self.is_spared(subgoal, achieved))
    }

    /// The observable act at `index`, in words.
    pub fn act_name(&self, index: usize) -> String {
        match self.acts[index] {
            Act::Rest => "rest".into(),
            Act::Idle => "idle".into(),
            Act::Reach => "reach".into(),
            Act::Hidden => "reach out of sight".into(),
            Act::Word(chain) => format!("says: {}", self.chain_name(chain)),
            Act::Point(chain) => format!("points: {}", self.chain_name(chain)),
            Act::Gesture(gesture) => self.gestures[gesture].name.clone(),
            Act::Grasp { grip, kind } => format!("{} grip: {}", self.grips[grip].name, self.kinds[kind].name),
        }
    }

    /// A chain and its kind of part, in words.
    fn chain_name(&self, chain: usize) -> String {
        let Chain { ref name, kind, .. } = self.chains[chain];
        format!("{name}: {}", self.kinds[kind].name)
    }

    /// The subgoal that `chain` serves: of its kind and side; if its kind is needed on the other side only, that one.
    ///
    /// Several subgoals of one kind and side are told apart by `open`, which says whether a subgoal may be meant.
    pub fn goal_of(&self, chain: usize, open: impl Fn(usize) -> bool) -> Option<usize> {
        let Chain { kind, side, .. } = self.chains[chain];
        let meant = |index: &usize| self.subgoals[*index].kind == kind && self.subgoals[*index].side == side;
        let mut own = (0..self.subgoals.len()).filter(meant);
        own.clone()
            .find(|&index| open(index))
            .or_else(|| own.next())
            .or_else(|| (0..self.subgoals.len()).find(|&index| self.subgoals[index].kind == kind))
    }

    /// The robot's action that complements `chain` when it serves `subgoal`; none where the task names none.
    pub fn complement(&self, chain: usize, subgoal: usize) -> Option<usize> {
        let answer = self.chains[chain].answer.as_ref()?;
        self.actions.iter().position(|action| {
            let wanted = action.action_type != ActionType::Steady || self.subgoals[subgoal].steadied;
            action.rule == *answer && wanted && action.subgoal.is_none_or(|own| own == subgoal)
        })
    }
}

fn is_set(mask: u64, bit: usize) -> bool {
    mask & (1 << bit) != 0
}
