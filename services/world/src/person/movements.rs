use super::actor::{Person, Surroundings};
use super::profile::{FINGERS, minimum_jerk, movement_time, peak_aperture, peak_time, time_before_onset};
use super::recorded::LEAD;
use super::{Errand, HandPose, Movement, PersonMemory, Stage};
use crate::noise::Stream;
use crate::parts::upright_along;
use coact_joint_task::{Act, Task};
use glam::{DQuat, DVec3};
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};

/// Scatter of the hand's pitch from grasp to grasp, rad.
const PITCH_SCATTER: f64 = 0.08;
/// Wrist to finger tips of a grasping hand, and of one held open, m.
const GRASPING: f64 = 0.15;
const OPEN: f64 = 0.18;
/// Thumb to index of a hand held open, m.
const OPEN_APERTURE: f64 = 0.11;
/// How far short of the handover place the open hand is shown, m.
const SHORT: f64 = 0.10;
/// How far a reach is lifted above the straight line, m.
const REACH_ARCH: f64 = 0.015;
/// How far carried parts are lifted above the straight line, m.
const CARRY_ARCH: f64 = 0.06;

impl Person {
    /// The reach of the present action, from where the hand is now.
    pub(super) fn reach_movement(&self, memory: &PersonMemory, around: &Surroundings) -> Movement {
        let mut rng = self.noise.at(Stream::Movement, around.tick);
        let manner = self.plan.rates();
        let mut mistakes = self.noise.at(Stream::Mistake, around.tick);
        let drawn = match manner {
            None => movement_time(&mut rng),
            Some(rates) => mistakes.random_range(rates.movement.clone()).round() as u64,
        };
        let (before, time) = match self.recording(memory) {
            Some(reach) => (LEAD, reach.movement_time),
            None => (time_before_onset(drawn), drawn),
        };
        let deviate: f64 = StandardNormal.sample(&mut rng);
        let clarity = manner.map_or(1.0, |rates| mistakes.random_range(rates.clarity.clone()));
        let pitch = pitch(memory, around.task, clarity) + PITCH_SCATTER * deviate.clamp(-2.0, 2.0);
        let (to, peak) = match memory.part.get() {
            Some(part) => {
                let width = around.task.kinds[around.parts.kind(part)].width;
                let centre = around.parts.centre(part, around.task);
                (self.grasp_of(memory, centre, pitch, width + FINGERS), peak_aperture(width, &mut rng))
            }
            None => (self.shown(pitch, around.task), 0.0),
        };
        Movement {
            from: memory.hand,
            to,
            start: around.tick,
            onset: around.tick + before,
            end: around.tick + before + if peak > 0.0 { time } else { time * 4 / 3 },
            arch: REACH_ARCH,
            peak_aperture: peak,
            peak_time: peak_time(&mut rng),
        }
    }

    /// The open hand, held out in front of the handover place.
    fn shown(&self, pitch: f64, task: &Task) -> HandPose {
        let place = DVec3::from(task.scene.handover);
        let flat = HandPose { heading: self.model.heading_to(place), ..HandPose::default() };
        let tips = place - SHORT * self.model.direction(&flat);
        self.model.grasping(tips, pitch, OPEN_APERTURE, (OPEN, 0.0))
    }

    /// Corrects the end of the reach for where the part is now.
    pub(super) fn aim(&self, memory: &mut PersonMemory, centre: DVec3) {
        let to = memory.movement.to;
        memory.movement.to = self.grasp_of(memory, centre, to.pitch, to.aperture);
    }

    /// The hand that has grasped what is at `centre`; a recorded hand holds it where its finger tips are.
    fn grasp_of(&self, memory: &PersonMemory, centre: DVec3, pitch: f64, aperture: f64) -> HandPose {
        let tips = self.recording(memory).map_or((GRASPING, 0.0), |reach| reach.centre.into());
        self.model.grasping(centre, pitch, aperture, tips)
    }

    /// Plans the way of the held part to `place`, where its own z axis points along `axis`.
    pub(super) fn carry_to(
        &self,
        memory: &mut PersonMemory,
        around: &Surroundings,
        place: DVec3,
        axis: DVec3,
    ) {
        let Some(part) = memory.grip.get() else { return };
        let (tick, hand) = (around.tick, memory.hand);
        let from = around.parts.orientation(part);
        let to = nearest_turn(from, axis);
        let half = 0.5 * around.task.kinds[around.parts.kind(part)].shape.height();
        let centre = place + to * (half * DVec3::Z);
        memory.turn_from = from.into();
        memory.turn_to = to.into();
        let lag = around.parts.centre(part, around.task) - self.model.centre(&hand);
        memory.offset = lag.into();
        let distance = centre.distance(self.model.centre(&hand));
        memory.movement = Movement {
            from: hand,
            to: self.model.grasping(centre, hand.pitch, hand.aperture, (GRASPING, 0.0)),
            start: tick,
            onset: tick,
            end: tick + 500 + (900.0 * distance) as u64,
            arch: CARRY_ARCH,
            peak_aperture: 0.0,
            peak_time: 0.0,
        };
    }

    /// Moves hand and held part along the present movement.
    pub(super) fn carry(&self, memory: &mut PersonMemory, around: &mut Surroundings) {
        memory.hand = memory.movement.pose(around.tick);
        let Some(part) = memory.grip.get() else { return };
        let along = minimum_jerk(memory.movement.time(around.tick));
        let turn =
            DQuat::from_array(memory.turn_from).slerp(DQuat::from_array(memory.turn_to), along).normalize();
        let half = 0.5 * around.task.kinds[around.parts.kind(part)].shape.height();
        let centre = self.model.centre(&memory.hand) + (1.0 - along) * DVec3::from(memory.offset);
        around.parts.place(part, centre - turn * (half * DVec3::Z), turn);
    }

    /// Opens the hand and takes it back to rest.
    pub(super) fn withdraw(&self, memory: &mut PersonMemory, around: &Surroundings) {
        let time = self.noise.at(Stream::Movement, around.tick).random_range(500..700);
        memory.movement = Movement {
            from: memory.hand,
            to: self.model.rest(),
            start: around.tick,
            onset: around.tick,
            end: around.tick + time,
            arch: 0.03,
            peak_aperture: 0.0,
            peak_time: 0.0,
        };
        memory.enter(Stage::Withdraw, around.tick + time);
    }
}

/// The pitch that the present action's chain shows, rad; taking an offered part is grasping it to mount it. A grip of
/// little clarity lies nearer to the middle between it and the nearest other one.
fn pitch(memory: &PersonMemory, task: &Task, clarity: f64) -> f64 {
    let act = memory.chain.get().map(|chain| task.chains[chain].act);
    match (act, memory.errand()) {
        (Some(Act::Grasp { grip, .. }), _) => blurred(grip, memory.manner.blur.max(1.0 - clarity), task),
        (Some(Act::Gesture(gesture)), Errand::Request) => task.gestures[gesture].pitch,
        _ => 0.0,
    }
}

/// The pitch of a grip that is shown unclearly: nearer to the middle between all grips, rad.
fn blurred(grip: usize, blur: f64, task: &Task) -> f64 {
    let own = task.grips[grip].pitch;
    let middle = task.grips.iter().map(|grip| grip.pitch).sum::<f64>() / task.grips.len() as f64;
    own + blur * (middle - own)
}

/// The orientation nearest to `from` whose z axis points along `axis`.
fn nearest_turn(from: DQuat, axis: DVec3) -> DQuat {
    let turned = DQuat::from_rotation_arc(from * DVec3::Z, axis.normalize_or(DVec3::Z)) * from;
    if turned.is_finite() { turned.normalize() } else { upright_along(axis) }
}
