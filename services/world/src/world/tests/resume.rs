use super::fake_robot::FakeRobot;
use super::{Out, robot, swaying, world};
use bytemuck::bytes_of;

#[test]
fn same_seed_gives_the_same_bits_and_another_seed_does_not() {
    let robot = robot();
    let run = |seed: u64| {
        let (mut world, mut out) = (world(seed), Out::new());
        let mut samples = Vec::new();
        for tick in 1..=20_000 {
            let command = swaying(tick, &robot);
            world.step(tick, Some(&command), &mut out.sample, &mut out.truth, &mut out.state);
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
    let robot = robot();
    for killed_at in [1, 1700, 5003, 9999, 14_321] {
        let (mut world, mut out, mut other_out) = (world(3), Out::new(), Out::new());
        let mut other = super::world(3);
        for tick in 1..=killed_at + 4000 {
            let command = swaying(tick, &robot);
            world.step(tick, Some(&command), &mut out.sample, &mut out.truth, &mut out.state);
            if tick == killed_at {
                other.resume(&out.state);
            }
            if tick > killed_at {
                other.step(
                    tick,
                    Some(&command),
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
            world.resume(&out.state);
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
    world.resume(&foreign);
    world.step(2, None, &mut out.sample, &mut out.truth, &mut out.state);
    assert!(out.state.part[0].position[0] < 9.0);
}
