use super::{Errand, Manner};
use crate::parts::Parts;
use crate::robot_hand::RobotHandMemory;
use coact_joint_task::{Act, Agent, Task};
use coact_messages::PartnerError;
use glam::DVec3;

/// What the person sees: the parts, and the robot's hand from the outside.
#[derive(Clone, Copy)]
pub(crate) struct View<'a> {
    pub tick: u64,
    pub task: &'a Task,
    pub parts: &'a Parts,
    pub robot: &'a RobotHandMemory,
}

/// What the person means to do next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Intention {
    pub errand: Errand,
    pub chain: usize,
    pub subgoal: Option<usize>,
    pub part: Option<usize>,
    pub manner: Manner,
}

/// The outcome of thinking about it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Choice {
    Begin(Intention),
    /// Rest for so many ticks, then think again.
    Rest(u64),
}

/// How long a part must be offered before the person reacts, ticks.
const NOTICED: u64 = 300;

impl View<'_> {
    /// What a chain is for, by what shows it and whose subgoal it serves.
    pub fn errand(&self, chain: usize) -> Errand {
        let chain = &self.task.chains[chain];
        match (chain.act, chain.side) {
            (Act::Gesture(_), _) => Errand::Request,
            (_, Agent::Robot) => Errand::HandOver,
            (_, Agent::Person) => Errand::Mount,
        }
    }

    /// The subgoal that `chain` would serve: one that is available, if there is one.
    pub fn goal(&self, chain: usize) -> Option<usize> {
        self.task.goal_of(chain, |goal| self.parts.is_available(goal, self.task))
    }

    /// What is wrong with an intention as things are now.
    pub fn error_of(&self, intention: &Intention) -> PartnerError {
        let Some(goal) = intention.subgoal else { return PartnerError::None };
        if self.parts.achieved() & (1 << goal) != 0 {
            PartnerError::Done
        } else if !self.parts.is_available(goal, self.task) {
            PartnerError::Early
        } else if intention.errand == Errand::Request
            && self.own_part(self.task.subgoals[goal].kind).is_some()
        {
            PartnerError::AtHand
        } else {
            PartnerError::None
        }
    }

    /// The part that the robot holds out and has held out for long enough to be noticed.
    pub fn offered(&self) -> Option<usize> {
        let since = self.robot.offering_since;
        self.robot.held.get().filter(|_| since > 0 && self.tick >= since + NOTICED)
    }

    /// The person's own available subgoal that needs a part of `kind`.
    pub fn own_need(&self, kind: usize) -> Option<usize> {
        let goals = &self.task.subgoals;
        (0..goals.len()).find(|&goal| {
            let own = goals[goal].kind == kind && goals[goal].side == Agent::Person;
            own && self.parts.is_available(goal, self.task)
        })
    }

    /// The intention to take the offered part and to mount it, if the person needs it now.
    pub fn take_offered(&self) -> Option<Intention> {
        let part = self.offered()?;
        let kind = self.parts.kind(part);
        let subgoal = self.own_need(kind)?;
        let chain = self.task.chains.iter().position(|chain| {
            matches!(chain.act, Act::Grasp { .. }) && chain.kind == kind && chain.side == Agent::Person
        })?;
        let manner = Manner::default();
        Some(Intention { errand: Errand::Take, chain, subgoal: Some(subgoal), part: Some(part), manner })
    }

    /// The part of `kind` that the person would reach for.
    pub fn own_part(&self, kind: usize) -> Option<usize> {
        self.nearest(kind, Agent::Person)
    }

    /// The part of `kind` that lies in `owner`'s workspace, nearest to the person.
    pub fn nearest(&self, kind: usize, owner: Agent) -> Option<usize> {
        self.parts.nearest_free(kind, owner, DVec3::from(self.task.scene.person_rest), self.task)
    }
}
