//! What the sensors deliver, and what the monitor is told.

use super::World;
use crate::scenario::Sense;
use crate::sensors::{Capture, LinesOfSight, is_captured, read_joints, recognise, track};
use crate::simulation_state::SimulationState;
use coact_messages::{ArmSide, KeypointName, NONE, PartnerPhase, SensorSample, Truth};
use coact_motion::Capsule;
use coact_person::{Activity, Holder};
use coact_random::Stream;
use coact_stage_state::Slot;
use glam::DVec3;

/// Half the width of a person's arm, m. Chosen by hand: about that of a forearm below the elbow.
const ARM: f64 = 0.043;

impl World {
    /// Reads all sensors.
    pub(super) fn sense(&mut self, tick: u64, out: &mut SensorSample) {
        let last = self.last_tick();
        read_joints(tick, &self.random, &self.joints, self.forces(), &mut out.joints);
        if is_captured(last, tick) {
            self.look(tick, last);
        }
        out.hands = self.simulation.trackers().map(|tracker| tracker.delivered);
        out.scene = self.simulation.scene;
        out.heard = self.simulation.heard;
    }

    /// Takes the frames of the cameras that are due.
    fn look(&mut self, tick: u64, last: Option<u64>) {
        let blind = tick < self.blind_until;
        let person_limbs = self.person_limbs(tick);
        let Self { task, random, person, joints, parts, simulation, staging, shape, .. } = self;
        let (boxes, count) = staging.occluders(tick, simulation.person.occluder());
        let (eye, boxes) = (task.scene.eye(), &boxes[..count]);
        let SimulationState { person: moved, right_tracker, left_tracker, .. } = simulation;
        let hands_unseen = blind || staging.is_blind(Sense::Hand, tick);
        // The tracker has cameras of its own, which see hands past all arms.
        let boards = LinesOfSight { eye, boxes, robot: &[], person: &[] };
        for (side, tracker) in ArmSide::BOTH.into_iter().zip([right_tracker, left_tracker]) {
            let recorded = || person.recorded_keypoints(moved, tick).filter(|_| side == moved.side);
            let capture = || match recorded() {
                _ if hands_unseen => Capture::Nothing,
                Some(keypoints) => Capture::Recorded(keypoints),
                None if person.is_lost(moved, tick) => Capture::Nothing,
                None if side == moved.side => Capture::Simulated(person.keypoints(moved, tick)),
                None => Capture::Simulated(person.resting_keypoints(moved, tick)),
            };
            let noise = [Stream::Tracker, Stream::LeftTracker][side as usize];
            track(tick, last, (random, noise), tracker, capture, |place| boards.hide(place));
        }
        if !blind && !staging.is_blind(Sense::Objects, tick) {
            let person = person_limbs.as_ref().map_or(&[][..], |limbs| limbs);
            let sight = LinesOfSight { robot: shape.links(&joints.position), person, ..boards };
            recognise(tick, last, random, (task, parts), &sight, &mut simulation.scene);
        }
    }

    /// Upper arms and forearms of a person whose arms are known.
    fn person_limbs(&self, tick: u64) -> Option<[Capsule; 4]> {
        if self.person.is_unknown(&self.simulation.person, tick) {
            return None;
        }
        let limb =
            |[start, end]: [[f64; 3]; 2]| Capsule { start: start.into(), end: end.into(), radius: ARM };
        let [right, left] = self
            .person_arms()
            .map(|[shoulder, elbow, wrist, _]| [[shoulder, elbow], [elbow, wrist]].map(limb));
        Some([right[0], right[1], left[0], left[1]])
    }

    /// What the fingers hold a part with, and what the outside exerts on the wrist, N.
    fn forces(&self) -> (f64, DVec3) {
        let Self { hand, robot, parts, simulation, .. } = self;
        let by_rules = || hand.touch(&simulation.robot, parts);
        let touch = robot.grip().map_or_else(by_rules, |grip| grip.force);
        let of_person = DVec3::from(simulation.person.force);
        let outside = match (robot.outside(), simulation.person.held.get()) {
            // The dynamics measure a pull at what the robot holds; a part that the person alone has follows rules.
            (Some(outside), Some(part)) if parts.is(part, Holder::Person) => outside + of_person,
            (Some(outside), _) => outside,
            (None, _) => of_person,
        };
        (touch, outside)
    }

    /// Tells the truth.
    pub(super) fn tell(&self, truth: &mut Truth) {
        let person = &self.simulation.person;
        truth.actions = person.actions as u32;
        let phase = person.phase().as_told();
        let of_action = |index: Slot| if phase == PartnerPhase::Idle { NONE } else { index.or(NONE) };
        truth.phase = phase as u32;
        // To undo a step is no chain of the task.
        let undoes = person.activity() == Activity::Undo;
        truth.chain = if undoes { NONE } else { of_action(person.chain) };
        truth.subgoal = of_action(person.subgoal);
        truth.onset_cycle = person.onset;
        truth.grasp_cycle = person.grasped;
        (truth.turn_cycle, truth.heading_cycle) = (person.turn.begun, person.turn.headed);
        truth.hesitation_cycle = person.hesitation.begun;
        truth.achieved = self.parts.achieved();
        truth.held = [Holder::Robot, Holder::Person].map(|holder| self.parts.held_by(holder));
        truth.assemblies = self.simulation.assemblies;
        truth.error = if phase == PartnerPhase::Idle { 0 } else { person.error as u32 };
        truth.waiting = person.waits_for() as u32;
        truth.joints = self.joints.position;
        truth.arms = self.person_arms();
        truth.side = person.side as u32;
        truth.handover = u32::from(self.drive.hands_over());
        truth.hidden = u32::from(phase != PartnerPhase::Idle && person.occluder().is_some());
    }

    /// Shoulder, elbow, wrist and the tip of the longest finger of each arm, as they are.
    fn person_arms(&self) -> [[[f64; 3]; 4]; 2] {
        let (person, tick) = (&self.simulation.person, self.simulation.tick);
        if self.person.is_unknown(person, tick) {
            return [[[0.0; 3]; 4]; 2];
        }
        let (acting, tip) = match self.person.recorded_joints(person, tick) {
            // Nobody points in the recordings.
            Some(recorded) => (recorded, KeypointName::MiddleTip),
            None => with_longest_finger(self.person.keypoints(person, tick)),
        };
        let (resting, resting_tip) = with_longest_finger(self.person.resting_keypoints(person, tick));
        ArmSide::BOTH.map(|side| {
            let (points, tip) = if side == person.side { (&acting, tip) } else { (&resting, resting_tip) };
            [KeypointName::Shoulder, KeypointName::Elbow, KeypointName::Wrist, tip]
                .map(|name| points[name as usize].into())
        })
    }
}

/// An arm, and the finger that reaches farthest from its wrist: the middle one, unless the index is stretched out alone.
fn with_longest_finger(points: [DVec3; 9]) -> ([DVec3; 9], KeypointName) {
    let reach = |name: KeypointName| points[name as usize].distance(points[KeypointName::Wrist as usize]);
    let (index, middle) = (KeypointName::IndexTip, KeypointName::MiddleTip);
    (points, if reach(index) > reach(middle) { index } else { middle })
}
