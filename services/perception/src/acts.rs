use crate::evidence::{follow, smooth_step};
use crate::gestures::Gestures;
use crate::grasps::Grasps;
use crate::objects::TaskPlaces;
use crate::perception_state::PerceptionState;
use crate::pointing::Pointing;
use crate::present_movement::PresentMovement;
use crate::preshape::Classifier;
use crate::reaching::MovementReader;
use coact_joint_task::{Act, Agent, Task};
use coact_messages::{ArmSide, MAX_ACTS, Percept, SceneView};
use coact_period::cycles;
use nalgebra::Vector3;
use std::time::Duration;

/// Cycles in which evidence rises and in which it falls from end to end, given in ms.
///
/// All chosen by hand, between the noise of single frames (17 ms) and the delay of the decision. Evidence of rest rises
/// slowly, for a hand may slow down on its way, and falls fast, for the person has set out. That of grasps only bridges
/// from frame to frame: the network weighs it. That of words falls slowly: they are heard once and stand for what follows.
const fn ramp(rise: u64, fall: u64) -> (f64, f64) {
    (cycles(Duration::from_millis(rise)) as f64, cycles(Duration::from_millis(fall)) as f64)
}
const REST: (f64, f64) = ramp(120, 40);
const REACH: (f64, f64) = ramp(60, 60);
const GESTURE: (f64, f64) = ramp(60, 60);
const GRASP: (f64, f64) = ramp(30, 60);
const HIDDEN: (f64, f64) = ramp(40, 40);
const WORD: (f64, f64) = ramp(60, 300);
/// Time without any sight of the hand from which the person counts as idle: nothing can be told of what she does. Chosen
/// by hand: longer than a drop-out of the tracker.
const UNSEEN: u64 = cycles(Duration::from_secs(1));
/// Dwell at rest that makes full evidence of idling, cycles: then the robot takes the initiative. Chosen by hand.
const LONG: f64 = cycles(Duration::from_secs(3)) as f64;
/// Evidence above which a hand shows something: the middle.
const SHOWN: f64 = 0.5;
/// Distance of a resting hand from its place, m: full, and no evidence. Chosen by hand.
const AT_REST: (f64, f64) = (0.06, 0.12);
/// Speed of a resting hand, m/s: full, and no evidence. The lower one is what the tracker's scatter makes.
const RESTING_SPEED: (f64, f64) = (0.10, 0.25);

/// Makes evidence for each observable act.
#[derive(Debug, Clone)]
pub(crate) struct Acts {
    acts: Vec<Act>,
    /// Of each chain: its kind of part, and who has it.
    about: Vec<(usize, Agent)>,
    /// Where each hand rests, by [`ArmSide`], m.
    rest: [Vector3<f64>; 2],
    grasps: Grasps,
    gestures: Gestures,
}

impl Acts {
    pub fn new(task: &Task) -> Self {
        Self {
            acts: task.acts.clone(),
            about: task.chains.iter().map(|chain| (chain.kind, chain.from)).collect(),
            rest: ArmSide::BOTH.map(|side| task.scene.rest(side).into()),
            grasps: Grasps::new(task),
            gestures: Gestures::new(task),
        }
    }

    /// Whether a movement of this hand begins where it rests.
    pub fn is_from_rest(&self, side: ArmSide, departure: [f64; 3]) -> bool {
        (Vector3::from(departure) - self.rest[side as usize]).norm() < AT_REST.1
    }

    /// Whether the hand shows something: a gesture, or a part that it points at.
    pub fn are_shown(&self, percept: &Percept) -> bool {
        let mut all = self.acts.iter().zip(&percept.act);
        all.any(|(act, evidence)| matches!(act, Act::Gesture(_) | Act::Point(_)) && *evidence > SHOWN)
    }

    /// Moves the evidence for every act one cycle on.
    pub fn report(
        &self,
        tick: u64,
        state: &mut PerceptionState,
        classifier: &Classifier,
        places: &TaskPlaces,
        heard: Option<&[f64]>,
        out: &mut Percept,
    ) {
        let hidden = state.occlusion.is_hidden();
        let movement = PresentMovement::now(tick, state, classifier).filter(|_| !hidden);
        self.grasps.report(movement.as_ref(), state, classifier, places, out);
        let held = out.person_holds.iter().copied().fold(0.0, f64::max);
        let resting = (1.0 - held) * self.resting(tick, state);
        state.unseen = if hidden || state.hand.is_tracked(tick) { 0 } else { state.unseen + 1 };
        state.dwell = if resting > 0.5 || state.unseen > UNSEEN { state.dwell + 1 } else { 0 };
        let pointing = Pointing::now(tick, state, out);
        let reaches = movement.is_some_and(|movement| movement.phase.is_some());
        for (index, act) in self.acts.iter().enumerate().take(MAX_ACTS) {
            let (target, (rise, fall)) = match *act {
                Act::Rest => (resting, REST),
                Act::Idle => ((state.dwell as f64 / LONG).min(1.0), REST),
                Act::Hidden => (f64::from(u8::from(hidden)), HIDDEN),
                Act::Word(_) => (heard.map_or(0.0, |heard| heard[index]), WORD),
                Act::Point(chain) => {
                    let (kind, owner) = self.about[chain];
                    (pointing.map_or(0.0, |pointing| pointing.at(kind, owner, state, places)), GESTURE)
                }
                Act::Reach => (f64::from(u8::from(reaches)), REACH),
                Act::Gesture(gesture) => {
                    (self.gestures.evidence(gesture, tick, movement.as_ref(), state, out), GESTURE)
                }
                Act::Grasp { kind, .. } => (Grasps::evidence(kind, state, out), GRASP),
            };
            let cycles = if target > out.act[index] { rise } else { fall };
            follow(&mut out.act[index], target, cycles);
        }
    }

    /// Tells where a hand may be that has gone out of sight.
    pub fn look_behind(
        &self,
        state: &PerceptionState,
        places: &TaskPlaces,
        view: &SceneView,
        out: &mut Percept,
    ) {
        if state.occlusion.is_hidden() {
            self.grasps.report_hidden(state, places, view, out);
        }
    }

    /// One cycle's part of finding out where the hand's movement leads.
    pub fn look_ahead(&self, state: &mut PerceptionState, reader: &MovementReader, places: &TaskPlaces) {
        if state.hand.movement.is_moving() {
            self.grasps.look_ahead(state, reader, places);
        }
    }

    /// Learns from a part that the hand has taken.
    pub fn learn(&self, state: &mut PerceptionState) {
        self.grasps.learn(state);
    }

    fn resting(&self, tick: u64, state: &PerceptionState) -> f64 {
        let (movement, side) = (&state.hand.movement, state.acting());
        // A hand that has set out does not rest, however near to its place the part lies that it reaches for.
        let sets_out = movement.is_moving() && self.is_from_rest(side, movement.departure);
        if sets_out || !state.hand.is_tracked(tick) {
            return 0.0;
        }
        let away = (state.hand.wrist_at(tick) - self.rest[side as usize]).norm();
        let slow = smooth_step(movement.speed, RESTING_SPEED.1, RESTING_SPEED.0);
        smooth_step(away, AT_REST.1, AT_REST.0) * slow
    }
}
