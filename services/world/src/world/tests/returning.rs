//! The partner who puts back what was just taken.

use super::fake_robot::FakeRobot;
use super::{Out, robot, task};
use crate::Partner;
use crate::world::World;
use coact_person::{ActivityPhase, Holder};
use coact_pipeline::WorldMode;
use glam::DVec3;

const OFTEN: &str = "idle=0,goal=0,request=0,means=0,hidden=0,words=0,dropouts=0,withdraws=0,returns=0.5";

fn world(seed: u64) -> World {
    let partner = Partner::load(&format!("random:{OFTEN}"), &task(), seed).unwrap();
    World::new(&task(), &robot(), super::settings(seed, partner, WorldMode::Kinematic)).unwrap()
}

#[test]
fn part_that_is_put_back_lies_where_it_lay_and_the_assembly_is_completed() {
    let (mut returned, mut grasps, mut assemblies) = (0, 0, 0);
    for seed in 0..2 {
        let (mut world, mut robot, mut out) = (world(seed), FakeRobot::new(), Out::new());
        let mut lay = None;
        for tick in 1..=60_000 {
            let before = world.simulation.person;
            let places: Vec<DVec3> =
                (0..world.task.parts.len()).map(|part| world.parts.position(part)).collect();
            robot.step(tick, &mut world, &mut out);
            let person = &world.simulation.person;
            if let Some(part) = person.part.get().filter(|_| person.grasped == tick) {
                grasps += 1;
                lay = world.parts.is(part, Holder::Person).then_some((part, places[part]));
            }
            if before.phase() == ActivityPhase::Return && person.phase() == ActivityPhase::Withdraw {
                let (part, place) = lay.unwrap();
                assert!(world.parts.position(part).distance(place) < 1e-3, "seed {seed}, tick {tick}");
                assert!(world.parts.is(part, Holder::Nobody));
                returned += 1;
            }
        }
        assemblies += out.truth.assemblies;
    }
    assert!(returned >= 5 && returned * 3 < grasps * 2, "{returned} of {grasps}");
    assert!(assemblies >= 1, "{assemblies} assemblies");
}
