//! Setpoints keep the limits whatever arrives; stale input brakes.
#![allow(clippy::unwrap_used)]

use crate::kinematic_world::KinematicWorld;
use coact_messages::{MotionPhase, SensorSample};
use coact_period::PERIOD_NS;
use proptest::prelude::*;

/// One stretch of disorder: which action is decided, what is broken, for how many cycles.
#[derive(Debug, Clone)]
struct Disorder {
    action: u32,
    fault: u8,
    cycles: u32,
    noise: f64,
}

fn disorder() -> impl Strategy<Value = Disorder> {
    let cycles = prop_oneof![1u32..60, 60u32..1500];
    (0u32..60, 0u8..10, cycles, -1.0..1.0f64).prop_map(|(action, fault, cycles, noise)| Disorder {
        action,
        fault,
        cycles,
        noise,
    })
}

fn garble(world: &mut KinematicWorld, fault: u8, noise: f64) {
    let bad = [f64::NAN, f64::INFINITY, -1e300, noise][(noise.abs() * 4.0) as usize % 4];
    match fault {
        1 => world.percept.workspace.iter_mut().for_each(|seen| seen.position.fill([bad; 3])),
        2 => world.percept.workspace.iter_mut().for_each(|seen| seen.orientation.fill([bad; 4])),
        3 => world.hand_at([bad; 3]),
        4 => world.sample.joints.position.fill(bad),
        5 => world.sample.joints.touch = bad,
        6 => world.percept.robot_holds.fill(noise + 0.5),
        7 => world.sample.joints.touch = if noise > 0.0 { 1.0 } else { 0.0 },
        _ => {}
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 6, failure_persistence: None, ..ProptestConfig::default() })]

    // The kinematic world holds the finite differences of every tick against all limits.
    #[test]
    fn no_input_breaks_the_limits(disorders in prop::collection::vec(disorder(), 10..40)) {
        let mut world = KinematicWorld::new();
        let nut = world.action(coact_joint_task::ActionType::Insert, "nut on the robot's side");
        world.decide(Some(nut));
        world.run(0.5);
        prop_assert!(world.used[0] > 0.1, "disorder begins in the middle of a movement");
        for Disorder { action, fault, cycles, noise } in disorders {
            world.decide(Some(action));
            for _ in 0..cycles {
                world.sense();
                garble(&mut world, fault, noise);
                let (sample, percept, frame) = (world.sample.clone(), world.percept.clone(), world.frame.clone());
                let lost = |which: u8| fault == which || (fault == 9 && noise > 0.0);
                world.step_with(
                    (!lost(8)).then_some(&*sample),
                    (fault != 3 || noise > 0.0).then_some(&*percept),
                    (!lost(9)).then_some(&*frame),
                );
            }
        }
        prop_assert!(world.command.position.iter().all(|angle| angle.is_finite()));
        prop_assert!(world.command.tracking_error.iter().all(|angle| angle.is_finite()));
    }
}

/// A word of the state, and what it becomes. Most words are knots of trajectories: the others are hit as often.
fn damage() -> impl Strategy<Value = (usize, u64)> {
    let word = prop_oneof![1_usize..1511, 710_usize..790, 1497_usize..1511];
    let bits = prop_oneof![any::<u64>(), 0_u64..5, any::<f64>().prop_map(f64::to_bits)];
    (word, bits)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, failure_persistence: None, ..ProptestConfig::default() })]

    // A refused state leaves the stage with its own.
    #[test]
    fn no_damaged_state_breaks_the_limits(damages in prop::collection::vec(damage(), 1..4)) {
        let mut world = KinematicWorld::new();
        world.decide(Some(world.action(coact_joint_task::ActionType::Insert, "nut on the robot's side")));
        world.run(0.4);
        for (word, bits) in damages {
            world.command.state[word] = f64::from_bits(bits);
            world.run(0.05);
        }
        prop_assert!(world.command.position.iter().all(|angle| angle.is_finite()));
    }
}

#[test]
fn decisions_that_change_every_few_cycles_keep_the_limits() {
    let mut world = KinematicWorld::new();
    let count = world.task.actions.len() as u32;
    let mut state = 12345u32;
    for tick in 0..10_000u32 {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        if state >> 24 < 3 {
            world.decide(Some((state >> 8) % (count + 3)));
        }
        if tick % 7001 == 0 {
            let place = world.task.scene.handover;
            world.hand_at(place);
        }
        world.step();
    }
    assert!(world.used[0] > 0.5, "it moved: {:?}", world.used);
}

/// Steps with messages frozen at the last cycle, for `cycles`.
fn freeze(world: &mut KinematicWorld, cycles: u32, sample: bool, frame: bool) -> Vec<(u32, f64)> {
    world.sense();
    let (old_sample, old_frame) = (world.sample.clone(), world.frame.clone());
    (0..cycles)
        .map(|_| {
            world.sense();
            let fresh: (Box<SensorSample>, _) = (world.sample.clone(), world.frame.clone());
            let percept = world.percept.clone();
            let sample = if sample { &old_sample } else { &fresh.0 };
            let frame = if frame { &old_frame } else { &fresh.1 };
            world.step_with(Some(sample), Some(&percept), Some(frame));
            let speed = world.command.velocity.iter().fold(0.0f64, |most, v| most.max(v.abs()));
            (world.command.phase, speed)
        })
        .collect()
}

#[test]
fn stale_input_brakes_within_the_limits_and_the_skill_goes_on_after() {
    for (sample, frame) in [(true, false), (false, true)] {
        let mut world = KinematicWorld::new();
        let nut = world.action(coact_joint_task::ActionType::Insert, "nut on the robot's side");
        world.decide(Some(nut));
        world.run(0.8);
        let frozen = freeze(&mut world, 600, sample, frame);
        let brakes = frozen.iter().position(|(phase, _)| *phase == MotionPhase::Brake as u32).unwrap();
        assert!((50..=52).contains(&brakes), "after {brakes} cycles");
        assert!(frozen[brakes].1 > 0.1, "it was moving");
        let stood = frozen.iter().position(|(_, speed)| *speed == 0.0).unwrap();
        assert!(stood < brakes + 400, "stood after {stood}");
        assert!(frozen[stood..].iter().all(|(_, speed)| *speed == 0.0));
        world.until(9.0, "taken", |world| world.held().is_some());
    }
}

/// A process that hears nothing any more goes on sending: its messages are new, what they tell is not.
#[test]
fn messages_of_now_that_descend_from_an_old_sample_brake() {
    for deaf in ["perception", "fields"] {
        let mut world = KinematicWorld::new();
        let nut = world.action(coact_joint_task::ActionType::Insert, "nut on the robot's side");
        world.decide(Some(nut));
        world.run(0.8);
        let heard_ns = world.tick * PERIOD_NS;
        let phases: Vec<_> = (0..60)
            .map(|_| {
                world.sense();
                world.sample.header.sensor_ns = world.tick * PERIOD_NS;
                let (sample, mut percept, mut frame) =
                    (world.sample.clone(), world.percept.clone(), world.frame.clone());
                for (name, header) in [("perception", &mut percept.header), ("fields", &mut frame.header)] {
                    header.sensor_ns = if name == deaf { heard_ns } else { sample.header.sensor_ns };
                }
                world.step_with(Some(&sample), Some(&percept), Some(&frame));
                world.command.phase
            })
            .collect();
        let brakes = phases.iter().position(|phase| *phase == MotionPhase::Brake as u32);
        assert!(brakes.is_some_and(|after| (49..=52).contains(&after)), "deaf {deaf}: {brakes:?}");
    }
}

#[test]
fn without_any_message_the_robot_stands() {
    let mut world = KinematicWorld::new();
    let start = world.command.position;
    for _ in 0..100 {
        world.step_with(None, None, None);
    }
    assert_eq!(world.phase(), MotionPhase::Brake);
    let moved = world.command.position.iter().zip(start).any(|(now, then)| (now - then).abs() > 1e-6);
    assert!(!moved);
}

#[test]
fn the_first_setpoints_are_the_measured_ones() {
    let mut world = KinematicWorld::new();
    world.sense();
    world.sample.joints.position[0] -= 0.1;
    let (sample, frame) = (world.sample.clone(), world.frame.clone());
    let mut command: Box<coact_messages::Command> = bytemuck::zeroed_box();
    world.control.step(1000, Some(&sample), None, Some(&frame), None, &mut command);
    assert_eq!(command.position, sample.joints.position);
    assert_eq!(command.tracking_error, [0.0; 15]);
}
