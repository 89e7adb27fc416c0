//! What the hand does while an action is preshaped, and not decided.
#![allow(clippy::unwrap_used)]

use crate::kinematic_world::KinematicWorld;
use coact_joint_task::ActionType;
use coact_messages::{LayerKind, MotionPhase, NONE};
use nalgebra::Point3;

const NUT: &str = "nut on the robot's side";
/// Resting level of the test's populations, and the activity of one that is nearly decided.
const RESTS: f64 = -3.0;
const NEARLY: f64 = -0.8;

/// The fields are at rest but for this action's population, which is short of its threshold.
fn preshape(world: &mut KinematicWorld, action: Option<u32>) {
    const SITES: usize = 10;
    let count = world.task.actions.len();
    let frame = &mut world.frame;
    (frame.layers.count, frame.layers.kind[0]) = (1, LayerKind::ActionExecution as u32);
    (frame.layers.sites[0], frame.layers.populations[0]) = ((SITES * count) as u32, count as u32);
    frame.activity[..SITES * count].fill(RESTS);
    frame.resting[..count].fill(RESTS);
    if let Some(action) = action {
        frame.activity[SITES * action as usize..SITES * (action as usize + 1)].fill(NEARLY);
    }
}

fn waits_above_the_nut() -> KinematicWorld {
    let mut world = KinematicWorld::new();
    world.run(0.05);
    let nut = world.action(ActionType::Insert, NUT);
    preshape(&mut world, Some(nut));
    world.until(4.0, "getting ready", |world| world.phase() == MotionPhase::Prepare);
    world.until(4.0, "ready", |world| world.phase() == MotionPhase::Rest);
    world
}

#[test]
fn the_hand_gets_ready_above_the_part_that_it_will_probably_take_and_names_no_action() {
    let world = waits_above_the_nut();
    let away = |part: &crate::kinematic_world::Part| {
        let above = part.frame.translation.vector.xy() - world.grasp_point().coords.xy();
        (above.norm(), world.grasp_point().z - part.frame.translation.z)
    };
    let nuts = world.parts.iter().filter(|part| world.task.kinds[part.kind].name == "nut").map(away);
    let (aside, above) = nuts.min_by(|one, other| one.0.total_cmp(&other.0)).unwrap();
    assert!(aside < 0.02 && (0.10..0.25).contains(&above), "{aside} m aside, {above} m above it");
    assert_eq!((world.command.action, world.command.handover, world.command.begun), (NONE, 0, 0));
    let phases: Vec<_> = world.phases.iter().map(|phase| phase.0).collect();
    assert_eq!(phases, [MotionPhase::Rest, MotionPhase::Prepare, MotionPhase::Rest]);
}

#[test]
fn what_was_prepared_is_done_sooner_when_it_is_decided() {
    let taken = |world: &mut KinematicWorld| {
        world.decide(Some(world.action(ActionType::Insert, NUT)));
        world.until(8.0, "grasping", |world| world.phase() == MotionPhase::Grasp)
    };
    let (ready, not) = (taken(&mut waits_above_the_nut()), {
        let mut world = KinematicWorld::new();
        world.run(0.05);
        taken(&mut world)
    });
    assert!(ready < 0.7 * not, "{ready} s when it was ready, {not} s from the park posture");
}

#[test]
fn another_decision_takes_the_hand_away_from_what_it_was_ready_for() {
    let mut world = waits_above_the_nut();
    world.decide(Some(world.action(ActionType::Steady, "wheel on the person's side")));
    world.until(4.0, "steadied", |world| world.phase() == MotionPhase::Dwell);
    assert!(world.away_from_base() < 1e-6);
    assert!(world.phases.iter().all(|phase| phase.0 != MotionPhase::Grasp));
}

#[test]
fn a_hand_that_is_ready_in_vain_parks_and_does_not_get_ready_for_the_same_again() {
    let mut world = waits_above_the_nut();
    let ready_at = world.grasp_point();
    world.until(8.0, "going away", |world| world.phase() == MotionPhase::Retreat);
    world.until(4.0, "parked", |world| world.phase() == MotionPhase::Rest);
    let parked = world.robot.grasp_point(&world.command.position);
    assert!((parked - ready_at).norm() > 0.1);
    world.run(3.0);
    assert_eq!((world.phase(), Point3::from(parked.coords)), (MotionPhase::Rest, world.grasp_point()));
}

#[test]
fn a_hand_is_not_ready_over_the_base_for_it_would_hide_what_is_done_there() {
    let mut world = KinematicWorld::new();
    world.run(0.05);
    let steady = world.action(ActionType::Steady, "wheel on the person's side");
    preshape(&mut world, Some(steady));
    world.run(3.0);
    assert_eq!(world.phases.iter().map(|phase| phase.0).collect::<Vec<_>>(), [MotionPhase::Rest]);
}
