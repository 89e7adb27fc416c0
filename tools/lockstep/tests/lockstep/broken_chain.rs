//! The chain breaks while the arm moves: measured at the joints, it keeps their limits, stands soon, and goes on afterwards.
#![allow(clippy::unwrap_used)]

use coact_lockstep::Lockstep;
use coact_messages::{ARM_JOINTS, Command, DriveMode, HoldReason, JOINTS};
use coact_period::{PERIOD_S, seconds};
use coact_pipeline::{RunSettings, WorldMode};
use coact_robot::{JointLimits, Robot};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::collections::VecDeque;
use std::path::Path;

/// How fast a joint must be when the chain breaks, as a fraction of its limit.
const FAST: f64 = 0.5;
/// How long the chain is broken, ticks: longer than any arm needs to stop.
const BROKEN: u64 = 500;
/// How long an operator's stop lasts, ticks: longer than anything that control waits for.
const STOPPED: u64 = 5000;
/// Ticks for which the joints go on as they move when no good command comes (`command_after_ms`).
const BRIDGED: u64 = 3;
/// How many times longer a stop along the path takes at most than one of each joint by itself. Chosen by hand: 1.2 is the mean
/// of many, and a quarter more was seen.
const ALONG_PATH: f64 = 1.5;
/// How long the joints are watched afterwards, ticks: the arm moves on, but its hand meets nothing yet that pushes it.
const WATCHED: u64 = 1000;

/// Accelerations are means of so many ticks, as the monitor's are: simulated motors overshoot for some milliseconds.
const MEAN: usize = 10;

/// What becomes of a command while the chain is broken.
#[derive(Debug, Clone, Copy)]
enum Break {
    /// Control is dead, or hangs: its last command stays the newest.
    Silent,
    /// It sends numbers that are none.
    NotFinite,
    /// It has run 1500 cycles ahead.
    Ahead,
    /// Its setpoints jump.
    Jumping,
}

struct Watched {
    stages: Lockstep,
    limits: [JointLimits; JOINTS],
    /// The last step's tick, and the joints' positions, rad, and velocities, rad/s.
    last: (u64, [f64; JOINTS], [f64; JOINTS]),
    /// The joints' velocities in the last ticks that there were, rad/s.
    velocities: VecDeque<(u64, [f64; JOINTS])>,
    /// Greatest fraction of the limits of speed and acceleration that the joints have used since the chain broke.
    used: [f64; 2],
}

impl Watched {
    fn new(world: WorldMode) -> Self {
        let shipped = RunSettings::shipped(&Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config"));
        let robot = Robot::load(&shipped.robot).unwrap();
        let stages = Lockstep::new(&RunSettings { world, ..shipped }).unwrap();
        Self {
            stages,
            limits: coact_drive::joint_limits(&robot),
            last: (0, [0.0; JOINTS], [0.0; JOINTS]),
            velocities: VecDeque::new(),
            used: [0.0; 2],
        }
    }

    fn step(&mut self) {
        let tick = self.stages.ticks();
        self.stages.step();
        let (position, velocity) = (self.stages.state.position, self.stages.state.velocity);
        let (last, from, before) = self.last;
        if tick > last + 1 && last > 0 {
            for (joint, limits) in self.limits[..ARM_JOINTS].iter().enumerate() {
                // From the middle of the last tick seen to the middle of those unseen.
                let speed = (position[joint] - from[joint]) / seconds(tick - last);
                let acceleration = (speed - before[joint]) / (seconds(tick - last + 1) / 2.0);
                self.used[1] = self.used[1].max(acceleration.abs() / limits.acceleration);
            }
        }
        if self.velocities.len() == MEAN {
            let (since, before) = self.velocities.pop_front().unwrap();
            for (joint, limits) in self.limits[..ARM_JOINTS].iter().enumerate() {
                let speed = (position[joint] - from[joint]) / seconds(tick - last);
                let acceleration = (velocity[joint] - before[joint]) / seconds(tick - since);
                self.used[0] = self.used[0].max(speed.abs() / limits.velocity);
                self.used[1] = self.used[1].max(acceleration.abs() / limits.acceleration);
            }
        }
        self.last = (tick, position, velocity);
        self.velocities.push_back((tick, velocity));
    }

    /// Runs until a joint of the arm is fast.
    fn until_fast(&mut self) {
        for _ in 0..30_000 {
            self.step();
            let drive = &self.stages.sample.drive;
            let fast = |joint: usize| drive.velocity[joint].abs() > FAST * self.limits[joint].velocity;
            if (0..ARM_JOINTS).any(fast) {
                return;
            }
        }
        panic!("the arm was never fast");
    }

    fn stands(&self) -> bool {
        self.stages.sample.drive.mode == DriveMode::Standing as u32
    }
}

/// Cycles that the joints need to stop from their setpoints.
fn stopping(watched: &Watched) -> u64 {
    let drive = &watched.stages.sample.drive;
    let cycles = (0..JOINTS).filter_map(|joint| {
        let mut state = coact_robot::Limiter {
            position: drive.position[joint],
            velocity: drive.velocity[joint],
            acceleration: drive.acceleration[joint],
        };
        (0..10_000).find(|_| {
            let rests = state.is_at_rest();
            state = state.brake(&watched.limits[joint], PERIOD_S);
            rests
        })
    });
    cycles.max().unwrap()
}

/// The cycle in which the joints must stand, which begin to brake after [`BRIDGED`] cycles at the latest. They brake along their path,
/// which takes longer than each by itself.
fn until_it_stands(watched: &Watched, cycle: u64, most: u64) -> u64 {
    if cycle > BRIDGED {
        return most;
    }
    cycle + (ALONG_PATH * stopping(watched) as f64) as u64
}

fn spoil(command: &mut Command, good: &Command, how: Break) {
    match how {
        Break::Silent => *command = *good,
        Break::NotFinite => command.position[2] = f64::NAN,
        Break::Ahead => {
            command.header.cycle += 1500;
            command.header.sequence += 1500;
        }
        Break::Jumping => command.position[0] += 0.3,
    }
}

#[test]
fn an_arm_that_was_stopped_for_long_stands_soon_and_goes_on_within_its_limits() {
    let mut watched = Watched::new(WorldMode::Kinematic);
    watched.until_fast();
    watched.used = [0.0; 2];
    let mut most = 0;
    watched.stages.hold(HoldReason::Stopped);
    for cycle in 0..STOPPED {
        watched.step();
        most = until_it_stands(&watched, cycle, most);
        assert!(watched.stands() || cycle <= most, "moves after {cycle} cycles, {most} needed");
    }
    let before = watched.stages.truth.achieved.count_ones();
    watched.stages.hold(HoldReason::None);
    for _ in 0..30_000 {
        watched.step();
        if watched.stages.truth.achieved.count_ones() > before {
            let [speed, acceleration] = watched.used;
            assert!(speed <= 1.0 && acceleration <= 1.05, "{speed}, {acceleration} of the limits");
            return;
        }
    }
    panic!("nothing is achieved afterwards");
}

/// The joints' motion while the chain breaks and afterwards: fractions of their limits of speed and acceleration.
fn break_chain(world: WorldMode, how: Break) -> [f64; 2] {
    let mut watched = Watched::new(world);
    watched.until_fast();
    watched.used = [0.0; 2];
    let good = watched.stages.command.clone();
    let mut most = 0;
    for cycle in 0..BROKEN {
        spoil(&mut watched.stages.command, &good, how);
        watched.step();
        most = until_it_stands(&watched, cycle, most);
        assert!(watched.stands() || cycle <= most, "{how:?}: moves after {cycle} cycles, {most} needed");
    }
    watched.stages.command = good;
    let before = watched.stages.truth.achieved.count_ones();
    (0..WATCHED).for_each(|_| watched.step());
    let used = watched.used;
    println!("{world:?} {how:?}: {used:?} of the limits");
    for _ in 0..30_000 {
        watched.step();
        if watched.stages.truth.achieved.count_ones() > before {
            return used;
        }
    }
    panic!("{how:?}: nothing is achieved afterwards");
}

#[test]
fn the_joints_keep_their_limits_when_control_dies_hangs_or_garbles() {
    for how in [Break::Silent, Break::NotFinite, Break::Ahead, Break::Jumping] {
        let [speed, acceleration] = break_chain(WorldMode::Kinematic, how);
        assert!(speed <= 1.0 && acceleration <= 1.05, "{how:?}: {speed}, {acceleration} of the limits");
    }
}

/// The joints' motion on a machine that stands still with this probability after each tick, for up to so many ticks; and how many
/// subgoals of one assembly are achieved within a minute.
fn stall(probability: f64, most: u64) -> ([f64; 2], u32) {
    let mut watched = Watched::new(WorldMode::Kinematic);
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let mut achieved = 0;
    while watched.stages.ticks() < 60_000 {
        watched.step();
        // The scene is laid out again after an assembly.
        achieved = achieved.max(watched.stages.truth.achieved.count_ones());
        if random.random_bool(probability) {
            watched.stages.stall(random.random_range(1..most));
        }
    }
    (watched.used, achieved)
}

/// A body goes on while the machine stands still: the joints neither stop at once nor jump.
#[test]
fn the_joints_keep_their_limits_on_a_machine_that_stands_still_again_and_again() {
    let ([speed, acceleration], achieved) = stall(0.01, 60);
    assert!(speed <= 1.0 && acceleration <= 1.05, "{speed}, {acceleration} of the limits");
    assert!(achieved > 0, "nothing was achieved");
}

/// A fifth of all cycles is missing, never more than nine at a time.
#[test]
fn the_assembly_goes_on_at_its_pace_on_a_machine_that_is_often_late() {
    let ([speed, acceleration], achieved) = stall(0.05, 10);
    assert!(speed <= 1.0 && acceleration <= 1.05, "{speed}, {acceleration} of the limits");
    assert!(achieved >= 4, "only {achieved} subgoals were achieved");
}

#[test]
fn the_assembly_goes_on_when_control_hangs_for_moments_while_the_arm_moves() {
    for seed in 0..8 {
        let mut watched = Watched::new(WorldMode::Kinematic);
        let mut random = Pcg64Mcg::seed_from_u64(seed);
        watched.until_fast();
        for _ in 0..random.random_range(0..300) {
            watched.step();
        }
        watched.used = [0.0; 2];
        watched.stages.hang_control(random.random_range(1..120));
        let before = watched.stages.truth.achieved.count_ones();
        let progress = |watched: &Watched| watched.stages.truth.achieved.count_ones() > before;
        let found = (0..40_000).any(|_| {
            watched.step();
            progress(&watched)
        });
        assert!(found, "seed {seed}: nothing is achieved afterwards");
        let [speed, acceleration] = watched.used;
        assert!(speed <= 1.0 && acceleration <= 1.05, "seed {seed}: {speed}, {acceleration} of the limits");
    }
}

#[test]
fn the_joints_keep_their_speed_limits_when_control_dies_in_the_physics_world() {
    // Of the joints' acceleration this says nothing: the simulated motors follow setpoints of full jerk with an overshoot.
    let [speed, _] = break_chain(WorldMode::Physics, Break::Silent);
    assert!(speed <= 1.0, "{speed} of the limits");
}
