//! A recorded person's hand in place of the model's: while a recorded reach drives it.

use crate::reach_profile::minimum_jerk;
use crate::recorded_reach::{LEAD, RecordedFrame, RecordedReach};
use crate::{ActivityPhase, HandModel, HandMovement, HandPose, Person, PersonState};
use coact_messages::{Keypoint, KeypointName};
use coact_period::{PERIOD_S, cycles, seconds};
use coact_stage_state::Slot;
use glam::{DVec2, DVec3};
use std::time::Duration;

/// How long after the grasp it leaves it again, cycles: half of the time in which it takes the hand over.
const TRAIL: u64 = cycles(Duration::from_millis(150));

impl Person {
    /// The recording that drives the hand now.
    pub(crate) fn recording(&self, state: &PersonState) -> Option<&RecordedReach> {
        self.recording_at(state.recording)
    }

    /// The recording with this index, if there is one.
    pub(crate) fn recording_at(&self, index: Slot) -> Option<&RecordedReach> {
        let recorded = self.recorded.as_ref()?;
        index.get().and_then(|index| recorded.reaches.get(index))
    }

    /// The hand that makes a movement as `reach` was made.
    pub(crate) fn recorded_pose(
        &self,
        reach: &RecordedReach,
        arm: &HandModel,
        movement: &HandMovement,
        now: f64,
    ) -> HandPose {
        let frame = reach.at(movement.since_onset(now));
        let mut pose = movement.pose_at(now);
        let (from, to) = (movement.from.wrist(), movement.to.wrist());
        let along = frame.progress.clamp(0.0, 1.0);
        let arch = movement.arch * 16.0 * along * along * (1.0 - along) * (1.0 - along);
        let detour = frame.detour * from.distance(to) * arm.thumb_side(&pose);
        pose.wrist = (from + frame.progress * (to - from) + detour + arch * DVec3::Z).into();
        pose
    }

    /// What a tracker of the recorded person would report at `tick`; `None` when the model alone shapes the hand.
    pub fn recorded_keypoints(&self, state: &PersonState, tick: u64) -> Option<[Keypoint; 9]> {
        let (frame, fraction) = self.recorded_frame(state, tick)?;
        let places = self.shaped(state, &frame.reported, fraction);
        Some(std::array::from_fn(|joint| match frame.confidence[joint] {
            confidence if confidence > 0.0 => Keypoint { position: places[joint].into(), confidence },
            _ => Keypoint::default(),
        }))
    }

    /// Where the recorded person's joints are at `tick`, seen or not: those that the recording has lost are between where it saw them last and
    /// where it sees them next, against the wrist. `None` when the model alone shapes the hand.
    pub fn recorded_joints(&self, state: &PersonState, tick: u64) -> Option<[DVec3; 9]> {
        let (frame, fraction) = self.recorded_frame(state, tick)?;
        Some(self.shaped(state, &frame.shape, fraction))
    }

    /// What the recording has of the hand at `tick`, and how much of its shape is the recorded one's.
    fn recorded_frame(&self, state: &PersonState, tick: u64) -> Option<(RecordedFrame, f64)> {
        let reach = self.recording(state)?;
        let begins = state.movement.onset;
        let turned = state.turn.begun > 0;
        let (onset, fraction) = match state.phase() {
            ActivityPhase::Prepare => (begins, 1.0 - begins.saturating_sub(tick) as f64 / LEAD as f64),
            ActivityPhase::Reach => (begins, 1.0),
            _ if turned => (state.grasped.saturating_sub(reach.movement_time), trail(state, tick)),
            _ => (state.onset + state.hesitation.delay(), trail(state, tick)),
        };
        if fraction <= 0.0 {
            return None;
        }
        let frame = match state.phase() {
            ActivityPhase::Reach if turned => self.turning_frame(state, tick)?,
            _ => reach.at((state.hesitation.time(tick) - onset as f64) * PERIOD_S),
        };
        Some((frame, fraction))
    }

    /// What the recordings of both movements of a reach that has turned show at `tick`. The fingers go over from the first one's shape to the
    /// second one's as the hand does; that is as far from its grasp as the hand is.
    fn turning_frame(&self, state: &PersonState, tick: u64) -> Option<RecordedFrame> {
        let (first, second) = (self.recording_at(state.turn.recording)?, self.recording(state)?);
        let over = seconds(first.movement_time);
        let now = tick as f64;
        let going = first.at(state.turn.first.since_onset(now).min(over));
        let left = seconds(state.movement.end.saturating_sub(tick));
        let coming = second.at(seconds(second.movement_time) - left);
        let along = minimum_jerk(state.movement.time(now));
        Some(going.mixed_with(&coming, along))
    }

    /// The recorded shape of the hand in the plane of its pose, mixed with the model's: this `fraction` is recorded.
    fn shaped(&self, state: &PersonState, shape: &[DVec2; 9], fraction: f64) -> [DVec3; 9] {
        let (arm, pose) = (self.arm(state), &state.hand);
        let modelled = arm.keypoints(pose);
        let (ahead, aside, wrist) = (arm.direction(pose), arm.thumb_side(pose), pose.wrist());
        std::array::from_fn(|joint| {
            let on_arm = joint == KeypointName::Shoulder as usize || joint == KeypointName::Elbow as usize;
            let shown = wrist + shape[joint].x * ahead + shape[joint].y * aside;
            if on_arm { modelled[joint] } else { modelled[joint].lerp(shown, fraction.min(1.0)) }
        })
    }
}

/// How much of the hand's shape is the recorded one's still, after the grasp.
fn trail(state: &PersonState, tick: u64) -> f64 {
    1.0 - tick.saturating_sub(state.grasped) as f64 / TRAIL as f64
}
