//! What a hand that comes from outside does, in the words of the task: found from what it did, for nobody says what it means.

use crate::{Activity, Holder, Intention, Surroundings, Variation};
use coact_joint_task::{Act, Agent};
use coact_messages::PartnerError;
use glam::DVec3;

impl Surroundings<'_> {
    /// What it means that fingers have closed on a part, the hand at this pitch (rad): by the kind of part, by where it was and by whose
    /// step has come; where that leaves several chains, by the grip that the hand's pitch is nearest to. None: the task has no such chain.
    pub(crate) fn meaning_of_grasp(&self, part: usize, pitch: f64) -> Option<Intention> {
        let of_robot = self.parts.is(part, Holder::Robot);
        let fits = |chain: &usize| {
            let own = &self.task.chains[*chain];
            let place = if of_robot { own.side == Agent::Person } else { self.lies_with(own.from, part) };
            matches!(own.act, Act::Grasp { .. }) && own.kind == self.parts.kind(part) && place
        };
        let turned = |chain: &usize| match self.task.chains[*chain].act {
            Act::Grasp { grip, .. } => (self.task.grips[grip].pitch - pitch).abs(),
            _ => f64::INFINITY,
        };
        let activity = |chain: usize| if of_robot { Activity::Receive } else { self.activity(chain) };
        let meant = (0..self.task.chains.len()).filter(fits).min_by(|one, other| {
            let turn = |chain: &usize| (!self.has_come(*chain), turned(chain));
            turn(one).partial_cmp(&turn(other)).unwrap_or(std::cmp::Ordering::Equal)
        });
        meant.map(|chain| self.intention(chain, activity(chain), Some(part)))
    }

    /// What it means that the empty hand is held out, at this pitch (rad): the request that makes sense now; a gesture names no part.
    /// Where none makes sense, one that the robot could fulfil. None: the task has no such gesture.
    pub(crate) fn meaning_of_gesture(&self, pitch: f64) -> Option<Intention> {
        let near = |gesture: usize| (self.task.gestures[gesture].pitch - pitch).abs();
        let gesture = (0..self.task.gestures.len())
            .filter(|gesture| near(*gesture) < GESTURE_PITCH)
            .min_by(|one, other| near(*one).total_cmp(&near(*other)))?;
        let shows = |chain: &usize| {
            let own = &self.task.chains[*chain];
            own.act == Act::Gesture(gesture) && self.nearest(own.kind, own.from).is_some()
        };
        let requests = (0..self.task.chains.len()).filter(shows);
        let requests = requests.map(|chain| self.intention(chain, Activity::Request, None));
        requests.min_by_key(|request| match self.error_of(request) {
            PartnerError::None => 0,
            PartnerError::AtHand => 1,
            PartnerError::Early => 2,
            PartnerError::Done => 3,
        })
    }

    /// What it means that a finger points from its tip (m) along this unit vector: the request for the robot's part that is nearest to that
    /// line. None: no part is near it, or the task has no such request.
    pub(crate) fn meaning_of_pointing(&self, (tip, along): (DVec3, DVec3)) -> Option<Intention> {
        let chain_for = |part: &usize| {
            let is_for = |chain: &usize| {
                let own = &self.task.chains[*chain];
                let has = own.from == Agent::Robot && self.parts.is(*part, Holder::Robot);
                let lies = self.parts.is(*part, Holder::Nobody) && self.lies_with(own.from, *part);
                own.pointing && own.kind == self.parts.kind(*part) && (has || lies)
            };
            (0..self.task.chains.len()).find(is_for)
        };
        let miss = |part: usize| (self.parts.centre(part, self.task) - tip).angle_between(along);
        let asked = (0..self.task.parts.len()).filter_map(|part| Some((part, chain_for(&part)?, miss(part))));
        let (part, chain, _) =
            asked.filter(|(_, _, miss)| *miss < POINTED_AT).min_by(|one, other| one.2.total_cmp(&other.2))?;
        Some(self.intention(chain, Activity::Request, Some(part)))
    }

    fn intention(&self, chain: usize, activity: Activity, part: Option<usize>) -> Intention {
        Intention { activity, chain, subgoal: self.goal(chain), part, variation: Variation::default() }
    }

    /// Whether the turn of a step that `chain` serves has come.
    fn has_come(&self, chain: usize) -> bool {
        self.goal(chain).is_some_and(|goal| {
            let serves = self.task.subgoals[goal].side == self.task.chains[chain].side;
            serves && self.parts.is_available(goal, self.task)
        })
    }

    /// Whether a part lies in the workspace of `owner`.
    fn lies_with(&self, owner: Agent, part: usize) -> bool {
        let ([low, high], at) = (self.task.scene.workspace[owner.index()], self.parts.position(part));
        (0..2).all(|axis| at[axis] >= low[axis] && at[axis] <= high[axis])
    }
}

/// How far from a finger's line something may be that it points at, rad: 12 degrees. Chosen by hand.
const POINTED_AT: f64 = 0.21;
/// How far the hand's pitch may be from that of a gesture, rad: 30 degrees. Chosen by hand.
const GESTURE_PITCH: f64 = 0.52;
