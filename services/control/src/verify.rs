//! Whether the fingers have closed on a part, and where it came to lie between them.

use crate::Control;
use crate::inputs::Inputs;
use crate::state::{HandState, Skill, SkillPhase, StoredPose};
use coact_period::cycles;
use coact_stage_state::{Flag, Slot};
use nalgebra::Vector3;
use std::time::Duration;

/// How long touch must be felt for a part to be between the fingers. Chosen by hand: longer than the fingers' impact.
const FELT: u64 = cycles(Duration::from_millis(40));
/// How long that is waited for. Chosen by hand: the fingers have pressed as firmly as they will by then.
const LONGEST: u64 = cycles(Duration::from_millis(400));
/// Camera frames in which the part in the hand is looked at: their mean has half the scatter of one.
const LOOKED: u64 = 4;
/// What no camera frame has shown for so long is out of sight: four of them. Mostly the hand itself hides what it picks, and no later frame will show
/// it.
const HIDDEN: u64 = cycles(Duration::from_millis(120));
/// How near the part must be seen to where it was grasped, m: farther than closing fingers push it, nearer than other parts.
/// Chosen by hand.
const IN_SIGHT: f64 = 0.05;
/// Grasps in a row that close on nothing before the action is given up for a while. Chosen by hand.
const MOST_MISSES: u64 = 3;

impl Control {
    /// Verifies that there is a part between the fingers: that a new one is, or that the held one still is, when the fingers
    /// have closed again on what was to be given.
    pub(crate) fn verify(&mut self, inputs: &Inputs) {
        self.feel_and_look(inputs);
        let is_felt = self.state.skill.progress.touched >= FELT;
        let is_late = self.state.skill.progress.age > LONGEST;
        if !self.state.hand.is_empty() {
            if is_felt {
                self.state.skill.enter(SkillPhase::Dwell);
            } else if is_late {
                self.state.hand.held = Slot::EMPTY;
                self.state.skill.enter(SkillPhase::Idle);
            }
        } else if is_felt && self.has_seen_part(inputs) {
            self.hold_part();
        } else if is_late {
            self.miss();
        }
    }

    /// What the fingers feel, and whether the camera shows what they close on, from when they begin to close. Where it lies counts only once they
    /// have closed: they push it.
    pub(crate) fn feel_and_look(&mut self, inputs: &Inputs) {
        let skill = &mut self.state.skill;
        let expected = skill.place.isometry().translation.vector.into();
        let seen = skill.kind.get().and_then(|kind| inputs.sighting(kind, &expected, IN_SIGHT));
        let closed = skill.phase() == SkillPhase::Verify;
        let since = inputs.tick().saturating_sub(skill.progress.age);
        let progress = &mut skill.progress;
        match inputs.touch() {
            Some(true) => progress.touched = progress.touched.saturating_add(1),
            Some(false) => progress.touched = 0,
            None => {}
        }
        let Some((frame, at)) = seen.filter(|(frame, _)| *frame > progress.seen_in) else { return };
        progress.seen_in = frame;
        if closed && frame >= since {
            let in_palm = self.model.robot.palm(&self.servo.posture()).inverse() * at;
            progress.seen = (Vector3::from(progress.seen) + in_palm.translation.vector).into();
            progress.sightings = progress.sightings.saturating_add(1);
        }
    }

    /// Whether some camera frames have shown what the fingers have closed on, or none does any more.
    fn has_seen_part(&self, inputs: &Inputs) -> bool {
        let progress = &self.state.skill.progress;
        let is_hidden = inputs.tick() > progress.seen_in.saturating_add(HIDDEN);
        progress.sightings >= LOOKED || is_hidden || progress.age > LONGEST
    }

    /// The part between the fingers is held. Closing fingers push a part to where they meet: it is where it was seen now.
    fn hold_part(&mut self) {
        let skill = &self.state.skill;
        let frame = skill.place.isometry();
        let mut in_palm = self.model.robot.palm(&self.servo.posture()).inverse() * frame;
        if skill.progress.sightings > 0 {
            in_palm.translation.vector = Vector3::from(skill.progress.seen) / skill.progress.sightings as f64;
        }
        self.state.hand = HandState {
            hands_over: self.state.hand.hands_over,
            held: skill.kind,
            in_palm: StoredPose::from(in_palm),
            grip: self.state.hand.grip,
            from_table: Flag::from(skill.skill == Skill::Pick),
            picked_at: frame.translation.vector.into(),
            refused: 0,
            pulled: 0,
        };
        self.state.decisions.misses = 0;
        self.state.skill.enter(SkillPhase::Idle);
    }

    /// The fingers have closed on nothing: they open again, and after some misses the action is given up for a while.
    fn miss(&mut self) {
        let misses = &mut self.state.decisions.misses;
        *misses = misses.saturating_add(1);
        if *misses >= MOST_MISSES {
            self.finish(Flag::Set);
        }
        self.move_fingers(SkillPhase::Open);
    }
}
