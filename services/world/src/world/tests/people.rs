//! What people do is their own, whatever the robot takes them to do.

use super::fake_robot::FakeRobot;
use super::{Out, config, habits, robot, settings, task};
use crate::{Partner, Settings, World};
use bytemuck::bytes_of;
use coact_joint_task::Task;
use coact_messages::SensorSample;
use coact_person::Habits;
use coact_pipeline::WorldMode;

/// Goes on for at most so many ticks, until `is_over`.
fn live(world: &mut World, ticks: u64, mut is_over: impl FnMut(u64, &Out) -> bool) -> Out {
    let (mut robot, mut out) = (FakeRobot::new(), Out::new());
    for tick in 1..=ticks {
        robot.step(tick, world, &mut out);
        if is_over(tick, &out) {
            break;
        }
    }
    out
}

/// The sensor samples of 30 s, of a world that is made for this task.
fn seen(task: &Task) -> Vec<Box<SensorSample>> {
    let partner = Partner::load("random:goal=0.2,request=0.2", task, 3).unwrap();
    let mut world = World::new(task, &robot(), settings(3, partner, WorldMode::Kinematic)).unwrap();
    let mut seen = Vec::new();
    let out = live(&mut world, 30_000, |tick, out| {
        if tick % 10 == 0 {
            seen.push(out.sample.clone());
        }
        false
    });
    assert!(out.truth.actions > 2, "the person did nothing");
    seen
}

/// The pitch of a synthetic partner's hand at the first grasp, rad.
fn pitch_of_first_grasp(habits: Habits) -> f64 {
    let own = Settings { habits, ..settings(3, Partner::Synthetic, WorldMode::Kinematic) };
    let mut world = World::new(&task(), &robot(), own).unwrap();
    let out = live(&mut world, 10_000, |_, out| out.truth.grasp_cycle > 0);
    assert!(out.truth.grasp_cycle > 0, "nothing was grasped");
    world.simulation.person.hand.pitch
}

#[test]
fn what_the_robot_expects_of_grips_and_gestures_changes_nothing_of_how_people_move() {
    let expected = task();
    let mut other = expected.clone();
    other.grips.iter_mut().for_each(|grip| grip.pitch = -0.3 - grip.pitch);
    other.gestures.iter_mut().for_each(|gesture| gesture.pitch += 0.6);
    let same =
        seen(&expected).iter().zip(&seen(&other)).all(|(one, other)| bytes_of(&**one) == bytes_of(&**other));
    assert!(same, "the person's hand moves by what the task file says that the robot expects");
}

#[test]
fn other_habits_are_seen_at_the_hand() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("person.toml");
    let text = std::fs::read_to_string(config("person.toml")).unwrap();
    let text = text.replace("pitch = -70", "pitch = -52").replace("pitch = -14", "pitch = 4");
    std::fs::write(&file, text).unwrap();
    let other = Habits::load(&file, &task()).unwrap();
    let pitches = [habits(), other].map(pitch_of_first_grasp);
    assert!((pitches[1] - pitches[0] - 18_f64.to_radians()).abs() < 0.02, "{pitches:?}");
}
