//! How the arm moved, from hand-made sensor samples.

use crate::support::{arm_limits, moving, pulse};
use coact_monitor::JointMotion;
use coact_run_records::MotionReport;
use std::time::Duration;

const FRESH: Duration = Duration::from_millis(50);

/// What is found of an arm whose first joint has this speed in each cycle.
fn found(cycles: std::ops::Range<u64>, speed: impl Fn(u64) -> f64) -> MotionReport {
    let mut motion = JointMotion::new(arm_limits(), FRESH);
    cycles.for_each(|cycle| motion.sample(&moving(cycle, speed(cycle))));
    motion.report()
}

#[test]
fn a_restarted_monitor_goes_on_from_what_was_found_and_counts_what_it_has_not_seen() {
    let before = found(0..600, |cycle| (5e-3 * cycle as f64).min(1.5));
    let mut motion = JointMotion::new(arm_limits(), FRESH);
    motion.resume(before);
    (1000..1100).for_each(|cycle| motion.sample(&moving(cycle, 0.1)));
    let report = motion.report();
    assert_eq!((report.samples, report.unseen), (700, 400));
    assert!(close(report.speed, 0.75) && close(report.acceleration, 0.5), "{report:?}");
}

fn close(found: f64, expected: f64) -> bool {
    (found - expected).abs() < 1e-9
}

#[test]
fn speed_and_acceleration_are_fractions_of_the_joints_own_limits() {
    // 5 rad/s² up to 1.5 rad/s.
    let report = found(0..600, |cycle| (5e-3 * cycle as f64).min(1.5));
    assert_eq!((report.samples, report.unseen), (600, 0));
    assert!(close(report.speed, 0.75) && close(report.acceleration, 0.5), "{report:?}");
}

#[test]
fn a_joint_that_stops_dead_exceeds_its_acceleration() {
    let report = found(0..100, |cycle| if cycle < 50 { 1.0 } else { 0.0 });
    assert!(close(report.acceleration, 10.0), "{report:?}");
}

#[test]
fn nothing_is_concluded_across_samples_that_were_not_seen() {
    let mut motion = JointMotion::new(arm_limits(), FRESH);
    (0..50).for_each(|cycle| motion.sample(&moving(cycle, 1.0)));
    (90..140).for_each(|cycle| motion.sample(&moving(cycle, 0.0)));
    motion.sample(&moving(139, 2.0)); // once more
    let report = motion.report();
    assert_eq!((report.samples, report.unseen), (100, 40));
    assert!(close(report.acceleration, 0.0), "{report:?}");
}

#[test]
fn a_joint_beyond_its_limit_of_position_is_found_on_both_sides() {
    for position in [3.2, -3.2] {
        let mut motion = JointMotion::new(arm_limits(), FRESH);
        let mut sample = moving(0, 0.0);
        sample.joints.position[6] = position;
        motion.sample(&sample);
        assert!(close(motion.report().beyond_position_rad, 0.2));
    }
}

/// Commands come until cycle 100; the arm moves until `until`.
fn moved_on(until: u64, commands_until: u64) -> u64 {
    let mut motion = JointMotion::new(arm_limits(), FRESH);
    for cycle in 0..1000 {
        if cycle < commands_until {
            motion.commanded(&pulse(cycle, 0));
        }
        motion.sample(&moving(cycle, if cycle < until { 1.0 } else { 0.0 }));
    }
    motion.report().on_stale_data_ms
}

#[test]
fn an_arm_that_moves_on_without_commands_is_found_and_one_that_stops_in_time_is_not() {
    assert_eq!(moved_on(1000, 1000), 0);
    assert_eq!(moved_on(140, 100), 0);
    let found = moved_on(450, 100);
    assert!((300..=312).contains(&found), "{found}");
}

#[test]
fn commands_that_descend_from_old_samples_count_as_none() {
    let mut motion = JointMotion::new(arm_limits(), FRESH);
    for cycle in 0..400 {
        let mut command = pulse(cycle, 0);
        command.header.sensor_ns = command.header.sensor_ns.min(100_000_000);
        motion.commanded(&command);
        motion.sample(&moving(cycle, 1.0));
    }
    assert!((248..=252).contains(&motion.report().on_stale_data_ms), "{:?}", motion.report());
}
