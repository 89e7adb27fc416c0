use coact_joint_task::{ActionType, Task};
use coact_messages::{Command, MotionPhase, PartnerPhase, Truth};

/// Who is active at one tick.
///
/// The person is active while the hand moves or works; not at rest, and not while it can only wait for the robot: at
/// the socket until the base is steadied, while it holds out a part or the open hand, and while its fingers are on a part
/// that the robot has not let go. The robot is active while its arm or its hand moves, and while it steadies the base that
/// the person mounts something on; not at rest, and not while it holds out a part or its open hand, or is at the base
/// before the person.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ActiveAgents {
    /// By [`coact_joint_task::Agent::index`].
    pub active: [bool; 2],
    pub person_waits: bool,
}

impl ActiveAgents {
    pub fn now(task: &Task, truth: &Truth, command: &Command) -> Self {
        let acts = truth.phase != PartnerPhase::Idle as u32;
        let person_waits = truth.waiting != 0;
        let mounts = truth.phase == PartnerPhase::Act as u32 && !person_waits;
        let action = task.actions.get(command.action as usize).map(|action| action.action_type);
        let robot = match command.phase {
            phase if phase == MotionPhase::Rest as u32 || phase == MotionPhase::Brake as u32 => false,
            phase if phase == MotionPhase::Dwell as u32 => action == Some(ActionType::Steady) && mounts,
            _ => true,
        };
        Self { active: [robot, acts && !person_waits], person_waits }
    }
}
