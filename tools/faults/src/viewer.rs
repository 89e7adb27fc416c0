use crate::moment::Sight;
use crate::{Setup, Trouble};
use coact_joint_task::ActionType;
use coact_messages::{ARM_JOINTS, Command, Pulse, SensorSample, topic};
use coact_monitor::JointMotion;
use coact_pipeline::Run;
use coact_realtime::{Bus, Input, PortError};
use coact_robot::JointLimits;
use coact_run_records::MotionReport;
use std::time::Duration;

/// Watches a run from outside, as a viewer: what the robot does, and how its joints move. It goes on when the monitor does
/// not.
#[derive(Debug)]
pub(crate) struct Viewer {
    // Before the bus that they were opened on.
    commands: Input<Command>,
    pulses: Input<Pulse>,
    samples: Input<SensorSample>,
    _bus: Bus,
    action_types: Vec<ActionType>,
    motion: JointMotion,
    limits: Vec<JointLimits>,
    fresh: Duration,
    /// Samples before the present cell.
    before: u64,
    sight: Sight,
}

impl Viewer {
    pub(crate) fn join(run: &Run, setup: &Setup) -> Result<Self, Trouble> {
        let open = || -> Result<_, PortError> {
            let bus = Bus::open(run, "faults", 0)?;
            let commands = bus.input(topic::COMMAND)?;
            let (pulses, samples) = (bus.input(&topic::pulse("control"))?, bus.input(topic::SENSORS)?);
            Ok((bus, commands, pulses, samples))
        };
        let (bus, commands, pulses, samples) =
            open().map_err(|error| Trouble::because("the run cannot be watched")(&error))?;
        Ok(Self {
            commands,
            pulses,
            samples,
            _bus: bus,
            action_types: setup.task.actions.iter().map(|action| action.action_type).collect(),
            motion: JointMotion::new(setup.limits.clone(), setup.fresh),
            limits: setup.limits.clone(),
            fresh: setup.fresh,
            before: 0,
            sight: Sight::default(),
        })
    }

    /// Takes in what came since the last look; to be called every few milliseconds. False when no sample came.
    pub(crate) fn look(&mut self) -> Result<bool, Trouble> {
        self.take_in().map_err(|error| Trouble::because("the run cannot be watched any more")(&error))
    }

    fn take_in(&mut self) -> Result<bool, PortError> {
        let Self { commands, pulses, samples, action_types, motion, sight, .. } = self;
        if commands.refresh()? {
            let command = commands.latest();
            sight.phase = command.map(|command| command.phase);
            sight.action = command.and_then(|command| action_types.get(command.action as usize).copied());
        }
        pulses.each(|pulse| motion.commanded(pulse))?;
        let came = samples.each(|sample| {
            motion.sample(sample);
            let speeds = sample.joints.velocity[..ARM_JOINTS].iter();
            sight.speed = speeds.fold(0.0, |most: f64, speed| most.max(speed.abs()));
        })?;
        Ok(came > 0)
    }

    pub(crate) fn sight(&self) -> Sight {
        self.sight
    }

    /// A cell begins: what the joints did before is none of it.
    pub(crate) fn begin(&mut self) {
        self.before = self.samples.header().map_or(0, |header| header.cycle + 1);
        self.motion = JointMotion::new(self.limits.clone(), self.fresh);
        self.motion.resume(MotionReport { samples: self.before, ..MotionReport::default() });
    }

    /// How the joints have moved since the cell began.
    pub(crate) fn motion(&self) -> MotionReport {
        let motion = self.motion.report();
        MotionReport { samples: motion.samples.saturating_sub(self.before), ..motion }
    }
}
