use coact_control::{Control, PlannerDelay};
use coact_fields::Network;
use coact_joint_task::{NetworkPlan, Task};
use coact_messages::{
    Command, Decision, FieldFrame, Header, HoldReason, LAYOUT, LayerKind, NONE, Percept, SensorSample, Truth,
    WorldState,
};
use coact_perception::Perception;
use coact_period::PERIOD_NS;
use coact_person::PartsView;
use coact_pipeline::RunSettings;
use coact_robot::Robot;
use coact_safety::SafetyLimits;
use coact_separation::SeparationMeter;
use coact_world::{Settings, World, laid_out};

/// All stages, and the newest message of each topic.
pub struct Lockstep {
    robot: Robot,
    limits: SafetyLimits,
    task: Task,
    world: World,
    perception: Perception,
    network: Network,
    control: Control,
    unguarded: bool,
    myopic: bool,
    planner_delay: PlannerDelay,
    seed: u64,
    tick: u64,
    fields_hangs_until: u64,
    control_hangs_until: u64,
    /// The newest sensor sample.
    pub sample: Box<SensorSample>,
    /// The newest percept.
    pub percept: Box<Percept>,
    /// The newest field frame.
    pub frame: Box<FieldFrame>,
    /// The newest command.
    pub command: Box<Command>,
    /// What is true now.
    pub truth: Box<Truth>,
    /// The world's own state.
    pub state: Box<WorldState>,
    previous_frame: Box<FieldFrame>,
    previous_command: Box<Command>,
    /// What is decided in the network's place, if anything is.
    decision: Option<Decision>,
}

/// Why the stages could not be made.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "each variant is the error of the stage or file that it names")]
pub enum LockstepError {
    #[error(transparent)]
    Task(#[from] coact_joint_task::TaskError),
    #[error(transparent)]
    Robot(#[from] coact_robot::RobotError),
    #[error(transparent)]
    World(#[from] coact_world::WorldError),
    #[error(transparent)]
    Model(#[from] coact_perception::ModelError),
    #[error(transparent)]
    Perception(#[from] coact_perception::SingularModel),
    #[error(transparent)]
    Network(#[from] coact_neural_field::ParameterError),
    #[error(transparent)]
    Control(#[from] coact_control::ControlError),
    /// The safety limits cannot be used.
    #[error(transparent)]
    Safety(#[from] coact_safety::SafetyError),
}

impl Lockstep {
    /// The stages of a run with these settings.
    ///
    /// # Errors
    /// The file or setting that a stage refuses.
    pub fn new(settings: &RunSettings) -> Result<Self, LockstepError> {
        Self::with_plan(settings, |plan| plan)
    }

    /// Measures how near robot and person come, from the truth of each tick.
    ///
    /// # Errors
    /// The robot's collision geometry cannot be used.
    pub fn separation_meter(&self) -> Result<SeparationMeter, LockstepError> {
        Ok(SeparationMeter::new(&self.robot, &self.limits)?)
    }

    /// The same with another network than the task's files make: `change` is given theirs. So an ablation is compared
    /// with the whole network.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_plan(
        settings: &RunSettings,
        change: impl FnOnce(NetworkPlan) -> NetworkPlan,
    ) -> Result<Self, LockstepError> {
        let (task, plan) = NetworkPlan::load(&settings.task)?;
        let plan = change(plan);
        let robot = Robot::load(&settings.robot)?;
        let limits = SafetyLimits::load(&settings.safety)?;
        let own = Settings::of_run(settings, &task, limits.drive)?;
        let world = World::new(&laid_out(&task, settings.layout)?, &robot, own)?;
        let model = coact_perception::PreshapeModel::load(&settings.model)?;
        let network = Network::new(plan, task.fingerprint, settings.seed)?;
        let mut frame: Box<FieldFrame> = bytemuck::zeroed_box();
        network.rest(&mut frame);
        Ok(Self {
            world,
            perception: Perception::new(&task, &model)?.with_robot(robot.clone()),
            control: Control::new(robot.clone(), &task, &limits)?,
            unguarded: false,
            myopic: false,
            planner_delay: PlannerDelay::None,
            robot,
            limits,
            network,
            task,
            seed: settings.seed,
            tick: 0,
            fields_hangs_until: 0,
            control_hangs_until: 0,
            sample: bytemuck::zeroed_box(),
            percept: bytemuck::zeroed_box(),
            previous_frame: frame.clone(),
            frame,
            command: bytemuck::zeroed_box(),
            previous_command: bytemuck::zeroed_box(),
            decision: None,
            truth: bytemuck::zeroed_box(),
            state: bytemuck::zeroed_box(),
        })
    }

    /// From now on control's guard admits everything: to measure what it costs.
    pub fn leave_unguarded(&mut self) {
        self.unguarded = true;
        self.control.leave_unguarded();
    }

    /// From now on the robot's hand gets ready for nothing that is not decided: to measure what it gains.
    pub fn prepare_nothing(&mut self) {
        self.myopic = true;
        self.control.prepare_nothing();
    }

    /// From now on control's planner holds its answers back.
    pub fn hold_plans_back(&mut self, delay: PlannerDelay) {
        self.planner_delay = delay;
        self.control.hold_plans_back(delay);
    }

    /// The task.
    pub fn task(&self) -> &Task {
        &self.task
    }

    /// The network's layers, populations and synapses.
    pub fn plan(&self) -> &NetworkPlan {
        self.network.plan()
    }

    /// The parts as they truly are.
    pub fn parts(&self) -> PartsView<'_> {
        PartsView::new(&self.state.part[..self.state.parts as usize])
    }

    /// Ticks so far.
    pub fn ticks(&self) -> u64 {
        self.tick
    }

    /// The person has said something: the next sensor sample tells it.
    pub fn hear(&mut self, sentence: &str) {
        self.world.hear(sentence);
    }

    /// A program outside has told where the person's hand is, m: for a partner whose hand comes from outside.
    pub fn show_hand(&mut self, points: &[[f64; 3]; 9]) {
        self.world.show_hand(points);
    }

    /// Says why the joints may not move from now on, if there is a reason: they brake and stand.
    pub fn hold(&mut self, reason: HoldReason) {
        self.world.hold(reason);
    }

    /// From now on control gets this decision in the place of the network's: an action of the task, or none. So the robot is
    /// kept busy whatever the person does.
    pub fn decide(&mut self, action: Option<u32>) {
        let action = action.unwrap_or(NONE);
        if self.decision.is_none_or(|decision| decision.action != action) {
            self.decision = Some(Decision { action, reserved: 0, since: self.tick });
        }
    }

    /// Fields dies; another instance is there at once and goes on from the newest frame, as its standby or replacement does.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn replace_fields(&mut self) -> Result<(), LockstepError> {
        self.network = Network::new(self.plan().clone(), self.task.fingerprint, self.seed)?;
        Ok(())
    }

    /// The same of control, from the newest command.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn replace_control(&mut self) -> Result<(), LockstepError> {
        self.control = Control::new(self.robot.clone(), &self.task, &self.limits)?;
        if self.unguarded {
            self.control.leave_unguarded();
        }
        if self.myopic {
            self.control.prepare_nothing();
        }
        self.control.hold_plans_back(self.planner_delay);
        self.control.resume(&self.command);
        Ok(())
    }

    /// Whether control has asked for a movement that is not there yet: query and answer are no part of its command.
    pub fn awaits_movement(&self) -> bool {
        self.control.awaits_movement()
    }

    /// Fields hangs: it does nothing for so many ticks, and its last frame stays the newest.
    pub fn hang_fields(&mut self, ticks: u64) {
        self.fields_hangs_until = self.tick + ticks;
    }

    /// Control hangs: it does nothing for so many ticks, and its last command stays the newest.
    pub fn hang_control(&mut self, ticks: u64) {
        self.control_hangs_until = self.tick + ticks;
    }

    /// The machine stands still: the next period of every stage comes so many ticks late.
    pub fn stall(&mut self, ticks: u64) {
        self.tick += ticks;
    }

    /// Runs one period of every stage.
    pub fn step(&mut self) {
        self.step_watched(&mut |_, stage| stage());
    }

    /// Runs one period; each stage is run by `watch`, which is given its name and must call it once.
    ///
    /// Benches and tests measure single stages of the running whole in this way.
    pub fn step_watched(&mut self, watch: &mut dyn FnMut(&'static str, &mut dyn FnMut())) {
        let Self { world, perception, network, control, sample, percept, truth, state, .. } = self;
        let tick = self.tick;
        std::mem::swap(&mut self.command, &mut self.previous_command);
        std::mem::swap(&mut self.frame, &mut self.previous_frame);
        let (frame, command) = (&mut self.frame, &mut self.command);
        let previous = (tick > 0).then_some(&*self.previous_command);
        watch("world", &mut || world.step(tick, previous, sample, truth, state));
        for header in [&mut sample.header, &mut truth.header, &mut state.header] {
            *header = stamp(tick);
        }
        watch("perception", &mut || perception.step(tick, Some(sample), percept));
        percept.header = stamp(tick);
        if tick < self.fields_hangs_until {
            frame.clone_from(&self.previous_frame);
        } else {
            watch("fields", &mut || network.step(tick, Some(percept), &self.previous_frame, frame));
            frame.header = stamp(tick);
        }
        frame.decision = self.decision.unwrap_or(frame.decision);
        if tick < self.control_hangs_until {
            command.clone_from(&self.previous_command);
        } else {
            watch("control", &mut || {
                control.step(tick, Some(sample), Some(percept), Some(frame), previous, command);
            });
            command.header = stamp(tick);
        }
        self.tick += 1;
    }

    /// Assemblies that are complete, by the truth: the scene is laid out again after each.
    pub fn completed(&self) -> u64 {
        self.truth.assemblies + u64::from(self.task.is_complete(self.truth.achieved))
    }

    /// Whether the robot knows all subgoals to be achieved that the plan asks for.
    pub fn complete(&self) -> bool {
        let row = self.plan().layer(LayerKind::SubgoalsAchieved).populations.clone();
        let known = row
            .zip(0..self.task().subgoals.len())
            .filter(|&(population, _)| self.frame.signal[population] > 0.5);
        self.task().is_complete(known.fold(0, |achieved, (_, subgoal)| achieved | 1 << subgoal))
    }
}

/// The header of every message of a tick: its stamps are the tick's own time.
fn stamp(tick: u64) -> Header {
    let now = tick * PERIOD_NS;
    Header {
        layout: LAYOUT,
        generation: 0,
        sequence: tick,
        cycle: tick,
        sensor_ns: now,
        published_ns: now,
        reserved: 0,
    }
}
