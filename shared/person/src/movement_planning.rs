//! The movements of the person's hand: reaching, showing, carrying, withdrawing.

use crate::reach_profile::{FINGERS, movement_time, peak_aperture, peak_time, time_before_onset};
use crate::recorded_reach::LEAD;
use crate::{Activity, ActivityPhase, HandMovement, HandPose, Person, PersonState, Surroundings};
use coact_joint_task::{Act, Task};
use coact_period::cycles;
use coact_random::Stream;
use coact_recordings::WayKind;
use glam::{DQuat, DVec3};
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};
use std::ops::Range;
use std::time::Duration;

/// Scatter of the hand's pitch from grasp to grasp, rad. Chosen by hand.
const PITCH_SCATTER: f64 = 0.08;
/// Wrist to finger tips of a grasping hand, and of an open one, m: an adult's hand, bent and straight.
pub(crate) const GRASPING: f64 = 0.15;
const OPEN: f64 = 0.18;
/// Thumb to index of an open hand, m. Chosen by hand.
const OPEN_APERTURE: f64 = 0.11;
/// How far short of the handover place the open hand is shown, m: room for the robot's hand.
const SHORT: f64 = 0.10;
/// How far a reach is lifted above the straight line, m. Chosen by hand, as are the next two.
const REACH_ARCH: f64 = 0.015;
/// How far carried parts are lifted above the straight line, m: they pass over parts that lie.
const CARRY_ARCH: f64 = 0.06;
/// How far the withdrawing hand is lifted above the straight line, m.
const WITHDRAW_ARCH: f64 = 0.03;
/// Time of a carrying movement: that of the shortest one, cycles, and what each metre adds, cycles/m. Chosen by hand.
const CARRY_TIME: (u64, f64) =
    (cycles(Duration::from_millis(500)), cycles(Duration::from_millis(900)) as f64);
/// Time of a withdrawing movement, cycles. Chosen by hand.
const WITHDRAW_TIME: Range<u64> = cycles(Duration::from_millis(500))..cycles(Duration::from_millis(700));

impl Person {
    /// The reach of the present activity, from where the hand is now.
    pub(crate) fn reach_movement(&self, state: &PersonState, around: &Surroundings) -> HandMovement {
        let mut rng = self.random.at(Stream::Movement, around.tick);
        let behaviour = self.policy.behaviour();
        let mut mistakes = self.random.at(Stream::Mistake, around.tick);
        let drawn = match behaviour {
            None => movement_time(&mut rng),
            Some(behaviour) => mistakes.random_range(behaviour.movement.clone()).round() as u64,
        };
        let (before, time) = match self.recording(state) {
            Some(reach) => (LEAD, reach.movement_time),
            None => (time_before_onset(drawn), drawn),
        };
        let deviate: f64 = StandardNormal.sample(&mut rng);
        let clarity = behaviour.map_or(1.0, |behaviour| mistakes.random_range(behaviour.clarity.clone()));
        let pitch = self.pitch(state, around.task, clarity) + PITCH_SCATTER * deviate.clamp(-2.0, 2.0);
        let (to, peak) = match state.part.get() {
            Some(part) => {
                let width = around.task.kinds[around.parts.kind(part)].width;
                let centre = around.parts.centre(part, around.task);
                (self.grasp_of(state, centre, pitch, width + FINGERS), peak_aperture(width, &mut rng))
            }
            None => (self.shown(state, pitch, around.task), 0.0),
        };
        HandMovement {
            from: state.hand,
            to,
            start: around.tick,
            onset: around.tick + before,
            end: around.tick + before + if peak > 0.0 { time } else { time * 4 / 3 },
            arch: REACH_ARCH,
            peak_aperture: peak,
            peak_time: peak_time(&mut rng),
        }
    }

    /// The pitch that the present activity's chain shows, rad; receiving a part is grasping it to mount it. A grip of
    /// little clarity lies nearer to the middle of all grips.
    fn pitch(&self, state: &PersonState, task: &Task, clarity: f64) -> f64 {
        let act = state.chain.get().map(|chain| task.chains[chain].act);
        match (act, state.activity()) {
            (Some(Act::Grasp { grip, .. }), _) => self.blurred(grip, state.variation.blur.max(1.0 - clarity)),
            (Some(Act::Gesture(gesture)), Activity::Request) => self.habits.gestures[gesture],
            _ => 0.0,
        }
    }

    /// The pitch of a grip that is shown unclearly: nearer to the middle between all grips, rad.
    fn blurred(&self, grip: usize, blur: f64) -> f64 {
        let grips = &self.habits.grips;
        let middle = grips.iter().sum::<f64>() / grips.len() as f64;
        grips[grip] + blur * (middle - grips[grip])
    }

    /// The open hand, shown in front of the handover place.
    fn shown(&self, state: &PersonState, pitch: f64, task: &Task) -> HandPose {
        let place = DVec3::from(task.scene.handover);
        let flat = HandPose { heading: self.arm(state).heading_to(place), ..HandPose::default() };
        let tips = place - SHORT * self.arm(state).direction(&flat);
        self.arm(state).grasping(tips, pitch, OPEN_APERTURE, (OPEN, 0.0))
    }

    /// Corrects the end of the reach for where the part is now.
    pub(crate) fn aim(&self, state: &mut PersonState, centre: DVec3) {
        let to = state.movement.to;
        state.movement.to = self.grasp_of(state, centre, to.pitch, to.aperture);
    }

    /// The hand that has grasped what is at `centre`; a recorded hand has it where its finger tips are.
    fn grasp_of(&self, state: &PersonState, centre: DVec3, pitch: f64, aperture: f64) -> HandPose {
        let tips = self.recording(state).map_or((GRASPING, 0.0), |reach| reach.centre.into());
        self.arm(state).grasping(centre, pitch, aperture, tips)
    }

    /// Plans the path of the held part to `place`, where its own z axis points along `axis`.
    pub(crate) fn carry_to(
        &self,
        state: &mut PersonState,
        around: &Surroundings,
        (place, axis): (DVec3, DVec3),
        kind: WayKind,
    ) {
        let Some(part) = state.held.get() else { return };
        let (tick, hand) = (around.tick, state.hand);
        let from = around.parts.orientation(part);
        let to = nearest_turn(from, axis);
        let centre = place + to * self.half_height(part, around);
        state.turn_from = from.into();
        state.turn_to = to.into();
        let lag = around.parts.centre(part, around.task) - self.arm(state).centre(&hand);
        state.offset = lag.into();
        let distance = centre.distance(self.arm(state).centre(&hand));
        state.movement = HandMovement {
            from: hand,
            to: self.arm(state).grasping(centre, hand.pitch, hand.aperture, (GRASPING, 0.0)),
            start: tick,
            onset: tick,
            end: tick + CARRY_TIME.0 + (CARRY_TIME.1 * distance) as u64,
            arch: CARRY_ARCH,
            peak_aperture: 0.0,
            peak_time: 0.0,
        };
        self.choose_way(kind, state);
    }

    /// Moves the hand along the present movement. Tells where the held part is then.
    pub(crate) fn carry(
        &self,
        state: &mut PersonState,
        around: &Surroundings,
    ) -> Option<(usize, DVec3, DQuat)> {
        let along;
        (state.hand, along) = self.moving_pose(state, around.tick);
        let part = state.held.get()?;
        let turn =
            DQuat::from_array(state.turn_from).slerp(DQuat::from_array(state.turn_to), along).normalize();
        let centre = self.arm(state).centre(&state.hand) + (1.0 - along) * DVec3::from(state.offset);
        Some((part, centre - turn * self.half_height(part, around), turn))
    }

    /// From the underside of a part to its centre, m, in its own frame.
    pub(crate) fn half_height(&self, part: usize, around: &Surroundings) -> DVec3 {
        0.5 * around.task.kinds[around.parts.kind(part)].shape.height() * DVec3::Z
    }

    /// Opens the hand and takes it back to rest.
    pub(crate) fn withdraw(&self, state: &mut PersonState, around: &Surroundings) {
        let time = self.random.at(Stream::Movement, around.tick).random_range(WITHDRAW_TIME);
        state.movement = HandMovement {
            from: state.hand,
            to: self.arm(state).rest(),
            start: around.tick,
            onset: around.tick,
            end: around.tick + time,
            arch: WITHDRAW_ARCH,
            peak_aperture: 0.0,
            peak_time: 0.0,
        };
        self.choose_way(WayKind::Withdraw, state);
        state.enter(ActivityPhase::Withdraw, state.movement.end);
    }
}

/// The orientation nearest to `from` whose z axis points along `axis`; the shortest turn from upright if there is none.
pub(crate) fn nearest_turn(from: DQuat, axis: DVec3) -> DQuat {
    let turned = DQuat::from_rotation_arc(from * DVec3::Z, axis.normalize_or(DVec3::Z)) * from;
    if turned.is_finite() {
        turned.normalize()
    } else {
        DQuat::from_rotation_arc(DVec3::Z, axis.normalize_or(DVec3::Z))
    }
}
