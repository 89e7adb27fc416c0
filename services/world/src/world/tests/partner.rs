use super::fake_robot::FakeRobot;
use super::{Out, world};
use coact_joint_task::Act;
use coact_messages::PartnerPhase;
use coact_period::CYCLES_PER_SECOND;
use coact_person::Holder;

/// Runs `seconds` with a helpful robot and calls `look` after each tick with the truth before and after.
fn run(seed: u64, seconds: u64, mut look: impl FnMut(u64, &super::World, &Out, &super::Truth)) -> u64 {
    let (mut world, mut robot, mut out) = (world(seed), FakeRobot::new(), Out::new());
    for tick in 1..=seconds * CYCLES_PER_SECOND {
        let before = *out.truth;
        robot.step(tick, &mut world, &mut out);
        look(tick, &world, &out, &before);
    }
    out.truth.assemblies
}

#[test]
fn team_completes_the_assembly_again_and_again_with_any_seed() {
    for seed in 0..6 {
        let assemblies = run(seed, 400, |_, _, _, _| {});
        assert!(assemblies >= 2, "seed {seed}: {assemblies} assemblies in 400 s");
    }
}

#[test]
fn person_begins_only_actions_that_the_plan_allows() {
    for seed in 20..32 {
        let mut begun = 0;
        run(seed, 120, |tick, world, out, before| {
            if out.truth.actions == before.actions {
                return;
            }
            begun += 1;
            let (chain, goal) = (&world.task.chains[out.truth.chain as usize], out.truth.subgoal as usize);
            let subgoal = &world.task.subgoals[goal];
            assert_eq!((chain.kind, chain.side), (subgoal.kind, subgoal.side), "seed {seed} tick {tick}");
            let achieved = |index: usize| before.achieved & (1 << index) != 0;
            assert!(
                !achieved(goal) && subgoal.after.iter().all(|index| achieved(*index)),
                "seed {seed} tick {tick}"
            );
        });
        assert!(begun >= 10, "seed {seed}: only {begun} actions in two minutes");
    }
}

#[test]
fn who_holds_which_part_is_told() {
    let mut moved_on = [0_u32; 2];
    run(7, 60, |tick, _, out, before| {
        for (who, held) in out.truth.held.into_iter().enumerate() {
            let parts = out.state.part[..out.state.parts as usize].iter().enumerate();
            let own = parts.filter(|(_, part)| part.state == who as u32 + 1);
            assert_eq!(held, own.fold(0, |mask, (part, _)| mask | 1 << part), "tick {tick}");
            assert!(held.count_ones() <= 1, "tick {tick}: a hand holds one part");
            moved_on[who] += u32::from(held != before.held[who]);
        }
    });
    assert!(moved_on.iter().all(|changes| *changes >= 6), "{moved_on:?}");
}

#[test]
fn every_kind_of_action_occurs() {
    let mut kinds = std::collections::BTreeSet::new();
    for seed in 40..44 {
        run(seed, 120, |_, world, out, before| {
            if out.truth.actions != before.actions {
                kinds.insert(world.task.chains[out.truth.chain as usize].name.clone());
            }
        });
    }
    let names: std::collections::BTreeSet<_> =
        super::task().chains.iter().map(|chain| chain.name.clone()).collect();
    assert_eq!(kinds, names);
}

#[test]
fn grasp_is_told_before_the_part_moves() {
    let mut grasps = 0;
    for seed in 50..54 {
        let mut last = Vec::new();
        run(seed, 120, |tick, world, out, before| {
            let parts: Vec<_> = world.parts.all().to_vec();
            for (part, old) in parts.iter().zip(&last) {
                let old: &coact_messages::PartState = old;
                let moved = part.position != old.position && part.state == Holder::Person as u32;
                if moved {
                    assert!(
                        out.truth.grasp_cycle > 0 && out.truth.grasp_cycle < tick,
                        "seed {seed} tick {tick}"
                    );
                }
            }
            last = parts;
            if out.truth.grasp_cycle != before.grasp_cycle && out.truth.grasp_cycle > 0 {
                grasps += 1;
                assert_eq!(out.truth.grasp_cycle, tick);
                assert_eq!(before.phase, PartnerPhase::Reach as u32);
            }
        });
    }
    assert!(grasps >= 40, "{grasps} grasps");
}

#[test]
fn gesture_is_answered_by_taking_what_is_given() {
    let mut taken = 0;
    for seed in 60..72 {
        let mut requested = false;
        run(seed, 120, |_, world, out, before| {
            if out.truth.actions == before.actions {
                return;
            }
            let gesture = matches!(world.task.chains[out.truth.chain as usize].act, Act::Gesture(_));
            taken += u32::from(
                requested
                    && !gesture
                    && world.simulation.person.activity() == coact_person::Activity::Receive,
            );
            requested = gesture;
        });
    }
    assert!(taken >= 3, "{taken} requests were answered");
}
