//! The partner whose hand stops in mid-reach, and goes on.

use super::fake_robot::FakeRobot;
use super::mid_reach::{goes_on_to_the_bit, nothing_tells_that_it_will};
use super::{Out, robot, task};
use crate::Partner;
use crate::world::World;
use coact_messages::Truth;
use coact_period::seconds;
use coact_person::ActivityPhase;
use coact_pipeline::WorldMode;
use glam::DVec3;

const ALWAYS: &str = "idle=0,goal=0,request=0,means=0,hidden=0,words=0,dropouts=0,hesitates=1";
const NEVER: &str = "idle=0,goal=0,request=0,means=0,hidden=0,words=0,dropouts=0,hesitates=0";
/// What a tick may change of the wrist's velocity, m/s: a reach of half a metre in 0.43 s and a hand that brakes from 2 m/s in 0.15 s
/// do 15 and 20 m/s² at the most.
const STEADY: f64 = 0.035;
/// A hand that is slower stands, m/s.
const STANDS: f64 = 1e-6;

fn world(seed: u64, settings: &str) -> World {
    let partner = Partner::load(&format!("random:{settings}"), &task(), seed).unwrap();
    World::new(&task(), &robot(), super::settings(seed, partner, WorldMode::Kinematic)).unwrap()
}

/// The cycle in which it began.
fn begun(truth: &Truth) -> u64 {
    truth.hesitation_cycle
}

#[test]
fn hand_stops_on_its_way_without_a_step_and_goes_on_to_the_same_part() {
    let (mut hesitated, mut grasped) = (0, 0);
    for seed in 0..2 {
        let (mut world, mut robot, mut out) = (world(seed, ALWAYS), FakeRobot::new(), Out::new());
        let (mut wrists, mut from, mut stood, mut part) = ([DVec3::ZERO; 3], DVec3::ZERO, Vec::new(), None);
        for tick in 1..=60_000 {
            robot.step(tick, &mut world, &mut out);
            let person = &world.simulation.person;
            wrists = [wrists[1], wrists[2], person.hand.wrist()];
            if person.phase() == ActivityPhase::Prepare {
                (from, stood) = (person.movement.from.wrist(), Vec::new());
            }
            let begun = person.hesitation.begun;
            if begun == tick {
                hesitated += 1;
                part = person.part.get();
            }
            if begun > 0 && person.phase() == ActivityPhase::Reach {
                let kick = (wrists[2] - 2.0 * wrists[1] + wrists[0]).length() * 1e3;
                assert!(kick < STEADY, "seed {seed}, tick {tick}: {kick} m/s in a tick");
                if (wrists[2] - wrists[1]).length() * 1e3 < STANDS {
                    let left = person.movement.to.wrist().distance(wrists[2]);
                    stood.push(wrists[2].distance(from) / (wrists[2].distance(from) + left));
                }
            }
            if begun > 0 && person.grasped == tick {
                grasped += 1;
                assert_eq!(person.part.get(), part);
                assert!((0.28..1.1).contains(&seconds(stood.len() as u64)), "{} ms", stood.len());
                assert!((0.2..0.8).contains(&stood[0]), "seed {seed}, tick {tick}: at {}", stood[0]);
                let centre = world.parts.view().centre(part.unwrap(), &world.task);
                assert!(centre.distance(world.person.hand_centre(person)) < 1e-6);
            }
        }
    }
    assert!(hesitated >= 5 && grasped * 10 >= hesitated * 9, "{hesitated} hesitated, {grasped} grasped");
}

#[test]
fn until_the_hand_stops_nothing_tells_that_it_will() {
    for seed in 0..3 {
        nothing_tells_that_it_will([world(seed, ALWAYS), world(seed, NEVER)], begun);
    }
}

#[test]
fn world_that_is_killed_while_the_hand_stands_goes_on_to_the_bit() {
    for late in [0, 1, 300, 700] {
        goes_on_to_the_bit([world(2, ALWAYS), world(2, ALWAYS)], late, begun);
    }
}
