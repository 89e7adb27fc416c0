//! The partner who changes the mind in mid-reach.

use super::fake_robot::FakeRobot;
use super::{Out, robot, task};
use crate::Partner;
use crate::world::World;
use bytemuck::bytes_of;
use coact_joint_task::Agent;
use coact_messages::PartnerError;
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

/// Steps until the hand has turned.
fn until_it_turns(world: &mut World, robot: &mut FakeRobot, out: &mut Out) -> u64 {
    for tick in 1..=120_000 {
        robot.step(tick, world, out);
        if out.truth.turn_cycle == tick {
            return tick;
        }
    }
    panic!("nobody changed the mind");
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
        until_it_turns(&mut world, &mut FakeRobot::new(), &mut Out::new());
        turned += u64::from(world.simulation.person.error == PartnerError::None);
    }
    assert_eq!(turned, 10);
}

#[test]
fn reach_turns_where_it_is_still_on_its_way() {
    for seed in 0..20 {
        let (mut world, mut robot, mut out) = (world(seed, ALWAYS), FakeRobot::new(), Out::new());
        until_it_turns(&mut world, &mut robot, &mut out);
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
        let [mut one, mut other] = [world(seed, ALWAYS), world(seed, NEVER)];
        let (mut robots, mut outs) = ([FakeRobot::new(), FakeRobot::new()], [Out::new(), Out::new()]);
        for tick in 1..=60_000 {
            robots[0].step(tick, &mut one, &mut outs[0]);
            robots[1].step(tick, &mut other, &mut outs[1]);
            if outs[0].truth.turn_cycle > 0 {
                break;
            }
            assert!(bytes_of(&*outs[0].sample) == bytes_of(&*outs[1].sample), "seed {seed}, tick {tick}");
            assert!(bytes_of(&*outs[0].truth) == bytes_of(&*outs[1].truth), "seed {seed}, tick {tick}");
        }
        assert!(outs[0].truth.turn_cycle > 0 && outs[1].truth.turn_cycle == 0, "seed {seed}");
    }
}

#[test]
fn world_that_is_killed_while_the_hand_turns_goes_on_to_the_bit() {
    for late in [0, 1, 150, 400] {
        let (mut first, mut hand, mut out) = (world(2, ALWAYS), FakeRobot::new(), Out::new());
        let begun = until_it_turns(&mut first, &mut hand, &mut out);
        for tick in begun + 1..=begun + late {
            hand.step(tick, &mut first, &mut out);
        }
        let (mut second, mut other) = (world(2, ALWAYS), Out::new());
        second.resume(&out.state).unwrap();
        for tick in begun + late + 1..=begun + 3000 {
            first.step(tick, None, &mut out.sample, &mut out.truth, &mut out.state);
            second.step(tick, None, &mut other.sample, &mut other.truth, &mut other.state);
            assert!(bytes_of(&*out.sample) == bytes_of(&*other.sample), "{late}, tick {tick}");
            assert!(bytes_of(&*out.state) == bytes_of(&*other.state), "{late}, tick {tick}");
        }
        assert!(out.truth.grasp_cycle > begun);
    }
}
