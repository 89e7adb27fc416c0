use super::fake_robot::FakeRobot;
use super::script::scenario;
use super::{Out, swaying, world};
use crate::ResumeError;
use crate::simulation_state::SimulationState;
use bytemuck::bytes_of;
use coact_messages::WorldState;
use coact_stage_state::StageState;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

#[test]
fn same_seed_gives_the_same_bits_and_another_seed_does_not() {
    let run = |seed: u64| {
        let (mut world, mut out) = (world(seed), Out::new());
        let mut samples = Vec::new();
        for tick in 1..=20_000 {
            let command = swaying(tick, &out.sample);
            world.step(tick, command.as_deref(), &mut out.sample, &mut out.truth, &mut out.state);
            if tick % 500 == 0 {
                samples.extend_from_slice(bytes_of(&*out.sample));
                samples.extend_from_slice(bytes_of(&*out.truth));
                samples.extend_from_slice(bytes_of(&*out.state));
            }
        }
        samples
    };
    let first = run(7);
    assert!(first == run(7));
    assert!(first != run(8));
}

#[test]
fn resumed_world_goes_on_as_if_it_had_not_died() {
    for killed_at in [1, 1700, 5003, 9999, 14_321] {
        let (mut world, mut out, mut other_out) = (world(3), Out::new(), Out::new());
        let mut other = super::world(3);
        for tick in 1..=killed_at + 4000 {
            let command = swaying(tick, &out.sample);
            world.step(tick, command.as_deref(), &mut out.sample, &mut out.truth, &mut out.state);
            if tick == killed_at {
                other.resume(&out.state).unwrap();
            }
            if tick > killed_at {
                other.step(
                    tick,
                    command.as_deref(),
                    &mut other_out.sample,
                    &mut other_out.truth,
                    &mut other_out.state,
                );
                assert!(bytes_of(&*out.sample) == bytes_of(&*other_out.sample), "{killed_at}, tick {tick}");
                assert!(bytes_of(&*out.truth) == bytes_of(&*other_out.truth), "{killed_at}, tick {tick}");
                assert!(bytes_of(&*out.state) == bytes_of(&*other_out.state), "{killed_at}, tick {tick}");
            }
        }
    }
}

#[test]
fn a_world_that_is_killed_over_and_over_still_finishes_its_assemblies() {
    let (mut world, mut robot, mut out) = (super::world(5), FakeRobot::new(), Out::new());
    for tick in 1..=300_000 {
        robot.step(tick, &mut world, &mut out);
        if tick % 777 == 0 {
            world = super::world(5);
            world.resume(&out.state).unwrap();
        }
    }
    assert!(out.truth.assemblies >= 1);
}

#[test]
fn state_of_another_task_is_not_resumed_from() {
    let (mut world, mut out) = (world(1), Out::new());
    world.step(1, None, &mut out.sample, &mut out.truth, &mut out.state);
    let mut foreign = out.state.clone();
    foreign.task ^= 1;
    foreign.part[0].position = [9.0; 3];
    assert!(matches!(world.resume(&foreign), Err(ResumeError::OtherTask { .. })));
    world.step(2, None, &mut out.sample, &mut out.truth, &mut out.state);
    assert!(out.state.part[0].position[0] < 9.0);
}

#[test]
fn damaged_state_is_refused_with_a_reason_and_leaves_the_world_as_it_was() {
    let (mut first, mut out) = (world(1), Out::new());
    for tick in 1..=5000 {
        first.step(tick, None, &mut out.sample, &mut out.truth, &mut out.state);
    }
    let good = out.state.clone();
    type Damage = fn(&mut WorldState);
    let damages: [(&str, Damage); 6] = [
        ("no state of world", |state| state.state[0] = 0.0),
        ("no value", |state| state.state[2] = f64::from_bits(7)),
        ("joints", |state| state.position[3] = f64::NAN),
        ("part.kind", |state| state.part[0].kind = 77),
        ("part.state", |state| state.part[1].state = 9),
        ("part: place", |state| state.part[2].position[1] = f64::INFINITY),
    ];
    for (expected, damage) in damages {
        let mut state = good.clone();
        damage(&mut state);
        let mut successor = world(1);
        let reason = successor.resume(&state).unwrap_err().to_string();
        assert!(reason.contains(expected), "{expected}: {reason}");
        assert_eq!(successor.simulation.tick, 0);
    }
}

#[test]
fn no_damage_of_a_state_makes_the_resumed_world_panic() {
    let (mut first, mut hand, mut out) = (world(5), FakeRobot::new(), Out::new());
    let mut random = Pcg64Mcg::seed_from_u64(1);
    let (mut refused, mut taken) = (0, 0);
    for tick in 1..=60_000 {
        hand.step(tick, &mut first, &mut out);
        if tick % 100 != 0 {
            continue;
        }
        let mut state = out.state.clone();
        let word = random.random_range(0..200);
        let value = [0, 1, 99, 1 << 40, u64::MAX, f64::NAN.to_bits(), 1e3_f64.to_bits()];
        state.state[word] = f64::from_bits(value[random.random_range(0..value.len())]);
        // By its checksum every damage is found; this is about what stands behind it.
        SimulationState::seal(&mut state.state);
        let (mut successor, mut own) = (world(5), Out::new());
        if successor.resume(&state).is_err() {
            refused += 1;
            continue;
        }
        taken += 1;
        for next in tick + 1..tick + 30 {
            FakeRobot::new().step(next, &mut successor, &mut own);
        }
    }
    assert!(refused > 50 && taken > 50, "{refused} states were refused, {taken} were taken");
}

#[test]
fn a_world_is_resumed_at_any_tick_of_every_kind_of_scenario() {
    for file in ["proactive.toml", "occlusion.toml", "errors-and-requests.toml", "words.toml"] {
        let (mut world, mut successor, mut out) = (scenario(file), scenario(file), Out::new());
        for tick in 1..=20_000 {
            world.step(tick, None, &mut out.sample, &mut out.truth, &mut out.state);
            if tick % 50 == 0 {
                successor.resume(&out.state).unwrap();
            }
        }
    }
}
