use crate::body::Body;
use crate::choice::{self, Choice};
use crate::errand::{Errand, Leg};
use crate::guard::Guard;
use crate::places::Places;
use crate::planner::{GUIDE, Planner};
use crate::planning::Planning;
use crate::senses::Senses;
use crate::servo::Servo;
use crate::{ControlError, Memory, PlanningThread, Settings};
use coact_joint_task::{Action, ActionType, Task};
use coact_messages::{Command, FieldFrame, JOINTS, MotionPhase, NONE, Percept, SensorSample};
use coact_robot::{NextUse, Robot};

/// Pace below which the person is in the way: less than that at which the arm gets away from somebody.
const SLOW: f64 = 0.3;

/// Cycles without a decision after which an errand is given up: between one decision and the next there is none for some.
const HESITATION: u64 = 120;

/// The control stage: decisions in, setpoints out, one period of 1 ms at each step.
#[derive(Debug)]
pub struct Control {
    pub(crate) body: Body,
    pub(crate) places: Places,
    pub(crate) actions: Vec<Action>,
    pub(crate) settings: Settings,
    pub(crate) servo: Servo,
    pub(crate) guard: Guard,
    pub(crate) planning: Planning,
    pub(crate) memory: Memory,
    /// Whether setpoints have been sent, or recalled: then they go on from there.
    started: bool,
}

impl Control {
    /// Control that plans its movements within the step that needs them: the same inputs always give the same bits.
    ///
    /// # Errors
    /// [`ControlError::Unreachable`] when the robot cannot reach a place that the task's actions need,
    /// [`ControlError::Robot`] when its collision geometry cannot be used.
    pub fn new(robot: Robot, task: &Task, settings: Settings) -> Result<Self, ControlError> {
        Ok(Self::with(robot, task, settings, |planner| (Planning::at_once(planner), ()))?.0)
    }

    /// Control for real time: its movements are planned by the thread that is returned, beside the servo.
    ///
    /// # Errors
    /// As [`Control::new`].
    pub fn in_real_time(
        robot: Robot,
        task: &Task,
        settings: Settings,
    ) -> Result<(Self, PlanningThread), ControlError> {
        Self::with(robot, task, settings, Planning::beside)
    }

    fn with<T>(
        robot: Robot,
        task: &Task,
        settings: Settings,
        planning: impl FnOnce(Planner) -> (Planning, T),
    ) -> Result<(Self, T), ControlError> {
        let body = Body::new(robot, task)?;
        let places = Places::new(&body, task);
        let planner = Planner::new(body.clone(), places.clone(), task)?;
        check(&planner, &places, task)?;
        let guard = Guard::new(&body, &places, &planner)?;
        let park = body.park();
        let (planning, thread) = planning(planner);
        let control = Self {
            servo: Servo::new(body.limits(), park),
            memory: Memory::at_rest(park),
            guard,
            planning,
            actions: task.actions.clone(),
            body,
            places,
            settings,
            started: false,
        };
        Ok((control, thread))
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
        let pace = self.pace(&senses);
        self.servo.advance(&mut self.memory, !senses.blind(), pace);
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
        let posture = self.servo.posture();
        let robot = &self.body.robot;
        choice::feel(&mut self.memory, senses, || (robot.palm(&posture), robot.grasp_point(&posture)));
        if let Some(decision) = senses.decision().filter(|d| u64::from(d.action) == self.memory.action) {
            self.memory.since = decision.since;
        }
        let choice = Choice::of(&self.memory, senses, &self.actions, &self.settings);
        let leg = self.memory.leg();
        let resting = leg == Leg::Rest && self.memory.errand() != Errand::Park;
        let hesitates = choice.errand == Errand::Park && (1..HESITATION).contains(&self.memory.silent);
        if leg.is_firm() || (choice.is_under_way(&self.memory) && !resting) || (hesitates && !resting) {
            return;
        }
        if choice::can_begin(&choice, senses) {
            self.memory.decided = senses.tick();
            self.begin(&choice, senses);
        } else if self.memory.errand() != Errand::Park || resting {
            self.begin(&Choice { errand: Errand::Park, ..choice }, senses);
        }
    }

    /// How fast the arm may go on: slower, or not at all, where the person comes near.
    fn pace(&mut self, senses: &Senses) -> f64 {
        if self.memory.arrived() {
            return 1.0;
        }
        let Some(person) = senses.person_arm(&self.body.hulls) else { return 1.0 };
        let (hold, closing) = (self.hold(), coact_messages::finger_closure(&self.servo.position()));
        let pace = self.guard.pace(&self.memory, hold, closing, &person);
        let blocked = self.memory.blocked;
        self.memory.blocked = if pace < SLOW { blocked + 1 } else { blocked.saturating_sub(1) };
        pace
    }

    /// How the part in the hand is held: index of a hold.
    pub(crate) fn hold(&self) -> Option<usize> {
        self.memory.held().map(|kind| self.body.holds.known(self.memory.hold, kind))
    }

    /// Notes how long after the decision its movement begins.
    pub(crate) fn note_reaction(&mut self, senses: &Senses) {
        if self.memory.decided > 0 {
            self.memory.reaction = senses.tick() - self.memory.decided.min(senses.tick());
            self.memory.begun += 1;
            self.memory.decided = 0;
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
        out.begun = self.memory.begun as u32;
        out.reaction = u32::try_from(self.memory.reaction).unwrap_or(u32::MAX);
        self.memory.store(out);
    }

    fn phase(&self) -> MotionPhase {
        let empty = self.memory.held().is_none();
        match self.memory.leg() {
            Leg::Rest => MotionPhase::Rest,
            Leg::Move if self.memory.course.is_approach(self.memory.elapsed) => MotionPhase::Approach,
            Leg::Plan | Leg::Move if !empty => MotionPhase::Transport,
            Leg::Plan | Leg::Move if self.memory.errand() == Errand::Park => MotionPhase::Retreat,
            Leg::Plan | Leg::Move => MotionPhase::Reach,
            Leg::Await | Leg::Stay => MotionPhase::Dwell,
            Leg::Close | Leg::Feel => MotionPhase::Grasp,
            Leg::Open => MotionPhase::Release,
        }
    }
}

/// Refuses a task with a place that the hand needs and cannot reach.
fn check(planner: &Planner, places: &Places, task: &Task) -> Result<(), ControlError> {
    for action in &task.actions {
        let goals = match (action.action_type, action.kind, action.subgoal) {
            (ActionType::Insert, Some(kind), Some(subgoal)) => {
                places.takes(kind, NextUse::Insert { depth: GUIDE }, &places.socket(subgoal))
            }
            (ActionType::Receive | ActionType::Give, Some(kind), _) => {
                places.takes(kind, NextUse::Anything, &places.meeting())
            }
            (ActionType::Request, ..) => vec![(places.held_out(), None)],
            (ActionType::Steady, ..) => vec![(places.steadying(), None)],
            _ => continue,
        };
        let Some((goal, _)) = goals.first().copied() else { continue };
        if !planner.reaches(goals.into_iter().map(|(goal, _)| goal).collect())? {
            let [x, y, z]: [f64; 3] = goal.approach.into();
            return Err(ControlError::Unreachable {
                what: format!("the place for \"{}\"", action.name),
                place: goal.point.coords.into(),
                towards: format!("pointing along ({x:.2}, {y:.2}, {z:.2}) and {:.2} m before it", goal.back),
            });
        }
    }
    Ok(())
}

/// Measured minus commanded position, rad; 0 when nothing usable was measured.
fn tracking_error(measured: Option<[f64; JOINTS]>, commanded: [f64; JOINTS], joint: usize) -> f64 {
    let error = measured.map_or(0.0, |measured| measured[joint] - commanded[joint]);
    if error.is_finite() { error } else { 0.0 }
}
