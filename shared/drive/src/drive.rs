use crate::DriveState;
use crate::followed_command::FollowedCommand;
use bytemuck::Zeroable;
use coact_messages::{
    ARM_JOINTS, Command, CommandRefusal, DriveMode, DriveReport, HoldReason, JOINTS, LAYOUT,
};
use coact_period::{PERIOD_S, cycles};
use coact_robot::{JointLimits, Limiter, MotionState, PathProgress};
use coact_safety::DriveLimits;
use coact_stage_state::{Flag, Implausible, ensure};

/// Fraction of the jerk limit by which a setpoint may exceed it: control computes its own braking, and third differences of
/// positions near 3 rad one period apart round to 2e-6 rad/s³.
const ROUNDING: f64 = 1e-6;
/// A joint that moves by less in a cycle stands, rad: 0.2 rad/s, ten times what encoders scatter.
const STANDS: f64 = 2e-4;

/// Drives the joints: one setpoint for each of them in each cycle, within their limits of position, velocity, acceleration and
/// jerk, whatever is commanded.
///
/// Only where it starts, and where the arm is held elsewhere than its setpoints for too long, does it take the joints'
/// measured positions for setpoints at once: the joints are there already, and stand.
#[derive(Debug, Clone)]
pub struct Drive {
    limits: [JointLimits; JOINTS],
    settings: DriveLimits,
    state: DriveState,
}

impl Drive {
    /// A drive of joints with these limits, which has not started.
    pub fn new(limits: [JointLimits; JOINTS], settings: DriveLimits) -> Self {
        let limits = limits.map(|limits| JointLimits { jerk: limits.jerk * (1.0 + ROUNDING), ..limits });
        Self { limits, settings, state: DriveState::zeroed() }
    }

    /// Starts at rest where the joints are measured, within their limits, once all are; a drive that has started goes on as it is.
    pub fn start(&mut self, tick: u64, measured: &[f64; JOINTS]) {
        if self.setpoints().is_some() || !measured.iter().all(|angle| angle.is_finite()) {
            return;
        }
        self.state.setpoints = self.rest_at(measured);
        (self.state.measured, self.state.tick) = (*measured, tick);
        self.state.mode = DriveMode::Standing;
    }

    /// What it keeps from cycle to cycle.
    pub fn state(&self) -> &DriveState {
        &self.state
    }

    /// Goes on from the state of a drive that died. A long outage counts as one of the commands: the joints brake.
    ///
    /// # Errors
    /// A field that is not what it can be; the drive then stays as it was.
    pub fn resume(&mut self, state: &DriveState) -> Result<(), Implausible> {
        state.check()?;
        let within =
            state.setpoints.iter().zip(&self.limits).all(|(joint, limits)| limits.allows(joint, 0.0));
        ensure(within || state.mode == DriveMode::Absent, "drive.setpoints", "setpoints within the limits")?;
        self.state = *state;
        Ok(())
    }

    /// The setpoints; none before it has started.
    pub fn setpoints(&self) -> Option<&[MotionState; JOINTS]> {
        (self.state.mode != DriveMode::Absent).then_some(&self.state.setpoints)
    }

    /// Whether no setpoint moves.
    pub fn stands(&self) -> bool {
        self.state.setpoints.iter().all(MotionState::is_at_rest)
    }

    /// Makes up for the cycle of `tick`, which the driver itself has missed: the arm goes on along its path for a while, then the
    /// joints brake. An arm's own controller does so, which is not late. The fingers wait for the while: what they are to do next
    /// no command tells, and a movement of theirs that had to begin anew at each delay would never end.
    pub fn make_up(&mut self, tick: u64, measured: &[f64; JOINTS]) {
        if self.setpoints().is_none() {
            return;
        }
        self.state.tick = tick;
        self.watch(measured);
        self.state.late = self.state.late.saturating_add(1);
        let goes_on = self.was_moved()
            && self.state.late <= cycles(self.settings.driver_late_after)
            && self.state.hold == HoldReason::None;
        if goes_on {
            self.bridge_arm();
            self.state.mode = DriveMode::Bridging;
        } else {
            self.go_on(1);
        }
    }

    /// Takes one step, to `tick`: as the newest `command` says if it is good, else on its own. While there is a reason to
    /// `hold` the joints, they brake and stand. `measured`: where the joints are, rad.
    ///
    /// However many ticks have passed since the last step, the setpoints go one cycle on.
    pub fn step(&mut self, tick: u64, command: Option<&Command>, hold: HoldReason, measured: &[f64; JOINTS]) {
        let passed = tick.saturating_sub(self.state.tick);
        if passed == 0 || self.setpoints().is_none() {
            return;
        }
        self.state.tick = tick;
        self.watch(measured);
        self.state.hold = match hold {
            HoldReason::None if self.state.lost.is_set() => HoldReason::TrackingError,
            hold => hold,
        };
        let is_followed = command.is_some_and(|command| self.follow(tick, command));
        if !is_followed {
            self.go_on(passed);
        }
    }

    /// Whether the joints' motion is part of a handover: the command that they followed last declares one.
    pub fn hands_over(&self) -> bool {
        self.state.last.hands_over.is_set()
    }

    /// What it does, for control and the monitor.
    pub fn report(&self) -> DriveReport {
        let DriveState { setpoints, path, last, refused, mode, hold, .. } = &self.state;
        DriveReport {
            position: setpoints.map(|joint| joint.position),
            velocity: setpoints.map(|joint| joint.velocity),
            acceleration: setpoints.map(|joint| joint.acceleration),
            elapsed: path.progress.elapsed,
            speed_override: path.progress.speed_override,
            override_rate: path.progress.override_rate,
            on_path: u32::from(path.is_followed.is_set()),
            mode: *mode as u32,
            hold: *hold as u32,
            reserved: 0,
            command_cycle: last.cycle,
            refused: *refused,
        }
    }

    /// Follows a command that was not judged before, if it is good; counts it by the reason if it is not.
    fn follow(&mut self, tick: u64, command: &Command) -> bool {
        let judged = [command.header.generation.into(), command.header.sequence.saturating_add(1)];
        if judged == self.state.judged {
            return false;
        }
        self.state.judged = judged;
        match self.judge(tick, command) {
            Ok(setpoints) => {
                self.state.setpoints = setpoints;
                self.state.path.take(command);
                self.state.last = FollowedCommand::of(command);
                (self.state.silent, self.state.late) = (0, 0);
                self.state.mode = DriveMode::Following;
                true
            }
            Err(refusal) => {
                let count = &mut self.state.refused[refusal as usize];
                *count = count.saturating_add(1);
                false
            }
        }
    }

    /// The setpoints of a good command, or why it is none.
    fn judge(&self, tick: u64, command: &Command) -> Result<[MotionState; JOINTS], CommandRefusal> {
        let header = &command.header;
        let refuse = |condition, refusal| if condition { Err(refusal) } else { Ok(()) };
        refuse(header.layout != LAYOUT, CommandRefusal::Layout)?;
        refuse(header.cycle > tick.saturating_add(1), CommandRefusal::Ahead)?;
        let is_old = tick.saturating_sub(header.cycle) > cycles(self.settings.command_after);
        refuse(is_old, CommandRefusal::Old)?;
        let is_next = self.state.last.is_before(header, self.state.silent > 0);
        refuse(!is_next, CommandRefusal::OutOfOrder)?;
        refuse(!command.position.iter().all(|angle| angle.is_finite()), CommandRefusal::NotFinite)?;
        refuse(self.state.hold != HoldReason::None, CommandRefusal::Held)?;
        let mut setpoints = self.state.setpoints;
        for (joint, setpoint) in setpoints.iter_mut().enumerate() {
            *setpoint = self.accept(joint, command.position[joint]).ok_or(CommandRefusal::BeyondLimits)?;
        }
        Ok(setpoints)
    }

    /// Without a command to follow: for a moment the joints go on as they move, then they brake.
    fn go_on(&mut self, passed: u64) {
        self.state.silent = self.state.silent.saturating_add(passed);
        let was_moved = self.was_moved();
        let bridges = self.state.silent < cycles(self.settings.command_after);
        if was_moved && bridges && self.state.hold == HoldReason::None {
            self.bridge_arm();
            self.bridge_fingers();
            self.state.mode = DriveMode::Bridging;
        } else {
            self.brake_along_path();
            self.brake(ARM_JOINTS..JOINTS);
            self.state.mode = if self.stands() { DriveMode::Standing } else { DriveMode::Braking };
        }
    }

    fn was_moved(&self) -> bool {
        matches!(self.state.mode, DriveMode::Following | DriveMode::Bridging)
    }

    /// The arm goes on along its path, or brakes where it cannot.
    fn bridge_arm(&mut self) {
        if !self.take(self.state.path.next()) {
            self.brake_along_path();
        }
    }

    /// The fingers go on with the acceleration that they have; what cannot brakes.
    fn bridge_fingers(&mut self) {
        for joint in ARM_JOINTS..JOINTS {
            let MotionState { position, velocity, acceleration } = self.state.setpoints[joint];
            let next = position + PERIOD_S * (velocity + PERIOD_S * acceleration);
            match self.accept(joint, next) {
                Some(next) => self.state.setpoints[joint] = next,
                None => self.brake(joint..joint + 1),
            }
        }
    }

    /// One cycle of braking of the arm: along its path, as hard as its joints can; where that cannot be, each joint for itself.
    fn brake_along_path(&mut self) {
        let Some(limits) = self.limits.first_chunk::<ARM_JOINTS>().copied() else { return };
        let braked = |drive: &mut Self, effort| drive.take(drive.state.path.braked(&limits, effort));
        if !PathProgress::EFFORTS.into_iter().any(|effort| braked(self, effort)) {
            self.brake(0..ARM_JOINTS);
        }
    }

    /// Takes the arm there on its path; `false`, and nothing changed, when it is not on it, or when a limiter refuses.
    fn take(&mut self, (arm, progress): ([MotionState; ARM_JOINTS], PathProgress)) -> bool {
        if !self.state.path.is_followed.is_set() {
            return false;
        }
        let mut setpoints = self.state.setpoints;
        for (joint, wanted) in arm.iter().enumerate() {
            let Some(next) = self.accept(joint, wanted.position) else { return false };
            setpoints[joint] = next;
        }
        (self.state.setpoints, self.state.path.progress) = (setpoints, progress);
        true
    }

    /// One cycle of braking, each joint for itself: an arm that moves leaves its path.
    fn brake(&mut self, joints: std::ops::Range<usize>) {
        let moves = |joint: usize| joint < ARM_JOINTS && !self.state.setpoints[joint].is_at_rest();
        if joints.clone().any(moves) {
            self.state.path.is_followed = Flag::Unset;
        }
        for joint in joints {
            let braked = limiter(&self.state.setpoints[joint]).brake(&self.limits[joint], PERIOD_S);
            self.state.setpoints[joint] = state(&braked);
        }
    }

    /// The state of a joint after moving to `position` within this cycle, if it can within its limits.
    fn accept(&self, joint: usize, position: f64) -> Option<MotionState> {
        let limiter = limiter(&self.state.setpoints[joint]);
        Some(state(&limiter.accept(position, &self.limits[joint], PERIOD_S)?))
    }

    /// Compares the arm with its setpoints. Once it was too far from them for too long, it brakes, and starts again from where
    /// it is when it stands. What is not measured is too far.
    fn watch(&mut self, measured: &[f64; JOINTS]) {
        let arm = 0..ARM_JOINTS;
        let near = |one: &[f64; JOINTS], other: &dyn Fn(usize) -> f64, most: f64| {
            arm.clone().all(|joint| (one[joint] - other(joint)).abs() <= most)
        };
        let follows =
            near(measured, &|joint| self.state.setpoints[joint].position, self.settings.tracking_error);
        let stands = near(measured, &|joint| self.state.measured[joint], STANDS);
        self.state.measured = *measured;
        self.state.deviating = if follows { 0 } else { self.state.deviating.saturating_add(1) };
        if self.state.deviating > cycles(self.settings.tracking_error_after) {
            self.state.lost = Flag::Set;
        }
        if self.state.lost.is_set() && self.stands() && stands {
            let here = self.rest_at(measured);
            self.state.setpoints[arm.clone()].copy_from_slice(&here[arm]);
            self.state.path.is_followed = Flag::Unset;
            (self.state.lost, self.state.deviating) = (Flag::Unset, 0);
        }
    }

    /// At rest where the joints are measured, as far as that is within their limits; what is not measured stays.
    fn rest_at(&self, measured: &[f64; JOINTS]) -> [MotionState; JOINTS] {
        std::array::from_fn(|joint| {
            let known = Some(measured[joint]).filter(|angle| angle.is_finite());
            let angle = known.unwrap_or(self.state.setpoints[joint].position);
            MotionState::at_rest(angle.clamp(self.limits[joint].lower, self.limits[joint].upper))
        })
    }
}

fn limiter(state: &MotionState) -> Limiter {
    Limiter { position: state.position, velocity: state.velocity, acceleration: state.acceleration }
}

fn state(limiter: &Limiter) -> MotionState {
    MotionState { position: limiter.position, velocity: limiter.velocity, acceleration: limiter.acceleration }
}
