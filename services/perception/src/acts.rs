use crate::evidence::{follow, smooth_step};
use crate::gestures::Gestures;
use crate::grasps::Grasps;
use crate::memory::Memory;
use crate::movement::Movement;
use crate::objects::Places;
use crate::preshape::Classifier;
use coact_joint_task::{Act, Task};
use coact_messages::{MAX_ACTS, Percept};
use nalgebra::Vector3;

/// Times in which evidence rises or falls from end to end, cycles. That of grasps only bridges from frame to frame.
const REST: (f64, f64) = (120.0, 40.0);
const REACH: (f64, f64) = (60.0, 60.0);
const GESTURE: (f64, f64) = (60.0, 60.0);
const GRASP: (f64, f64) = (30.0, 60.0);
const HIDDEN: (f64, f64) = (40.0, 40.0);
const WORD: (f64, f64) = (60.0, 300.0);
/// Cycles without any sight of the hand from which the person counts as idle: nothing can be told of what she does.
const UNSEEN: u64 = 1000;
/// Dwell at rest that makes full evidence of idling, cycles.
const LONG: f64 = 3000.0;
/// A resting hand is this near to its place (m) and this slow (m/s): full, and no evidence.
const AT_REST: (f64, f64) = (0.06, 0.12);
const RESTING_SPEED: (f64, f64) = (0.10, 0.25);

/// Makes evidence for each observable act.
#[derive(Debug, Clone)]
pub(crate) struct Acts {
    acts: Vec<Act>,
    rest: Vector3<f64>,
    grasps: Grasps,
    gestures: Gestures,
}

impl Acts {
    pub fn new(task: &Task) -> Self {
        Self {
            acts: task.acts.clone(),
            rest: task.scene.person_rest.into(),
            grasps: Grasps::new(task),
            gestures: Gestures::new(task),
        }
    }

    /// Whether the hand's movement begins where it rests.
    pub fn is_from_rest(&self, departure: [f64; 3]) -> bool {
        (Vector3::from(departure) - self.rest).norm() < AT_REST.1
    }

    /// Moves the evidence for every act one cycle on.
    pub fn report(
        &self,
        tick: u64,
        memory: &mut Memory,
        classifier: &Classifier,
        places: &Places,
        heard: Option<&[f64]>,
        out: &mut Percept,
    ) {
        let hidden = memory.hiding.is_hidden();
        let movement = Movement::now(tick, memory, classifier).filter(|_| !hidden);
        let preparing = self.grasps.preparing(movement.as_ref(), memory, classifier, places);
        let held = out.person_holds.iter().copied().fold(0.0, f64::max);
        let resting = (1.0 - held) * self.resting(tick, memory);
        memory.unseen = if hidden || memory.hand.is_tracked(tick) { 0 } else { memory.unseen + 1 };
        memory.dwell = if resting > 0.5 || memory.unseen > UNSEEN { memory.dwell + 1 } else { 0 };
        let reaches = movement.is_some_and(|movement| movement.phase.is_some());
        for (index, act) in self.acts.iter().enumerate().take(MAX_ACTS) {
            let (target, (rise, fall)) = match *act {
                Act::Rest => (resting, REST),
                Act::Idle => ((memory.dwell as f64 / LONG).min(1.0), REST),
                Act::Hidden => (f64::from(u8::from(hidden)), HIDDEN),
                Act::Word(_) => (heard.map_or(0.0, |heard| heard[index]), WORD),
                Act::Reach => (f64::from(u8::from(reaches)), REACH),
                Act::Gesture(gesture) => {
                    (self.gestures.evidence(gesture, tick, movement.as_ref(), memory, out), GESTURE)
                }
                Act::Grasp { grip, kind } => {
                    (self.grasps.evidence(grip, kind, &preparing, memory, out), GRASP)
                }
            };
            let cycles = if target > out.act[index] { rise } else { fall };
            follow(&mut out.act[index], target, cycles);
        }
    }

    fn resting(&self, tick: u64, memory: &Memory) -> f64 {
        let motion = &memory.hand.motion;
        // A hand that has set out does not rest, however near to its place the part lies that it reaches for.
        let sets_out = motion.is_moving() && self.is_from_rest(motion.departure);
        if sets_out || !memory.hand.is_tracked(tick) {
            return 0.0;
        }
        let away = (memory.hand.wrist_at(tick) - self.rest).norm();
        let slow = smooth_step(motion.speed, RESTING_SPEED.1, RESTING_SPEED.0);
        smooth_step(away, AT_REST.1, AT_REST.0) * slow
    }
}
