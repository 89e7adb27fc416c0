//! A change of mind in mid-reach: the hand turns to another part.

use crate::person::error;
use crate::reach_profile::minimum_jerk;
use crate::{
    Activity, HandMovement, HandPose, Intention, Person, PersonState, ReachTurn, Surroundings, Variation,
    random_policy, synthetic_policy,
};
use coact_messages::PartnerError;
use coact_period::cycles;
use coact_random::Stream;
use coact_stage_state::{Flag, Slot};
use rand::{Rng, RngExt};
use std::ops::RangeInclusive;
use std::time::Duration;

/// Fraction of the first movement's way that the hand has covered when it turns. Chosen by hand: before, the reach has hardly been
/// seen; after, the hand could as well grasp first. What a reach is for is mostly inferred after some 80 % of its way.
const TURNS_AT: RangeInclusive<f64> = 0.25..=0.90;
/// For how long the hand must move in a direction that counts, cycles: three frames of a recording, whose wrist jitters.
const LASTS: u64 = cycles(Duration::from_millis(50));

impl Person {
    /// Changes the mind about the present reach, if that is to be and has come to be due. Nothing that the robot does or has
    /// decided plays a part in it.
    pub(crate) fn change_mind(&self, state: &mut PersonState, around: &Surroundings) {
        let changes = self.policy.behaviour().map_or(0.0, |behaviour| behaviour.changes);
        if changes <= 0.0 || !is_plain(state) {
            return;
        }
        let mut rng = self.random.at(Stream::ChangeOfMind, state.movement.start);
        let (turns, from) = (rng.random_bool(changes), rng.random_range(TURNS_AT));
        let covered = self.covered(state, around.tick);
        if !turns || covered < from || covered > *TURNS_AT.end() {
            return;
        }
        let mut rng = self.random.at(Stream::ChangeOfMind, around.tick);
        if let Some(other) = another(state, around, &mut rng) {
            self.turn_to(other, state, around);
        }
    }

    /// Fraction of the way that the hand has covered in a movement that has neither turned nor stood.
    pub(crate) fn covered(&self, state: &PersonState, tick: u64) -> f64 {
        let now = tick as f64;
        match self.recording(state) {
            None => minimum_jerk(state.movement.time(now)),
            Some(reach) => reach.at(state.movement.since_onset(now)).progress,
        }
    }

    /// Begins the movement that corrects the present one: from the place where that one goes on to end, to the new part.
    ///
    /// People whose target jumps while they reach for it do not break the movement off. They go on with it unmodified, and add a
    /// second one, from the first target to the second, each of minimum jerk (Flash and Henis 1991, J. Cogn. Neurosci. 3(3);
    /// Henis and Flash 1995, Biol. Cybern. 72(5)). So position, velocity and acceleration have no step, and the sum ends at the
    /// second target. The correction lasts for one movement time from its very beginning, and not shorter than the first movement
    /// goes on: people whose target jumped by 10 degrees at the onset corrected that within 66 to 80 ms more than the reach
    /// took, the reaction of some 150 ms included (Prablanc and Martin 1992, J. Neurophysiol. 67(2)).
    fn turn_to(&self, other: Intention, state: &mut PersonState, around: &Surroundings) {
        let (first, recording) = (state.movement, state.recording);
        self.mean(other, state, around);
        let reach = self.reach_movement(state, around);
        state.movement = HandMovement {
            from: first.to,
            start: around.tick,
            onset: around.tick,
            end: first.end.max(around.tick + (reach.end - reach.onset)),
            arch: 0.0,
            ..reach
        };
        state.turn = ReachTurn { begun: around.tick.max(1), headed: 0, first, recording };
        state.until = state.movement.end;
        state.error = error(state, around);
    }

    /// The hand of a reach at `tick`, where one movement or two drive it.
    pub(crate) fn reaching_pose(&self, state: &PersonState, tick: u64) -> HandPose {
        let now = state.hesitation.time(tick);
        let recorded = |recording: Slot, movement: &HandMovement| match self.recording_at(recording) {
            None => movement.pose_at(now),
            Some(reach) => self.recorded_pose(reach, self.arm(state), movement, now),
        };
        match state.turn.first() {
            None => recorded(state.recording, &state.movement),
            Some(first) => {
                let goes_on = !first.is_over(tick);
                let going = if goes_on { recorded(state.turn.recording, first) } else { first.to };
                let (second, from) = (state.movement.pose(tick), state.movement.from);
                going.moved_by(&from, &second)
            }
        }
    }

    /// Sees whether the hand, which was `before`, moves in the direction of the new part by now: its angle with that is smaller than with
    /// the direction of the old one.
    pub(crate) fn see_heading(&self, state: &mut PersonState, before: &HandPose, tick: u64) {
        let headed = state.turn.headed;
        let Some(first) = state.turn.first().filter(|_| headed == 0 || tick < headed + LASTS) else { return };
        let (from, now) = (self.arm(state).centre(before), self.arm(state).centre(&state.hand));
        let towards =
            |end: &HandPose| (self.arm(state).centre(end) - from).normalize_or_zero().dot(now - from);
        state.turn.headed = match towards(&state.movement.to) > towards(&first.to) {
            true if headed == 0 => tick,
            true => headed,
            false => 0,
        };
    }
}

/// Whether this is a reach about which the person may change the mind, or hesitate: it is right, in full view and in silence, goes to a part
/// that lies there, and has neither turned nor stood yet.
pub(crate) fn is_plain(state: &PersonState) -> bool {
    let own = matches!(state.activity(), Activity::Insert | Activity::Give) && state.part.get().is_some();
    let plain = Variation { left: Flag::Unset, ..state.variation } == Variation::default()
        && state.error == PartnerError::None;
    own && plain && state.turn.begun == 0 && state.hesitation.begun == 0
}

/// What the person means to take instead: something else that is valid now, or another part that lies there, if there is no such
/// thing.
fn another<R: Rng>(state: &PersonState, around: &Surroundings, rng: &mut R) -> Option<Intention> {
    let differs = |other: &Intention| other.part.is_some() && other.part != state.part.get();
    synthetic_policy::draw(around, rng, differs).or_else(|| random_policy::wrong_taking(around, rng, differs))
}
