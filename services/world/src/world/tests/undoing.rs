//! The partner who takes apart what was mounted.

use super::fake_robot::FakeRobot;
use super::{Out, robot, task};
use crate::Partner;
use crate::world::World;
use coact_joint_task::Agent;
use coact_messages::{NONE, PartnerPhase};
use coact_person::{Activity, Holder};
use coact_pipeline::WorldMode;

const OFTEN: &str = "idle=0,goal=0,request=0,means=0,hidden=0,words=0,dropouts=0,undoes=0.3";

fn world(seed: u64) -> World {
    let partner = Partner::load(&format!("random:{OFTEN}"), &task(), seed).unwrap();
    World::new(&task(), &robot(), super::settings(seed, partner, WorldMode::Kinematic)).unwrap()
}

/// Whether every achieved subgoal still has all that comes before it.
fn is_whole(world: &World, achieved: u64) -> bool {
    let is_achieved = |goal: usize| achieved & (1 << goal) != 0;
    let goals = world.task.subgoals.iter().enumerate();
    goals
        .filter(|(index, _)| is_achieved(*index))
        .all(|(_, goal)| goal.after.iter().all(|own| is_achieved(*own)))
}

#[test]
fn what_is_undone_is_her_own_last_step_and_lies_free_on_her_side_and_the_assembly_is_completed() {
    let (mut undone, mut assemblies) = (0, 0);
    for seed in 0..2 {
        let (mut world, mut robot, mut out) = (world(seed), FakeRobot::new(), Out::new());
        let mut taken = None;
        for tick in 1..=120_000 {
            let before = *out.truth;
            robot.step(tick, &mut world, &mut out);
            let person = &world.simulation.person;
            let acts = out.truth.phase != PartnerPhase::Idle as u32;
            if acts && person.activity() == Activity::Undo {
                assert_eq!((out.truth.chain, out.truth.subgoal, out.truth.error), (NONE, NONE, 0));
            }
            if out.truth.assemblies == before.assemblies && before.achieved & !out.truth.achieved != 0 {
                let goal = (before.achieved & !out.truth.achieved).trailing_zeros() as usize;
                assert_eq!(world.task.subgoals[goal].side, Agent::Person, "seed {seed}, tick {tick}");
                assert!(!is_whole(&world, before.achieved) || is_whole(&world, out.truth.achieved));
                taken = person.held.get();
                undone += 1;
            }
            if let Some(part) = taken.filter(|part| world.parts.is(*part, Holder::Nobody)) {
                let ([low, high], at) =
                    (task().scene.workspace[Agent::Person.index()], world.parts.position(part));
                assert!((0..2).all(|axis| (low[axis]..=high[axis]).contains(&at[axis])), "{at}");
                let others = (0..world.task.parts.len()).filter(|other| *other != part);
                let nearest = others.map(|other| world.parts.position(other).distance(at));
                assert!(nearest.fold(f64::INFINITY, f64::min) > 0.09);
                taken = None;
            }
        }
        assemblies += out.truth.assemblies;
    }
    assert!(undone >= 3 && assemblies >= 2, "{undone} undone, {assemblies} assemblies");
}
