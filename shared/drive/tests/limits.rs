//! Whatever is commanded, the setpoints keep the joints' limits in every tick, and the joints come to rest when good commands stop.
#![allow(clippy::unwrap_used)]

use bytemuck::zeroed_box;
use coact_drive::Drive;
use coact_messages::{
    ARM_JOINTS, Command, CommandRefusal, DriveMode, DriveReport, HoldReason, JOINTS, LAYOUT,
};
use coact_period::PERIOD_S;
use coact_robot::{JointLimits, Limiter};
use coact_safety::{DriveLimits, SafetyLimits};
use proptest::prelude::*;

/// Cycles from the last good command to the first of braking, and for what the joints gain in them.
const REACTION: u64 = 5;

fn safety() -> DriveLimits {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config/safety.toml");
    SafetyLimits::load(file.as_ref()).unwrap().drive
}

/// Those of the shipped robot's arm, and tighter ones.
fn limits() -> [JointLimits; JOINTS] {
    std::array::from_fn(|joint| JointLimits {
        lower: -0.4 - 0.1 * joint as f64,
        upper: 1.2,
        velocity: 1.0 + 0.1 * joint as f64,
        effort: 1.0,
        acceleration: 10.0,
        jerk: 200.0 + 20.0 * joint as f64,
    })
}

/// A drive, the commands that it gets, and what it has done.
struct Rig {
    drive: Drive,
    limits: [JointLimits; JOINTS],
    tick: u64,
    sequence: u64,
    command: Box<Command>,
    good: Box<Command>,
    before: DriveReport,
    /// Greatest fraction of the limit of velocity, acceleration and jerk in any tick.
    used: [f64; 3],
}

impl Rig {
    fn new() -> Self {
        let mut drive = Drive::new(limits(), safety());
        drive.start(100, &[0.1; JOINTS]);
        let before = drive.report();
        let (command, good) = (zeroed_box(), zeroed_box());
        Self { drive, limits: limits(), tick: 100, sequence: 0, command, good, before, used: [0.0; 3] }
    }

    /// The next command of a control that pushes each joint as hard as `push` (-1 to 1) says, within its limits.
    fn next_good(&mut self, push: f64) {
        let report = self.drive.report();
        self.sequence += 1;
        let header = &mut self.good.header;
        (header.layout, header.cycle, header.sequence, header.generation) =
            (LAYOUT, self.tick, self.sequence, 3);
        for joint in 0..JOINTS {
            let own = state(&report, joint);
            let limits = &self.limits[joint];
            let jerk = push * 0.999 * limits.jerk;
            let wish =
                own.position + PERIOD_S * (own.velocity + PERIOD_S * (own.acceleration + PERIOD_S * jerk));
            let next = own.accept(wish, limits, PERIOD_S).unwrap_or_else(|| own.brake(limits, PERIOD_S));
            self.good.position[joint] = next.position;
        }
        self.command = self.good.clone();
    }

    /// One step; the setpoints' differences are held against the limits.
    fn step(&mut self, command: bool, hold: HoldReason) -> DriveReport {
        self.tick += 1;
        let command = command.then_some(&*self.command);
        let measured = self.before.position;
        self.drive.step(self.tick, command, hold, &measured);
        let report = self.drive.report();
        for (joint, limits) in self.limits.iter().enumerate() {
            let (now, before) = (state(&report, joint), state(&self.before, joint));
            assert!(limits.contain(now.position, 0.0), "joint {joint} at {} rad", now.position);
            let velocity = (now.position - before.position) / PERIOD_S;
            assert!(
                (velocity - now.velocity).abs() < 1e-8,
                "joint {joint}: what it says is not what it does"
            );
            let jerk = (now.acceleration - before.acceleration) / PERIOD_S;
            let used =
                [velocity / limits.velocity, now.acceleration / limits.acceleration, jerk / limits.jerk];
            for (most, used) in self.used.iter_mut().zip(used) {
                *most = most.max(used.abs());
            }
        }
        // The last step of braking is one of less than 1e-9 rad/s and 1e-6 rad/s².
        assert!(self.used[0] <= 1.0 + 1e-9 && self.used[1] <= 1.0 + 1e-9, "{:?}", self.used);
        assert!(self.used[2] <= 1.0 + 2e-5, "{:?}", self.used);
        self.before = report;
        report
    }

    fn stands(&self) -> bool {
        self.drive.stands()
    }

    /// Cycles that the joints need to stop from here.
    fn stopping(&self) -> u64 {
        let report = self.drive.report();
        let cycles = (0..JOINTS).map(|joint| {
            let mut state = state(&report, joint);
            (0..).find(|_| {
                let rests = state.is_at_rest();
                state = state.brake(&self.limits[joint], PERIOD_S);
                rests
            })
        });
        cycles.flatten().max().unwrap_or(0)
    }
}

fn state(report: &DriveReport, joint: usize) -> Limiter {
    Limiter {
        position: report.position[joint],
        velocity: report.velocity[joint],
        acceleration: report.acceleration[joint],
    }
}

/// What becomes of a good command; all but the first make it one that must not be followed.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Fault {
    None,
    Missing,
    NotFinite,
    Huge,
    Replayed,
    Backward,
    Future,
    Old,
    OtherLayout,
    OtherGeneration,
    OtherSequence,
    Held,
}

const FAULTS: [Fault; 12] = [
    Fault::None,
    Fault::Missing,
    Fault::NotFinite,
    Fault::Huge,
    Fault::Replayed,
    Fault::Backward,
    Fault::Future,
    Fault::Old,
    Fault::OtherLayout,
    Fault::OtherGeneration,
    Fault::OtherSequence,
    Fault::Held,
];

fn spoil(rig: &mut Rig, fault: Fault, number: f64) {
    let last = rig.command.clone();
    if fault != Fault::Replayed {
        rig.next_good(number);
    }
    let joint = (number.abs() * 1000.0) as usize % JOINTS;
    let command = &mut rig.command;
    match fault {
        Fault::NotFinite => command.position[joint] = [f64::NAN, f64::INFINITY][joint % 2],
        Fault::Huge => command.position[joint] += 1e3 * number + 0.01,
        Fault::Replayed => *command = last,
        Fault::Backward => command.header.cycle -= 2,
        Fault::Future => command.header.cycle += 1500,
        Fault::Old => command.header.cycle -= 60,
        Fault::OtherLayout => command.header.layout -= 1,
        // It knows nothing of what was sent last: a replacement or a standby counts on.
        Fault::OtherGeneration => {
            (command.header.generation, command.header.sequence) = ([0, 7][joint % 2], 0)
        }
        Fault::OtherSequence => command.header.sequence += 1000,
        Fault::None | Fault::Missing | Fault::Held => {}
    }
}

fn stretch() -> impl Strategy<Value = (usize, u64, f64)> {
    (0..FAULTS.len(), prop_oneof![1u64..6, 20u64..200], -1.0..1.0f64)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_sequence_of_commands_breaks_a_limit_and_no_bad_one_is_followed(
        stretches in prop::collection::vec(stretch(), 5..30)
    ) {
        let mut rig = Rig::new();
        for (fault, cycles, number) in stretches {
            let fault = FAULTS[fault];
            // Good commands come first: the joints move, and the writer is known.
            for _ in 0..cycles {
                rig.next_good(number);
                let report = rig.step(true, HoldReason::None);
                prop_assert_eq!(report.mode, DriveMode::Following as u32);
                prop_assert_eq!(report.command_cycle, rig.tick - 1);
            }
            for _ in 0..cycles {
                spoil(&mut rig, fault, number);
                let hold = if fault == Fault::Held { HoldReason::Stopped } else { HoldReason::None };
                let followed = rig.before.command_cycle;
                let report = rig.step(fault != Fault::Missing, hold);
                let is_followed = report.mode == DriveMode::Following as u32;
                // A writer of a newer generation takes over only once the present one is silent.
                let replaced = fault == Fault::OtherGeneration && rig.command.header.generation == 7;
                if !replaced {
                    prop_assert_eq!(is_followed, fault == Fault::None, "{:?}", fault);
                    prop_assert!(is_followed || report.command_cycle == followed);
                }
                if replaced && is_followed {
                    // Its commands count from here on.
                    return Ok(());
                }
            }
        }
    }

    #[test]
    fn joints_rest_within_their_stopping_time_after_the_last_good_command(
        pushes in prop::collection::vec((-1.0..1.0f64, 10u64..150), 1..8), fault in 1..FAULTS.len()
    ) {
        let mut rig = Rig::new();
        for (push, cycles) in pushes {
            for _ in 0..cycles {
                rig.next_good(push);
                rig.step(true, HoldReason::None);
            }
        }
        // Another writer's commands may be followed once this one is silent.
        let fault = if FAULTS[fault] == Fault::OtherGeneration { Fault::Missing } else { FAULTS[fault] };
        // In the two cycles that are bridged a joint may get faster.
        let most = rig.stopping() + 2 * REACTION;
        let hold = if fault == Fault::Held { HoldReason::Stopped } else { HoldReason::None };
        for cycle in 0..most {
            spoil(&mut rig, fault, 0.7);
            let report = rig.step(fault != Fault::Missing, hold);
            let brakes = [DriveMode::Braking as u32, DriveMode::Standing as u32].contains(&report.mode);
            prop_assert!(brakes || cycle < 2, "braking has not begun in cycle {cycle}");
        }
        prop_assert!(rig.stands(), "moves after {most} cycles");
    }
}

#[test]
fn joints_reach_their_speed_limit_in_these_tests() {
    let mut rig = Rig::new();
    for _ in 0..200 {
        rig.next_good(1.0);
        rig.step(true, HoldReason::None);
    }
    assert!(rig.used[0] > 0.95 && rig.used[1] > 0.95, "{:?}", rig.used);
}

/// A path of one second, of all joints of the arm alike.
fn path(t: f64) -> f64 {
    0.1 + 0.3 * t.powi(3) * (10.0 - 15.0 * t + 6.0 * t * t)
}

/// The command of a control that follows that path at its planned speed.
fn command_on_path(rig: &mut Rig, cycle: u64) {
    rig.tick = 100 + cycle;
    rig.sequence = cycle;
    rig.next_good(0.0);
    let elapsed = PERIOD_S * cycle as f64;
    let command = &mut rig.command;
    (command.path.count, command.path.followed) = (2, 1);
    (command.path.elapsed, command.path.speed_override) = (elapsed, 1.0);
    command.path.knots[0].states = [[0.1, 0.0, 0.0]; ARM_JOINTS];
    command.path.knots[1].states = [[0.4, 0.0, 0.0]; ARM_JOINTS];
    command.path.knots[1].t = 1.0;
    command.position[..ARM_JOINTS].fill(path(elapsed));
}

#[test]
fn when_commands_stop_the_arm_brakes_along_its_path() {
    let mut rig = Rig::new();
    for cycle in 1..400 {
        command_on_path(&mut rig, cycle);
        rig.step(true, HoldReason::None);
    }
    let (alone, mut cycles) = (rig.stopping(), 0);
    while !rig.stands() {
        let report = rig.step(false, HoldReason::None);
        assert_eq!(report.on_path, 1, "after {cycles} cycles");
        for joint in 0..ARM_JOINTS {
            assert!((report.position[joint] - path(report.elapsed)).abs() < 1e-9);
        }
        cycles += 1;
    }
    // Two cycles are bridged; and no joint brakes harder than the one that can least.
    assert!(cycles <= 2 + alone + alone / 4 + 5, "{cycles} cycles; the joints alone need {alone}");
    assert_eq!(rig.drive.report().mode, DriveMode::Standing as u32);
}

#[test]
fn one_lost_command_is_bridged_along_the_path_and_the_next_one_is_followed() {
    let mut rig = Rig::new();
    for cycle in 1..300 {
        command_on_path(&mut rig, cycle);
        assert_eq!(rig.step(true, HoldReason::None).on_path, 1, "cycle {cycle}");
    }
    for lost in [1, 2] {
        let from = rig.tick - 100;
        for cycle in from..from + lost {
            rig.tick = 100 + cycle;
            let report = rig.step(false, HoldReason::None);
            assert_eq!((report.mode, report.on_path), (DriveMode::Bridging as u32, 1));
            assert!((report.position[3] - path(PERIOD_S * (cycle) as f64)).abs() < 1e-9);
        }
        for cycle in from + lost..from + lost + 20 {
            command_on_path(&mut rig, cycle);
            assert_eq!(rig.step(true, HoldReason::None).mode, DriveMode::Following as u32, "cycle {cycle}");
        }
    }
}

#[test]
fn a_replacement_is_followed_once_its_predecessor_is_silent() {
    let mut rig = Rig::new();
    for _ in 0..50 {
        rig.next_good(1.0);
        rig.step(true, HoldReason::None);
    }
    // While the writer is there, another one that does not count on is foreign.
    rig.next_good(1.0);
    let counted = rig.command.header.sequence;
    (rig.command.header.generation, rig.command.header.sequence) = (9, 0);
    rig.step(true, HoldReason::None);
    assert_eq!(rig.before.refused[CommandRefusal::OutOfOrder as usize], 1);
    for _ in 0..10 {
        rig.step(false, HoldReason::None);
    }
    assert_eq!(rig.before.mode, DriveMode::Braking as u32);
    // It goes on from the drive's own setpoints, and begins to count anew.
    rig.next_good(0.0);
    (rig.command.header.generation, rig.command.header.sequence) = (4, 0);
    assert_eq!(rig.step(true, HoldReason::None).mode, DriveMode::Following as u32);
    // The dead one's late messages are not followed.
    rig.next_good(0.0);
    (rig.command.header.generation, rig.command.header.sequence) = (3, counted);
    assert_ne!(rig.step(true, HoldReason::None).mode, DriveMode::Following as u32);
}

#[test]
fn a_standby_that_counts_on_is_followed_at_once() {
    let mut rig = Rig::new();
    for cycle in 0..100_u32 {
        rig.next_good(1.0);
        // Stage and standby are in generations of their own.
        rig.command.header.generation = [2, 0, 5][(cycle / 10 % 3) as usize];
        assert_eq!(rig.step(true, HoldReason::None).mode, DriveMode::Following as u32, "in cycle {cycle}");
    }
}

#[test]
fn the_motion_is_part_of_a_handover_as_the_command_says_that_is_followed() {
    let mut rig = Rig::new();
    let next = |rig: &mut Rig, handover| {
        rig.next_good(1.0);
        rig.command.handover = handover;
    };
    assert!(!rig.drive.hands_over());
    next(&mut rig, 1);
    rig.step(true, HoldReason::None);
    assert!(rig.drive.hands_over());
    let mut resumed = Drive::new(limits(), safety());
    resumed.resume(rig.drive.state()).unwrap();
    assert!(resumed.hands_over(), "after a restart");
    // Bridging and braking, until it stands, are motions of the last command; what is refused declares nothing.
    next(&mut rig, 0);
    rig.command.position[2] = 1.0;
    for _ in 0..10 {
        rig.step(true, HoldReason::None);
    }
    assert!(rig.drive.hands_over() && rig.before.mode == DriveMode::Standing as u32);
    next(&mut rig, 0);
    rig.step(true, HoldReason::None);
    assert!(!rig.drive.hands_over());
}

#[test]
fn a_repeated_command_is_counted_once() {
    let mut rig = Rig::new();
    rig.next_good(0.0);
    rig.command.position[2] = 1.0;
    for _ in 0..10 {
        rig.step(true, HoldReason::None);
    }
    assert_eq!(rig.before.refused[CommandRefusal::BeyondLimits as usize], 1);
}

#[test]
fn an_arm_that_is_held_back_brakes_and_starts_again_from_where_it_is() {
    let (mut rig, limits) = (Rig::new(), safety());
    for _ in 0..150 {
        rig.next_good(1.0);
        rig.step(true, HoldReason::None);
    }
    // A hindrance stops the first joint.
    let mut held = rig.before.position;
    held[0] -= 2.0 * limits.tracking_error;
    let mut lost = None;
    for cycle in 0..400u64 {
        rig.next_good(1.0);
        rig.tick += 1;
        rig.drive.step(rig.tick, Some(&rig.command), HoldReason::None, &held);
        let report = rig.drive.report();
        if report.hold == HoldReason::TrackingError as u32 && lost.is_none() {
            lost = Some(cycle);
        }
        if lost.is_some() && report.hold == HoldReason::None as u32 {
            break;
        }
    }
    assert!(lost.is_some_and(|lost| u128::from(lost) <= limits.tracking_error_after.as_millis() + 1));
    let report = rig.drive.report();
    assert!((report.position[0] - held[0]).abs() < 0.01, "{} is not {}", report.position[0], held[0]);
}

#[test]
fn what_is_not_measured_brakes_the_arm_and_nothing_starts_without_a_measurement() {
    let mut rig = Rig::new();
    for _ in 0..100 {
        rig.next_good(1.0);
        rig.step(true, HoldReason::None);
    }
    for _ in 0..500 {
        rig.next_good(1.0);
        rig.tick += 1;
        rig.drive.step(rig.tick, Some(&rig.command), HoldReason::None, &[f64::NAN; JOINTS]);
    }
    assert!(rig.stands());
    assert_eq!(rig.drive.report().hold, HoldReason::TrackingError as u32);
    let mut unborn = Drive::new(limits(), safety());
    unborn.start(1, &[f64::NAN; JOINTS]);
    assert!(unborn.setpoints().is_none());
}

#[test]
fn a_resumed_drive_goes_on_in_motion_and_brakes_after_a_long_outage() {
    let mut rig = Rig::new();
    for _ in 0..100 {
        rig.next_good(1.0);
        rig.step(true, HoldReason::None);
    }
    let state = *rig.drive.state();
    for (outage, mode) in [(1, DriveMode::Bridging), (40, DriveMode::Braking)] {
        rig.drive = Drive::new(limits(), safety());
        rig.drive.resume(&state).unwrap();
        rig.before = rig.drive.report();
        rig.tick = 200 + outage - 1;
        assert_eq!(rig.step(false, HoldReason::None).mode, mode as u32, "after {outage} cycles");
    }
    let mut wrong = Drive::new(limits().map(|limits| JointLimits { velocity: 0.1, ..limits }), safety());
    assert!(wrong.resume(&state).is_err(), "setpoints beyond the limits are resumed from");
}
