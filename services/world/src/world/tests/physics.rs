use super::{Out, config, held_by, onwards, robot};
use crate::{Partner, World};
use coact_joint_task::Task;
use coact_messages::{ARM_JOINTS, Command, JOINTS};
use coact_period::seconds;
use coact_person::Holder;
use coact_pipeline::WorldMode;

/// The coupling of finger tips and bases of the shipped hand.
const COUPLING: f64 = 1.0 / 3.0;

fn scene() -> Task {
    Task::load(&config("tasks/toy-vehicle.toml")).unwrap()
}

fn world(seed: u64) -> World {
    let settings = super::settings(seed, Partner::Synthetic, WorldMode::Physics);
    World::new(&scene(), &robot(), settings).unwrap()
}

/// A smooth sway of every arm joint about the park posture, with the fingers half closed.
fn sway(tick: u64, out: &Out) -> Option<Box<Command>> {
    onwards(tick, &out.sample, |tick| {
        let time = seconds(tick);
        // Whatever it begins with, it begins at rest.
        let begun = (time / 2.0).min(1.0);
        let begun = begun.powi(3) * (10.0 - 15.0 * begun + 6.0 * begun * begun);
        let mut course = [0.0; JOINTS];
        for (joint, angle) in course[..ARM_JOINTS].iter_mut().enumerate() {
            let rate = 1.0 + 0.1 * joint as f64;
            *angle = begun * 0.1 * (1.0 - (rate * time).cos());
        }
        course[8..11].fill(begun * 0.5);
        course[11..14].fill(begun * 0.5 * COUPLING);
        course
    })
}

#[test]
fn parts_rest_where_they_lie_and_nothing_becomes_nan() {
    let (mut world, mut out) = (world(1), Out::new());
    let start = *world.parts.row();
    for tick in 1..=20_000 {
        let command = sway(tick, &out);
        world.step(tick, command.as_deref(), &mut out.sample, &mut out.truth, &mut out.state);
        assert!(out.sample.joints.position.iter().all(|angle| angle.is_finite()), "tick {tick}");
    }
    let loose = held_by(&world, Holder::Nobody);
    assert!(!loose.is_empty());
    for part in loose {
        let (now, then) = (out.state.part[part].position, start[part].position);
        let moved = glam::DVec3::from(now).distance(then.into());
        assert!(moved < 0.005, "part {part} moved by {moved} m");
    }
}

#[test]
fn joints_follow_their_setpoints_closely() {
    let (mut world, mut out) = (world(1), Out::new());
    let mut worst: f64 = 0.0;
    for tick in 1..=5000 {
        let command = sway(tick, &out);
        world.step(tick, command.as_deref(), &mut out.sample, &mut out.truth, &mut out.state);
        for joint in 0..7 {
            worst = worst.max((out.sample.joints.position[joint] - out.sample.drive.position[joint]).abs());
        }
    }
    assert!(worst < 0.002, "tracking error {worst} rad");
    assert!((out.sample.joints.position[8] - 0.5).abs() < 0.01);
}

#[test]
fn same_seed_gives_the_same_bits() {
    let run = || {
        let (mut world, mut out) = (world(4), Out::new());
        for tick in 1..=8000 {
            let command = sway(tick, &out);
            world.step(tick, command.as_deref(), &mut out.sample, &mut out.truth, &mut out.state);
        }
        bytemuck::bytes_of(&*out.state).to_vec()
    };
    assert!(run() == run());
}

#[test]
fn resumed_parts_and_joints_stay_where_they_were() {
    let (mut world, mut out) = (world(6), Out::new());
    for tick in 1..=9000 {
        let command = sway(tick, &out);
        world.step(tick, command.as_deref(), &mut out.sample, &mut out.truth, &mut out.state);
    }
    let before = out.state.clone();
    let mut successor = self::world(6);
    successor.resume(&before).unwrap();
    let command = sway(9001, &out);
    successor.step(9001, command.as_deref(), &mut out.sample, &mut out.truth, &mut out.state);
    for part in 0..before.parts as usize {
        let (now, then) = (out.state.part[part], before.part[part]);
        assert!(glam::DVec3::from(now.position).distance(then.position.into()) < 0.005, "part {part}");
        assert_eq!(now.state, then.state);
    }
    for joint in 0..14 {
        assert!((out.state.position[joint] - before.position[joint]).abs() < 0.005, "joint {joint}");
    }
    assert_eq!(out.truth.actions, u32::try_from(successor.simulation.person.actions).unwrap());
}

#[test]
fn dropped_part_falls_onto_the_table() {
    let (mut world, mut out) = (world(1), Out::new());
    let at = world.parts.position(0) + glam::DVec3::new(0.0, 0.0, 0.15);
    let turn = world.parts.orientation(0);
    world.parts.place(0, at, turn);
    for tick in 1..=1000 {
        world.step(tick, None, &mut out.sample, &mut out.truth, &mut out.state);
    }
    let height = out.state.part[0].position[2];
    assert!((height - world.task.scene.table_height).abs() < 0.005, "part at {height} m");
}

#[test]
fn overlapping_parts_are_refused() {
    let mut task = scene();
    task.parts[1].at = task.parts[0].at;
    let settings = super::settings(0, Partner::Synthetic, WorldMode::Physics);
    let message = World::new(&task, &robot(), settings).err().unwrap().to_string();
    assert!(message.contains("overlap"), "{message}");
}

#[test]
fn arm_holds_still_without_a_command() {
    let (mut world, mut out) = (world(1), Out::new());
    for tick in 1..=2000 {
        world.step(tick, None, &mut out.sample, &mut out.truth, &mut out.state);
    }
    for (joint, park) in robot().park.iter().enumerate() {
        assert!((out.state.position[joint] - park).abs() < 1e-3, "joint {joint}");
    }
}
