use coact_joint_task::{ActionType, Task};
use coact_messages::{Command, Decision, MotionPhase, PERSON, ROBOT, Truth};
use serde::Serialize;

/// What the robot decided, and how long it took until that was done.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SkillTime {
    /// The action's name.
    pub action: String,
    /// What kind of action it is.
    pub skill: SkillKind,
    /// When it was decided, ms.
    pub decided_ms: u64,
    /// When it was done, ms: the part in the robot's hand, in the person's, in its place; the hand at the base, or held out.
    pub done_ms: u64,
}

impl SkillTime {
    /// From the decision until it was done, s.
    pub fn seconds(&self) -> f64 {
        self.done_ms.saturating_sub(self.decided_ms) as f64 / 1e3
    }
}

/// The actions whose ends can be told.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum SkillKind {
    /// The person's part is in the robot's hand.
    Receive,
    /// The robot's part is in the person's hand.
    Give,
    /// The part is in its place.
    Insert,
    /// The base is steadied.
    Steady,
    /// The open hand is held out.
    Request,
}

impl SkillKind {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Receive, Self::Give, Self::Insert, Self::Steady, Self::Request];

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Receive => "receive",
            Self::Give => "give",
            Self::Insert => "insert",
            Self::Steady => "steady",
            Self::Request => "request",
        }
    }

    fn of(action: ActionType) -> Option<Self> {
        Some(match action {
            ActionType::Receive => Self::Receive,
            ActionType::Give => Self::Give,
            ActionType::Insert => Self::Insert,
            ActionType::Steady => Self::Steady,
            ActionType::Request => Self::Request,
            ActionType::Point | ActionType::Speak | ActionType::Report => return None,
        })
    }
}

/// Follows decisions until what was decided is done; what another decision replaces is left out.
#[derive(Debug, Clone, Default)]
pub(crate) struct SkillTimes {
    open: Option<Open>,
    /// The action that was done last: its decision may stand on.
    last: Option<u32>,
    done: Vec<SkillTime>,
}

#[derive(Debug, Clone, Copy)]
struct Open {
    action: u32,
    skill: SkillKind,
    decided_ms: u64,
    /// The parts that the robot held when it was decided.
    held: u64,
}

impl SkillTimes {
    /// What is decided, commanded and true in a cycle.
    pub fn tick(&mut self, task: &Task, decision: &Decision, command: &Command, truth: &Truth) {
        if let Some(open) = self.open
            && is_done(&open, task, command, truth)
        {
            let (action, skill) = (task.actions[open.action as usize].name.clone(), open.skill);
            let (decided_ms, done_ms) = (open.decided_ms, truth.header.cycle);
            self.done.push(SkillTime { action, skill, decided_ms, done_ms });
            (self.open, self.last) = (None, Some(open.action));
        }
        let Some(action) = task.actions.get(decision.action as usize) else {
            self.last = None;
            return;
        };
        let is_new = self.open.is_none_or(|open| open.action != decision.action);
        if is_new && self.last != Some(decision.action) {
            let open = |skill| Open {
                action: decision.action,
                skill,
                decided_ms: decision.since,
                held: truth.held[ROBOT],
            };
            (self.open, self.last) = (SkillKind::of(action.action_type).map(open), None);
        }
    }

    /// Those that were done.
    pub fn finish(self) -> Vec<SkillTime> {
        self.done
    }
}

fn is_done(open: &Open, task: &Task, command: &Command, truth: &Truth) -> bool {
    let action = &task.actions[open.action as usize];
    let held_of_kind = |agent: usize| {
        let is_so = |part: &usize| {
            truth.held[agent] & (1 << part) != 0 && Some(task.parts[*part].kind) == action.kind
        };
        (0..task.parts.len()).any(|part| is_so(&part))
    };
    let stands = command.action == open.action && command.phase == MotionPhase::Dwell as u32;
    match open.skill {
        SkillKind::Receive => truth.held[ROBOT] & !open.held != 0 && held_of_kind(ROBOT),
        SkillKind::Give => held_of_kind(PERSON) && truth.held[ROBOT] == 0,
        SkillKind::Insert => action.subgoal.is_some_and(|goal| truth.achieved & (1 << goal) != 0),
        SkillKind::Steady | SkillKind::Request => stands,
    }
}
