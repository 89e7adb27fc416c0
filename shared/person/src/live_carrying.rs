//! How a part moves along with a hand that comes from outside.

use crate::movement_planning::nearest_turn;
use crate::{Person, PersonState, Surroundings};
use coact_period::PERIOD_S;
use glam::{DQuat, DVec3};

/// How fast the fingers turn a part, rad/s. Chosen by hand: a quarter turn in half a second.
const TURNING: f64 = 3.0;
/// How fast a part settles between the fingers, m/s. Chosen by hand.
const SETTLING: f64 = 0.10;
/// A socket this near to a part is what it is turned for, m. Chosen by hand: less than the way from one side to the other.
const NEAR: f64 = 0.15;
/// How far the fingers let a socket guide a part, m: as a chamfer does, for a hand that is tracked from outside feels nothing. Chosen by
/// hand.
const GUIDED: f64 = 0.025;

impl Person {
    /// Where the part is that moves along with fingers whose middle is at `middle`. It turns to the axis of an open socket that is near,
    /// else upright.
    pub(crate) fn carry_along(
        &self,
        part: usize,
        state: &mut PersonState,
        around: &Surroundings,
        middle: DVec3,
    ) -> (usize, DVec3, DQuat) {
        let goal = around.open_socket(part).map(|goal| &around.task.subgoals[goal]);
        let axis = goal.map_or(DVec3::Z, |goal| goal.axis.into());
        let turn = turned(around.parts.orientation(part), axis);
        let half = self.half_height(part, around);
        let guided = goal.map(|goal| DVec3::from(goal.socket) + nearest_turn(turn, axis) * half - middle);
        let wanted = guided.filter(|offset| offset.length() < GUIDED).unwrap_or_default();
        let offset = DVec3::from(state.offset);
        let offset = offset + (wanted - offset).clamp_length_max(SETTLING * PERIOD_S);
        state.offset = offset.into();
        (part, middle + offset - turn * half, turn)
    }
}

impl Surroundings<'_> {
    /// The free socket of the part's kind whose turn has come and that is nearest to it, if one is near.
    pub(crate) fn open_socket(&self, part: usize) -> Option<usize> {
        let (kind, goals) = (self.parts.kind(part), &self.task.subgoals);
        let place = self.parts.position(part);
        let away = |goal: &usize| place.distance(goals[*goal].socket.into());
        let open = |goal: &usize| {
            goals[*goal].kind == kind && away(goal) < NEAR && self.parts.is_available(*goal, self.task)
        };
        (0..goals.len()).filter(open).min_by(|one, other| away(one).total_cmp(&away(other)))
    }
}

/// What `turn` becomes in a tick in which the part turns towards `axis`.
fn turned(turn: DQuat, axis: DVec3) -> DQuat {
    let wanted = nearest_turn(turn, axis);
    let step = TURNING * PERIOD_S / turn.angle_between(wanted).max(1e-9);
    turn.slerp(wanted, step.min(1.0)).normalize()
}
