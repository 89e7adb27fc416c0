use coact_joint_task::{ActionType, Task};
use coact_messages::{Command, MotionPhase, PartnerPhase, Truth};

/// Who is active at one tick, and who can do nothing but wait for the other.
///
/// The person is active while the hand moves or works; not at rest, and not while it can only wait for the robot: at
/// the socket until the base is steadied, while it holds out a part or the open hand, and while its fingers are on a part
/// that the robot has not let go. The robot is active while its arm or its hand moves, and while it steadies the base that
/// the person mounts something on; not at rest, and not while it holds out a part or its open hand, or is at the base
/// before the person.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ActiveAgents {
    /// By [`coact_joint_task::Agent::index`].
    pub active: [bool; 2],
    /// In the middle of an action, and can go on only after the other has done something; by the same index.
    pub waits: [bool; 2],
}

impl ActiveAgents {
    /// Who is, by the truth and by what the arm is commanded.
    pub fn now(task: &Task, truth: &Truth, command: &Command) -> Self {
        let acts = truth.phase != PartnerPhase::Idle as u32;
        let person_waits = truth.person_wait().is_within_action();
        let mounts = truth.phase == PartnerPhase::Act as u32 && !person_waits;
        let action = task.actions.get(command.action as usize).map(|action| action.action_type);
        let dwells = command.phase == MotionPhase::Dwell as u32;
        let robot_waits = dwells && !(action == Some(ActionType::Steady) && mounts);
        let stands = command.phase == MotionPhase::Rest as u32 || command.phase == MotionPhase::Brake as u32;
        Self { active: [!stands && !robot_waits, acts && !person_waits], waits: [robot_waits, person_waits] }
    }
}
