//! What people do is their own, whatever the robot takes them to do.

use super::{config, habits, robot, settings, swaying, task};
use crate::{Partner, World};
use bytemuck::{bytes_of, zeroed_box};
use coact_messages::{SensorSample, Truth, WorldState};
use coact_pipeline::WorldMode;

/// The sensor samples of 30 s, of a world that is made for this task.
fn seen(task: &coact_joint_task::Task) -> Vec<Box<SensorSample>> {
    let partner = Partner::load("random:goal=0.2,request=0.2", task, 3).unwrap();
    let mut world = World::new(task, &robot(), settings(3, partner, WorldMode::Kinematic)).unwrap();
    let (mut sample, mut truth, mut state): (Box<SensorSample>, Box<Truth>, Box<WorldState>) =
        (zeroed_box(), zeroed_box(), zeroed_box());
    let mut seen = Vec::new();
    for tick in 1..=30_000 {
        let command = swaying(tick, &sample);
        world.step(tick, command.as_deref(), &mut sample, &mut truth, &mut state);
        if tick % 10 == 0 {
            seen.push(sample.clone());
        }
    }
    assert!(truth.actions > 2, "the person did nothing");
    seen
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
    let (task, other) = (task(), tempfile::tempdir().unwrap());
    let file = other.path().join("person.toml");
    let text = std::fs::read_to_string(config("person.toml")).unwrap();
    let text = text.replace("pitch = -70", "pitch = -52").replace("pitch = -14", "pitch = 4");
    std::fs::write(&file, text).unwrap();
    let steep = habits();
    let flat = coact_person::Habits::load(&file, &task).unwrap();
    let worlds = [steep, flat].map(|habits| {
        let own = crate::Settings { habits, ..settings(3, Partner::Synthetic, WorldMode::Kinematic) };
        let mut world = World::new(&task, &robot(), own).unwrap();
        let (mut sample, mut truth, mut state): (Box<SensorSample>, Box<Truth>, Box<WorldState>) =
            (zeroed_box(), zeroed_box(), zeroed_box());
        for tick in 1..=10_000 {
            let command = swaying(tick, &sample);
            world.step(tick, command.as_deref(), &mut sample, &mut truth, &mut state);
            if truth.grasp_cycle > 0 {
                break;
            }
        }
        world.simulation.person.hand.pitch
    });
    assert!((worlds[1] - worlds[0] - 18_f64.to_radians()).abs() < 0.02, "{worlds:?}");
}
