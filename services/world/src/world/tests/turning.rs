//! The partner who changes the mind in mid-reach.

use super::fake_robot::FakeRobot;
use super::mid_reach::{goes_on_to_the_bit, nothing_tells_that_it_will, until_begun};
use super::{Out, robot, task};
use crate::Partner;
use crate::world::World;
use coact_joint_task::Agent;
use coact_messages::{PartnerError, Truth};
use coact_person::ActivityPhase;
use coact_pipeline::WorldMode;
use glam::DVec3;

const ALWAYS: &str = "idle=0,goal=0,request=0,means=0,hidden=0,words=0,dropouts=0,changes=1";
const NEVER: &str = "idle=0,goal=0,request=0,means=0,hidden=0,words=0,dropouts=0,changes=0";
/// What a tick may change of the wrist's velocity, m/s: the accelerations of two movements of minimum jerk at their greatest, over
/// half a metre in 0.5 s each, are 23 m/s² together.
const STEADY: f64 = 0.025;

fn world(seed: u64, settings: &str) -> World {
    let partner = Partner::load(&format!("random:{settings}"), &task(), seed).unwrap();
    World::new(&task(), &robot(), super::settings(seed, partner, WorldMode::Kinematic)).unwrap()
}

/// The cycle in which it began.
fn begun(truth: &Truth) -> u64 {
    truth.turn_cycle
}

#[test]
fn hand_that_turns_goes_on_without_a_step_and_grasps_the_new_part() {
    let (mut turned, mut grasped) = (0, 0);
    for seed in 0..4 {
        let (mut world, mut robot, mut out) = (world(seed, ALWAYS), FakeRobot::new(), Out::new());
        let mut wrists = [DVec3::ZERO; 3];
        for tick in 1..=120_000 {
            let (before, part) = (*out.truth, world.simulation.person.part);
            robot.step(tick, &mut world, &mut out);
            let person = &world.simulation.person;
            wrists = [wrists[1], wrists[2], person.hand.wrist()];
            let is_turned = person.turn.begun > 0 && person.phase() == ActivityPhase::Reach;
            if is_turned {
                let kick = (wrists[2] - 2.0 * wrists[1] + wrists[0]).length() * 1e3;
                assert!(kick < STEADY, "seed {seed}, tick {tick}: {kick} m/s in a tick");
            }
            if out.truth.turn_cycle == tick {
                turned += 1;
                assert_eq!(out.truth.actions, before.actions, "it is the same reach");
                assert_ne!((out.truth.chain, out.truth.subgoal), (before.chain, before.subgoal));
                assert_ne!(person.part, part);
            }
            if person.turn.begun > 0 && person.grasped == tick {
                grasped += 1;
                let part = person.part.get().unwrap();
                let missed =
                    world.parts.view().centre(part, &world.task).distance(world.person.hand_centre(person));
                assert!(missed < 1e-6, "closed {missed} m beside the part");
                let width = world.task.kinds[world.parts.kind(part)].width;
                assert!((person.hand.aperture - width - coact_person::FINGERS).abs() < 1e-9);
                assert!(out.truth.heading_cycle >= out.truth.turn_cycle, "{:?}", person.turn);
            }
        }
    }
    assert!(turned >= 20 && grasped * 10 >= turned * 9, "{turned} turned, {grasped} of them grasped");
}

#[test]
fn who_could_as_well_take_something_else_turns_to_nothing_wrong() {
    let mut task = task();
    task.subgoals.iter_mut().for_each(|goal| goal.after.clear());
    let mut turned = 0;
    for seed in 0..10 {
        let partner = Partner::load(&format!("random:{ALWAYS}"), &task, seed).unwrap();
        let settings = super::settings(seed, partner, WorldMode::Kinematic);
        let mut world = World::new(&task, &robot(), settings).unwrap();
        until_begun(&mut world, &mut FakeRobot::new(), &mut Out::new(), begun);
        turned += u64::from(world.simulation.person.error == PartnerError::None);
    }
    assert_eq!(turned, 10);
}

#[test]
fn reach_turns_where_it_is_still_on_its_way() {
    for seed in 0..20 {
        let (mut world, mut robot, mut out) = (world(seed, ALWAYS), FakeRobot::new(), Out::new());
        until_begun(&mut world, &mut robot, &mut out, begun);
        let person = &world.simulation.person;
        let (from, second) = (person.hand.wrist(), &person.movement);
        // The second movement begins where the first one would end.
        let left = second.from.wrist().distance(from);
        let resting = DVec3::from(world.task.scene.person_rest);
        let covered = from.distance(resting) / (from.distance(resting) + left);
        assert!((0.2..0.93).contains(&covered), "seed {seed}: {covered} of the way");
        assert!(world.task.parts[person.part.get().unwrap()].workspace == Agent::Person);
    }
}

#[test]
fn until_the_hand_turns_nothing_tells_that_it_will() {
    for seed in 0..3 {
        nothing_tells_that_it_will([world(seed, ALWAYS), world(seed, NEVER)], begun);
    }
}

#[test]
fn world_that_is_killed_while_the_hand_turns_goes_on_to_the_bit() {
    for late in [0, 1, 150, 400] {
        goes_on_to_the_bit([world(2, ALWAYS), world(2, ALWAYS)], late, begun);
    }
}
