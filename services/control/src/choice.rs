use crate::errand::Errand;
use crate::senses::Senses;
use crate::{Memory, Settings, memory};
use coact_joint_task::{Action, ActionType};
use coact_messages::{Decision, NONE, ROBOT};
use nalgebra::{Isometry3, Point3};

/// What the robot shall be about now.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Choice {
    pub errand: Errand,
    /// Action that it serves, or [`NONE`].
    pub action: u64,
    /// Kind of part that it is about, or [`NONE`].
    pub kind: u64,
}

impl Choice {
    const PARK: Self = Self { errand: Errand::Park, action: NONE as u64, kind: NONE as u64 };

    /// From the decision and what is in the hand. A decision that was carried out is not carried out again.
    ///
    /// A held part that the decision does not concern stays in the hand, as long as the hand is not needed: then it
    /// is put back first. It is put back, too, when nothing has been decided for long.
    pub fn of(memory: &Memory, senses: &Senses, actions: &[Action], settings: &Settings) -> Self {
        let decision = senses.decision().filter(|decision| !is_finished(memory, decision));
        let action =
            decision.and_then(|decision| Some((decision.action, actions.get(decision.action as usize)?)));
        let Some((index, action)) = action
            .filter(|(_, action)| !matches!(action.action_type, ActionType::Speak | ActionType::Report))
        else {
            return match memory.held() {
                Some(held) if memory.undecided > settings.put_back_after => Self::put_back(held),
                _ => Self::PARK,
            };
        };
        let held = memory.held();
        let errand = match (action.action_type, action.kind) {
            (ActionType::Steady, _) => Errand::Steady,
            (ActionType::Point, Some(_)) => Errand::Point,
            (ActionType::Insert, Some(kind)) if held == Some(kind) => Errand::Place,
            (ActionType::Give, Some(kind)) if held == Some(kind) => Errand::Offer,
            (ActionType::Receive, kind) if held.is_some() && held == kind => Errand::Park,
            (ActionType::Speak | ActionType::Report, _) | (_, None) => Errand::Park,
            _ if held.is_some() => return held.map_or(Self::PARK, Self::put_back),
            (ActionType::Insert | ActionType::Give, Some(_)) => Errand::Take,
            (ActionType::Request, _) => Errand::Ask,
            (ActionType::Receive, Some(_)) => Errand::Receive,
        };
        let kind = action.kind.map_or(u64::from(NONE), |kind| kind as u64);
        Self { errand, action: index.into(), kind }
    }

    fn put_back(held: usize) -> Self {
        Self { errand: Errand::PutBack, kind: held as u64, ..Self::PARK }
    }

    /// Whether this is what the robot is about already.
    pub fn is_under_way(&self, memory: &Memory) -> bool {
        memory.errand() == self.errand
            && (self.errand == Errand::Park || (memory.action == self.action && memory.kind == self.kind))
    }
}

/// Counts for how long nothing was decided, and forgets after a while what failed, or was done in vain: then the decision
/// counts again.
pub(crate) fn age(memory: &mut Memory, senses: &Senses, actions: &[Action], settings: &Settings) {
    let decided = senses.decision().is_some_and(|decision| (decision.action as usize) < actions.len());
    memory.undecided =
        if decided || memory.held().is_none() { 0 } else { memory.undecided.saturating_add(1) };
    memory.silent = if decided { 0 } else { memory.silent.saturating_add(1) };
    memory.finished_age = memory.finished_age.saturating_add(1);
    let action = actions.get(memory.finished as usize);
    let undone = action.and_then(|action| action.subgoal).is_some_and(|subgoal| senses.open(subgoal));
    let in_vain = action.is_some_and(|action| match action.action_type {
        ActionType::Insert => true,
        ActionType::Give => !action.kind.is_some_and(|kind| senses.in_person_hand(kind)),
        _ => false,
    });
    if memory.finished_age > settings.retry_after && (memory.failed == 1 || (in_vain && undone)) {
        memory.finished = NONE.into();
        memory.misses = 0;
    }
}

/// Notices a part in the hand that memory does not know of, as it is seen there, and one that was lost. `hand` tells
/// where the palm and the grasp point are.
pub(crate) fn feel(memory: &mut Memory, senses: &Senses, hand: impl Fn() -> (Isometry3<f64>, Point3<f64>)) {
    /// Cycles for which the touch must say so.
    const CERTAIN: u64 = 100;
    /// A part that is in the hand is seen this near to the grasp point, m.
    const IN_HAND: f64 = 0.15;
    if memory.leg().is_firm() {
        return;
    }
    let found = senses.in_robot_hand().filter(|_| memory.held().is_none());
    let lost = memory.held().is_some() && senses.touch() == Some(false);
    let changed = lost || found.is_some();
    memory.touched = if changed { memory.touched + 1 } else { 0 };
    if memory.touched > CERTAIN {
        memory.touched = 0;
        memory.taken = 0;
        memory.held = NONE.into();
        let (palm, grasp_point) = hand();
        let seen = |kind: usize| {
            let (_, frame) = senses.sighting(kind, &grasp_point, IN_HAND)?;
            Some((kind, palm.inverse() * frame))
        };
        if let Some((kind, in_palm)) = found.and_then(seen) {
            (memory.held, memory.in_palm) = (kind as u64, memory::words(&in_palm));
        }
    }
}

/// Whether the part that this errand needs from the robot's workspace lies there.
pub(crate) fn can_begin(choice: &Choice, senses: &Senses) -> bool {
    choice.errand != Errand::Take || senses.part(ROBOT, choice.kind as usize).is_some()
}

fn is_finished(memory: &Memory, decision: &Decision) -> bool {
    memory.finished == u64::from(decision.action) && memory.finished_since == decision.since
}
