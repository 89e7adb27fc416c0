use crate::body::Body;
use crate::choice::{self, Choice};
use crate::errand::{Errand, Leg};
use crate::places::Places;
use crate::senses::Senses;
use crate::servo::Servo;
use crate::{ControlError, Memory, Settings};
use coact_joint_task::{Action, Task};
use coact_messages::{Command, FieldFrame, JOINTS, MotionPhase, NONE, Percept, SensorSample};
use coact_robot::Robot;

/// The control stage: decisions in, setpoints out, one period of 1 ms at each step.
#[derive(Debug, Clone)]
pub struct Control {
    pub(crate) body: Body,
    pub(crate) places: Places,
    pub(crate) actions: Vec<Action>,
    pub(crate) settings: Settings,
    pub(crate) servo: Servo,
    pub(crate) memory: Memory,
    /// Whether setpoints have been sent, or recalled: then they go on from there.
    started: bool,
}

impl Control {
    /// # Errors
    /// [`ControlError::Unreachable`] when the robot cannot reach a place that the task's actions need.
    pub fn new(robot: Robot, task: &Task, settings: Settings) -> Result<Self, ControlError> {
        let body = Body { robot };
        let places = Places::new(&body, task)?;
        let park = body.park();
        Ok(Self {
            servo: Servo::new(body.limits(), park),
            memory: Memory::at_rest(park),
            actions: task.actions.clone(),
            body,
            places,
            settings,
            started: false,
        })
    }

    /// Continues from the last command of a predecessor: its setpoints, its movement, its errand.
    pub fn resume(&mut self, last: &Command) {
        self.recall(last);
    }

    /// One period: the setpoints of cycle `tick` into `out`, from the newest messages known. `previous` is the command
    /// of the cycle before; without it the stage goes on from what it sent, or was resumed from. The very first
    /// setpoints are the measured joint positions (the park posture when nothing was measured yet).
    ///
    /// Whatever the messages hold, setpoints keep the limits of position, velocity, acceleration and jerk.
    pub fn step(
        &mut self,
        tick: u64,
        sample: Option<&SensorSample>,
        percept: Option<&Percept>,
        frame: Option<&FieldFrame>,
        previous: Option<&Command>,
        out: &mut Command,
    ) {
        let recalled = previous.is_some_and(|previous| self.recall(previous));
        if !(recalled || self.started) {
            self.start(sample);
        }
        let before = self.servo.position();
        let senses = Senses::new(&self.settings, tick, sample, percept, frame);
        if !senses.blind() {
            self.pursue(&senses);
            self.decide(&senses);
        }
        self.servo.advance(&mut self.memory, !senses.blind());
        self.report(&senses, out);
        let measured = sample.map(|sample| sample.joints.position);
        out.tracking_error = std::array::from_fn(|joint| tracking_error(measured, before, joint));
    }

    fn recall(&mut self, command: &Command) -> bool {
        let Some(memory) = Memory::recall(command) else { return false };
        let sound = self.servo.recall(command);
        if sound {
            self.memory = memory;
            self.started = true;
        }
        sound
    }

    fn start(&mut self, sample: Option<&SensorSample>) {
        let position = sample.map_or_else(|| self.body.park(), |s| self.body.start_from(&s.joints.position));
        self.servo = Servo::new(self.body.limits(), position);
        self.memory = Memory::at_rest(position);
        self.started = true;
    }

    /// Begins another errand when the decision asks for one, as soon as the present leg allows it.
    fn decide(&mut self, senses: &Senses) {
        choice::age(&mut self.memory, senses, &self.actions, &self.settings);
        choice::feel(&mut self.memory, senses);
        if let Some(decision) = senses.decision().filter(|d| u64::from(d.action) == self.memory.action) {
            self.memory.since = decision.since;
        }
        let choice = Choice::of(&self.memory, senses, &self.actions, &self.settings);
        let leg = self.memory.leg();
        let resting = leg == Leg::Rest && self.memory.errand() != Errand::Park;
        if leg.is_firm() || (choice.is_under_way(&self.memory) && !resting) {
            return;
        }
        if leg.is_close() && self.memory.goal().back > 0.0 {
            self.go_back(if self.memory.held().is_some() { Leg::Lift } else { Leg::Retreat });
        } else if choice::can_begin(&choice, senses) {
            self.begin(&choice, senses);
        } else if self.memory.errand() != Errand::Park || resting {
            self.begin(&Choice { errand: Errand::Park, ..choice }, senses);
        }
    }

    fn report(&self, senses: &Senses, out: &mut Command) {
        for (joint, state) in self.servo.joints.iter().enumerate() {
            out.position[joint] = state.position;
            out.velocity[joint] = state.velocity;
            out.acceleration[joint] = state.acceleration;
        }
        let idle = self.memory.errand() == Errand::Park;
        out.action = if idle { NONE } else { u32::try_from(self.memory.action).unwrap_or(NONE) };
        let phase = if senses.blind() { MotionPhase::Brake } else { self.phase() };
        out.phase = phase as u32;
        self.memory.store(out);
    }

    fn phase(&self) -> MotionPhase {
        let (empty, leg) = (self.memory.held().is_none(), self.memory.leg());
        match leg {
            Leg::Rest => MotionPhase::Rest,
            Leg::Park | Leg::Retreat if empty => MotionPhase::Retreat,
            Leg::Plan | Leg::Reach if empty => MotionPhase::Reach,
            Leg::Plan | Leg::Reach | Leg::Park | Leg::Retreat | Leg::Lift => MotionPhase::Transport,
            Leg::Await | Leg::Stay => MotionPhase::Hold,
            Leg::Approach => MotionPhase::Approach,
            Leg::Close | Leg::Feel => MotionPhase::Grasp,
            Leg::Open => MotionPhase::Release,
        }
    }
}

/// Measured minus commanded position, rad; 0 when nothing usable was measured.
fn tracking_error(measured: Option<[f64; JOINTS]>, commanded: [f64; JOINTS], joint: usize) -> f64 {
    let error = measured.map_or(0.0, |measured| measured[joint] - commanded[joint]);
    if error.is_finite() { error } else { 0.0 }
}
