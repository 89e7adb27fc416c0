use crate::braking_path::BrakingPath;
use crate::guard::{Guard, Moving};
use crate::inputs::Inputs;
use crate::moving_fingers::MovingFingers;
use crate::person::PersonCapsules;
use crate::planning::{HandGoals, PlannerDelay, PlannerLink, PlanningThread, SkillPlanner};
use crate::resynchronise::{holds, report_of};
use crate::robot::{CollisionModels, RobotModel};
use crate::servo::{ArmStep, Servo};
use crate::state::{ControlState, SkillPhase};
use crate::{ControlError, reachability};
use coact_joint_task::Task;
use coact_messages::{
    ARM_JOINTS, Command, DriveReport, FieldFrame, JOINTS, MotionPhase, NONE, Percept, SensorSample,
};
use coact_period::PERIOD_S;
use coact_robot::{HAND_JOINTS, PathProgress, Robot};
use coact_safety::SafetyLimits;
use coact_stage_state::{Flag, StageState};
use std::time::Duration;

/// What is left in each cycle of the speed that the guard does not admit. Chosen by hand: a hundredth of what braking takes
/// away, so that the arm holds a speed a little below the admitted one.
const SLOWER: f64 = 0.99;

/// An arm whose speed override is below this stands. Chosen by hand: the hand would creep by less than 10 mm a second.
const SLOWEST: f64 = 0.01;

/// The control stage: decisions in, setpoints out, one period at each step.
#[derive(Debug)]
pub struct Control {
    pub(crate) model: RobotModel,
    pub(crate) goals: HandGoals,
    pub(crate) task: Task,
    pub(crate) limits: SafetyLimits,
    pub(crate) servo: Servo,
    pub(crate) guard: Guard,
    pub(crate) planner: PlannerLink,
    pub(crate) state: ControlState,
    /// Whether setpoints have been sent, or resumed from: then they go on from there.
    started: bool,
    /// Whether the guard has no say.
    unguarded: bool,
    /// Whether the hand gets ready for nothing.
    pub(crate) myopic: bool,
}

impl Control {
    /// Control that plans its movements within the step that needs them: the same inputs always give the same bits.
    ///
    /// # Errors
    /// [`ControlError::Unreachable`] when the robot cannot reach a place that the task's actions need,
    /// [`ControlError::Ungraspable`] when its hand cannot grasp a part, [`ControlError::Robot`] when its collision geometry
    /// cannot be used.
    pub fn new(robot: Robot, task: &Task, limits: &SafetyLimits) -> Result<Self, ControlError> {
        Ok(Self::with(robot, task, limits, reachability::check, |planner| {
            (PlannerLink::within(planner), ())
        })?
        .0)
    }

    /// Control for real time: its movements are planned by the thread that is returned, beside the servo.
    ///
    /// # Errors
    /// As [`Control::new`].
    pub fn in_real_time(
        robot: Robot,
        task: &Task,
        limits: &SafetyLimits,
    ) -> Result<(Self, PlanningThread), ControlError> {
        Self::with(robot, task, limits, reachability::check, PlannerLink::beside)
    }

    /// The same for a process whose predecessor has found all places of the task within reach: to look for that again would take
    /// half of its start.
    ///
    /// # Errors
    /// As [`Control::new`], but for [`ControlError::Unreachable`].
    pub fn of_replacement(
        robot: Robot,
        task: &Task,
        limits: &SafetyLimits,
    ) -> Result<(Self, PlanningThread), ControlError> {
        Self::with(robot, task, limits, |_, _, _| Ok(()), PlannerLink::beside)
    }

    fn with<T>(
        robot: Robot,
        task: &Task,
        limits: &SafetyLimits,
        check: impl FnOnce(&SkillPlanner, &HandGoals, &Task) -> Result<(), ControlError>,
        link: impl FnOnce(SkillPlanner) -> (PlannerLink, T),
    ) -> Result<(Self, T), ControlError> {
        let model = RobotModel::new(robot, task)?;
        let goals = HandGoals::new(&model, task);
        let models = CollisionModels::new(&model.robot, task)?;
        let guard = Guard::new(&model, models.mechanism.clone(), limits.guard)?;
        let planner = SkillPlanner::new(model.clone(), models, goals.clone(), task, *limits);
        check(&planner, &goals, task)?;
        let park = model.park();
        let (planner, thread) = link(planner);
        let control = Self {
            servo: Servo::new(model.limits(), park),
            state: ControlState::at_rest(park),
            guard,
            planner,
            task: task.clone(),
            model,
            goals,
            limits: *limits,
            started: false,
            unguarded: false,
            myopic: false,
        };
        Ok((control, thread))
    }

    /// Goes on from the last command of a predecessor: its setpoints, its trajectory, its skill. A command without such a
    /// state is ignored: `false`.
    pub fn resume(&mut self, last: &Command) -> bool {
        self.take_over(last)
    }

    /// From now on the guard admits everything: to measure in lockstep what it costs, never beside a person.
    pub fn leave_unguarded(&mut self) {
        self.unguarded = true;
    }

    /// From now on the hand gets ready for nothing that is not decided: to measure what it gains.
    pub fn prepare_nothing(&mut self) {
        self.myopic = true;
    }

    /// From now on movements that are planned within the step are there as much later: so lockstep shows what real time does. A planner
    /// beside the servo takes the time that it takes.
    pub fn hold_plans_back(&mut self, delay: PlannerDelay) {
        self.planner.hold_back(delay);
    }

    /// Whether the planner beside the servo hangs: it owes an answer, and its search does not go on. Nothing but another process
    /// helps then; all that control knows stands in its last command. `starves` says whether it would go on but for the machine, and
    /// hardly has since some time ago: then it is waited for.
    pub fn planner_hangs(&self, starves: impl FnOnce(Duration) -> bool) -> bool {
        self.planner.hangs(starves)
    }

    /// Whether a movement is asked for and not there yet. That query is this instance's own: one that takes over asks again.
    pub fn awaits_movement(&self) -> bool {
        self.state.planning.query.is_open()
    }

    /// One period: the setpoints of cycle `tick` into `out`, from the newest messages known. `previous` is the command
    /// of the cycle before; without it the stage goes on from what it sent, or was resumed from. The very first
    /// setpoints are the measured joint positions (the park posture when nothing was measured yet).
    ///
    /// The skill under way is pursued before a decision may begin another one: a phase that ends in this cycle ends with its
    /// skill. Where the drive has not followed what was sent, control goes on from where the drive is; while the drive holds the
    /// joints, nothing is pursued. Whatever the messages hold, setpoints keep the limits of position, velocity, acceleration and jerk.
    pub fn step(
        &mut self,
        tick: u64,
        sample: Option<&SensorSample>,
        percept: Option<&Percept>,
        frame: Option<&FieldFrame>,
        previous: Option<&Command>,
        out: &mut Command,
    ) {
        self.planner.look();
        let drive = report_of(tick, sample);
        self.begin(sample, drive, previous);
        if let Some(drive) = drive {
            self.resynchronise(drive);
        }
        let halted = drive.is_some_and(holds);
        let before = self.servo.position();
        let inputs = Inputs::new(&self.limits.stale, tick, sample, percept, frame);
        inputs.scene().into_iter().for_each(|scene| self.state.seen.see(scene, &self.task));
        if !inputs.blind() && !halted {
            self.pursue(&inputs);
            self.decide(&inputs);
        }
        if !halted {
            self.serve(&inputs);
        }
        self.report(inputs.blind() || halted, out);
        let measured = sample.map(|sample| sample.joints.position);
        out.tracking_error = std::array::from_fn(|joint| tracking_error(measured, before, joint));
    }

    /// Goes on from the previous command, or from where the drive or the joints are.
    fn begin(
        &mut self,
        sample: Option<&SensorSample>,
        drive: Option<&DriveReport>,
        previous: Option<&Command>,
    ) {
        let resumed = previous.is_some_and(|previous| self.take_over(previous));
        if resumed || self.started {
            return;
        }
        let measured = drive.map(|drive| &drive.position).or(sample.map(|sample| &sample.joints.position));
        let position = measured.map_or_else(|| self.model.park(), |angles| self.model.start_from(angles));
        self.servo = Servo::new(self.model.limits(), position);
        self.state = ControlState::at_rest(position);
        if let Some(drive) = drive {
            self.servo.resume(&drive.position, &drive.velocity, &drive.acceleration);
        }
        // A drive that moves brakes: movements begin from where it stands.
        self.state.arm.braking = Flag::from(!self.servo.arm_stands());
        self.started = true;
    }

    /// Takes over state and setpoints of a command; `false`, and nothing changed, when they are not sound.
    fn take_over(&mut self, command: &Command) -> bool {
        let (actions, kinds, grips) =
            (self.task.actions.len(), self.model.part_capsules.len(), self.model.grips.all().len());
        let state = ControlState::load(&command.state).ok();
        let state = state.filter(|state| state.is_of_task(actions, kinds, grips));
        let sound =
            state.is_some() && self.servo.resume(&command.position, &command.velocity, &command.acceleration);
        if let Some(state) = state.filter(|_| sound) {
            self.state = state;
            self.started = true;
        }
        sound
    }

    /// The setpoints of this cycle: along the trajectory as fast as the guard admits. Without fresh inputs, or while nobody
    /// knows where the person is, all joints brake.
    fn serve(&mut self, inputs: &Inputs) {
        self.state.note_handover();
        match self.survey(inputs).filter(|_| !inputs.blind()) {
            None => self.servo.brake(&mut self.state.arm, &mut self.state.fingers),
            Some(person) => {
                let (step, fingers) = (self.arm_step(&person), self.fingers_may_move(inputs, &person));
                self.note_waiting(fingers);
                let ControlState { arm, fingers: moved, .. } = &mut self.state;
                self.servo.advance(arm, step, moved, fingers);
            }
        }
    }

    /// Shows the guard the hand, as it is, and returns the person, as far as she was ever seen.
    fn survey(&mut self, inputs: &Inputs) -> Option<PersonCapsules> {
        let hand = &self.state.hand;
        let held = hand.held().and_then(|kind| self.model.part_capsules.get(kind));
        let held = held.map(|part| part.within(&hand.in_palm.isometry()));
        self.guard.see_hand(&self.fingers(inputs), held);
        self.person(inputs)
    }

    /// The person with what the hand holds, as far as she was ever seen.
    pub(crate) fn person(&self, inputs: &Inputs) -> Option<PersonCapsules> {
        inputs.person(&self.state.seen, &self.model.part_capsules, &self.limits)
    }

    /// Where the fingers are, rad, within their limits: parts keep them from their setpoints.
    pub(crate) fn fingers(&self, inputs: &Inputs) -> [f64; HAND_JOINTS] {
        let (setpoints, limits) = (self.servo.position(), self.model.limits());
        let measured = inputs.fingers().unwrap_or_else(|| hand_of(&setpoints[ARM_JOINTS..]));
        std::array::from_fn(|joint| {
            let limits = &limits[ARM_JOINTS + joint];
            measured[joint].clamp(limits.lower, limits.upper)
        })
    }

    /// Whether the guard lets the fingers go on. Those that have closed on something hold what they have; those that close on it again,
    /// because the person has let go of it first, wait until her hand has left.
    fn fingers_may_move(&mut self, inputs: &Inputs, person: &PersonCapsules) -> bool {
        let phase = self.state.skill.phase();
        let holds = self.held_in().is_some() && !matches!(phase, SkillPhase::Open | SkillPhase::Close);
        if self.unguarded || holds || self.state.fingers.has_arrived() {
            return true;
        }
        let fingers = MovingFingers {
            angles: self.fingers(inputs),
            target: hand_of(&self.state.fingers.target),
            speed: self.servo.finger_speed(),
            stops_in: self.servo.fingers_stop_in(),
        };
        self.guard.admits_fingers(&self.state, &fingers, person)
    }

    /// An arm that has arrived, and whose fingers the guard does not let take their shape, is in the person's way as one that it lets
    /// not go on.
    fn note_waiting(&mut self, fingers_may_move: bool) {
        if self.state.waits_for_fingers() {
            let blocked = &mut self.state.arm.blocked;
            *blocked = if fingers_may_move { 0 } else { blocked.saturating_add(1) };
        }
    }

    /// The arm's next step, as fast as the guard admits; none: it brakes.
    fn arm_step(&mut self, person: &PersonCapsules) -> Option<ArmStep> {
        let arm = &self.state.arm;
        if arm.braking.is_set() {
            return None;
        }
        if self.state.arm_has_arrived() {
            let step = self.servo.step_towards(arm, 1.0);
            self.state.arm.fastest = 1.0;
            return step;
        }
        let step = self.admitted(self.state.arm.fastest, person);
        self.adjust_fastest(step.is_some(), person);
        step
    }

    /// Lets the arm become faster, little by little, where the guard would admit that for good; slower at once where it does not
    /// admit the present speed. So an arm beside a person moves steadily, and does not tremble between its planned speed and
    /// braking.
    fn adjust_fastest(&mut self, admitted: bool, person: &PersonCapsules) {
        let limits = self.limits.guard;
        let PathProgress { speed_override, .. } = self.state.arm.progress;
        let faster = (self.state.arm.fastest + limits.quickening * PERIOD_S).min(1.0);
        if !admitted {
            let slower = speed_override.min(self.state.arm.fastest) * SLOWER;
            self.state.arm.fastest = if slower < SLOWEST { 0.0 } else { slower };
        } else if faster > self.state.arm.fastest && self.admits_for_good(faster, person) {
            self.state.arm.fastest = faster;
        }
        let arm = &mut self.state.arm;
        let is_blocked = arm.fastest < limits.blocked_override;
        arm.blocked = if is_blocked { arm.blocked.saturating_add(1) } else { arm.blocked.saturating_sub(1) };
    }

    /// The next step with a speed override that goes towards `wanted`, if the limiters and the guard admit it.
    fn admitted(&mut self, wanted: f64, person: &PersonCapsules) -> Option<ArmStep> {
        let step = self.servo.step_towards(&self.state.arm, wanted)?;
        self.admits(step.progress, person, 0.0).then_some(step)
    }

    /// Whether the guard would admit this speed override, with some room to spare, if the arm went on steadily with it.
    fn admits_for_good(&mut self, speed_override: f64, person: &PersonCapsules) -> bool {
        let progress = PathProgress { speed_override, override_rate: 0.0, ..self.state.arm.progress };
        self.admits(progress, person, self.limits.guard.hysteresis)
    }

    /// Whether the guard admits that the arm goes on as it moves; not while nobody knows where the person is.
    pub(crate) fn can_brake_clear(&mut self, inputs: &Inputs) -> bool {
        let person = self.survey(inputs);
        person.is_some_and(|person| self.admits(self.state.arm.progress, &person, 0.0))
    }

    fn admits(&mut self, progress: PathProgress, person: &PersonCapsules, spare: f64) -> bool {
        if self.unguarded {
            return true;
        }
        let Self { servo, guard, state, .. } = self;
        let braking = BrakingPath::from(progress, &state.arm.trajectory, servo.arm_limits());
        let moving = Moving { state, posture: servo.posture() };
        braking.is_some_and(|braking| guard.admits(&moving, &braking, person, spare))
    }

    /// The grip in which the held part is held: index into the grip table.
    pub(crate) fn held_in(&self) -> Option<usize> {
        let hand = &self.state.hand;
        hand.held().map(|kind| self.model.grips.known(hand.grip.get(), kind))
    }

    fn report(&self, brakes: bool, out: &mut Command) {
        for (joint, setpoint) in self.servo.joints.iter().enumerate() {
            out.position[joint] = setpoint.position;
            out.velocity[joint] = setpoint.velocity;
            out.acceleration[joint] = setpoint.acceleration;
        }
        let ControlState { arm, skill, decisions, .. } = &self.state;
        arm.trajectory.write(&mut out.path);
        (out.path.elapsed, out.path.speed_override, out.path.override_rate) =
            (arm.progress.elapsed, arm.progress.speed_override, arm.progress.override_rate);
        out.path.followed = u64::from(!arm.braking.is_set());
        out.action = if skill.is_undecided() { NONE } else { skill.action.or(NONE) };
        out.phase = if brakes { MotionPhase::Brake } else { self.motion_phase() } as u32;
        out.begun = decisions.begun as u32;
        out.reaction = u32::try_from(decisions.reaction).unwrap_or(u32::MAX);
        out.speed_override =
            if self.state.arm_has_arrived() { 1.0 } else { self.state.arm.progress.speed_override };
        out.handover = u32::from(self.state.moves_in_handover());
        self.state.store(&mut out.state);
    }

    /// The phase as others see it.
    fn motion_phase(&self) -> MotionPhase {
        let ControlState { arm, skill, hand, .. } = &self.state;
        match skill.phase() {
            SkillPhase::Idle => MotionPhase::Rest,
            SkillPhase::Plan | SkillPhase::Move if skill.prepares.is_set() => MotionPhase::Prepare,
            SkillPhase::Move if arm.is_approaching() => MotionPhase::Approach,
            SkillPhase::Plan | SkillPhase::Move if !hand.is_empty() => MotionPhase::Transport,
            SkillPhase::Plan | SkillPhase::Move if skill.is_parking() => MotionPhase::Retreat,
            SkillPhase::Plan | SkillPhase::Move => MotionPhase::Reach,
            SkillPhase::Wait | SkillPhase::Dwell => MotionPhase::Dwell,
            SkillPhase::Close | SkillPhase::Verify => MotionPhase::Grasp,
            SkillPhase::Open => MotionPhase::Release,
        }
    }
}

/// The joints of the hand, which come first.
fn hand_of(angles: &[f64]) -> [f64; HAND_JOINTS] {
    std::array::from_fn(|joint| angles[joint])
}

/// Measured minus commanded position, rad; 0 when nothing usable was measured.
fn tracking_error(measured: Option<[f64; JOINTS]>, commanded: [f64; JOINTS], joint: usize) -> f64 {
    let error = measured.map_or(0.0, |measured| measured[joint] - commanded[joint]);
    if error.is_finite() { error } else { 0.0 }
}
