use crate::{Activity, Intention, PartsView, RobotHandView, Variation};
use coact_joint_task::{Act, Agent, Task};
use coact_messages::PartnerError;
use coact_period::cycles;
use glam::DVec3;
use std::time::Duration;

/// How long a part must be given before the person reacts, cycles. Chosen by hand, of the size of a
/// reaction time.
const NOTICED: u64 = cycles(Duration::from_millis(300));
/// A place so near to what the robot brings has no room for another hand, m. Chosen by hand: two hands' breadths.
const BESIDE: f64 = 0.20;

/// What the person perceives in one tick: the parts, and the robot's hand from the outside.
#[derive(Debug, Clone, Copy)]
pub struct Surroundings<'a> {
    /// Now.
    pub tick: u64,
    /// What both build together.
    pub task: &'a Task,
    /// Every part of the scene.
    pub parts: PartsView<'a>,
    /// The robot's hand.
    pub robot: RobotHandView,
}

impl Surroundings<'_> {
    /// What a chain is for, by the act that shows it and by whose subgoal it serves.
    pub(crate) fn activity(&self, chain: usize) -> Activity {
        let chain = &self.task.chains[chain];
        match (chain.act, chain.side) {
            (Act::Gesture(_), _) => Activity::Request,
            (_, Agent::Robot) => Activity::Give,
            (_, Agent::Person) => Activity::Insert,
        }
    }

    /// The subgoal that `chain` would serve: one that is available, if there is one.
    pub(crate) fn goal(&self, chain: usize) -> Option<usize> {
        self.task.goal_of(chain, |goal| self.parts.is_available(goal, self.task))
    }

    /// The intention to take an own part by `chain` for `subgoal`; none when the chain takes none, or none lies there.
    pub(crate) fn taking(&self, chain: usize, subgoal: Option<usize>) -> Option<Intention> {
        let rule = &self.task.chains[chain];
        let takes = matches!(rule.act, Act::Grasp { .. }) && rule.from == Agent::Person;
        let part = Some(self.own_part(rule.kind).filter(|_| takes)?);
        let (activity, variation) = (self.activity(chain), Variation::default());
        Some(Intention { activity, chain, subgoal, part, variation })
    }

    /// Whether the turn of `goal` comes as soon as the robot has mounted what is in its hand.
    pub(crate) fn is_coming(&self, goal: usize) -> bool {
        let (task, achieved) = (self.task, self.parts.achieved());
        let held = self.robot.held.filter(|_| self.robot.giving_since == 0).map(|part| self.parts.kind(part));
        let mut next = (0..task.subgoals.len()).filter(|&own| {
            let step = &task.subgoals[own];
            Some(step.kind) == held && step.side == Agent::Robot && task.is_available(own, achieved)
        });
        !task.is_available(goal, achieved) && next.any(|own| task.is_available(goal, achieved | (1 << own)))
    }

    /// Whether the robot is at work beside the place of `goal`: the part that it brings is near.
    pub(crate) fn robot_works_beside(&self, goal: usize) -> bool {
        let socket = DVec3::from(self.task.subgoals[goal].socket);
        let brought = self.robot.held.filter(|_| self.robot.giving_since == 0);
        brought.is_some_and(|part| self.parts.position(part).distance(socket) < BESIDE)
    }

    /// What is wrong with an intention as things are now: nothing with one whose turn is coming.
    pub(crate) fn error_of(&self, intention: &Intention) -> PartnerError {
        let Some(goal) = intention.subgoal else { return PartnerError::None };
        if self.parts.achieved() & (1 << goal) != 0 {
            PartnerError::Done
        } else if !self.parts.is_available(goal, self.task) && !self.is_coming(goal) {
            PartnerError::Early
        } else if intention.activity == Activity::Request
            && self.own_part(self.task.subgoals[goal].kind).is_some()
        {
            PartnerError::AtHand
        } else {
            PartnerError::None
        }
    }

    /// The part that the robot has given for long enough to be noticed.
    fn given(&self) -> Option<usize> {
        let since = self.robot.giving_since;
        self.robot.held.filter(|_| since > 0 && self.tick >= since + NOTICED)
    }

    /// The person's own available subgoal that needs a part of `kind`.
    fn own_need(&self, kind: usize) -> Option<usize> {
        let goals = &self.task.subgoals;
        (0..goals.len()).find(|&goal| {
            let own = goals[goal].kind == kind && goals[goal].side == Agent::Person;
            own && self.parts.is_available(goal, self.task)
        })
    }

    /// The intention to receive the part that the robot gives and to mount it, if the person needs it now.
    pub(crate) fn receive(&self) -> Option<Intention> {
        let part = self.given()?;
        let kind = self.parts.kind(part);
        let subgoal = self.own_need(kind)?;
        let chain = self.mounting_chain(kind)?;
        let variation = Variation::default();
        Some(Intention {
            activity: Activity::Receive,
            chain,
            subgoal: Some(subgoal),
            part: Some(part),
            variation,
        })
    }

    /// The chain by which the person takes a part of `kind` to mount it.
    pub(crate) fn mounting_chain(&self, kind: usize) -> Option<usize> {
        self.task.chains.iter().position(|chain| {
            matches!(chain.act, Act::Grasp { .. }) && chain.kind == kind && chain.side == Agent::Person
        })
    }

    /// The part of `kind` that the person would reach for.
    pub(crate) fn own_part(&self, kind: usize) -> Option<usize> {
        self.nearest(kind, Agent::Person)
    }

    /// The part of `kind` that lies in `owner`'s workspace, nearest to the person.
    pub(crate) fn nearest(&self, kind: usize, owner: Agent) -> Option<usize> {
        self.parts.nearest_free(kind, owner, DVec3::from(self.task.scene.person_rest), self.task)
    }
}
