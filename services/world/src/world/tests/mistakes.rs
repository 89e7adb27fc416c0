//! The random partner, who makes mistakes.

use super::fake_robot::FakeRobot;
use super::{Out, robot, task};
use crate::Partner;
use crate::world::World;
use bytemuck::bytes_of;
use coact_messages::{PartnerError, PartnerPhase, Truth};
use coact_period::CYCLES_PER_SECOND;
use coact_person::ActivityPhase;
use coact_pipeline::WorldMode;
use std::collections::BTreeMap;

fn world(seed: u64, settings: &str) -> World {
    let partner = Partner::load(&format!("random:{settings}"), &task(), seed).unwrap();
    World::new(&task(), &robot(), super::settings(seed, partner, WorldMode::Kinematic)).unwrap()
}

/// Runs with a helpful robot and calls `look` after each tick with the truth before and after.
pub(super) fn run(seed: u64, seconds: u64, settings: &str, mut look: impl FnMut(u64, &World, &Out, &Truth)) {
    let (mut world, mut robot, mut out) = (world(seed, settings), FakeRobot::new(), Out::new());
    for tick in 1..=seconds * CYCLES_PER_SECOND {
        let before = *out.truth;
        robot.step(tick, &mut world, &mut out);
        look(tick, &world, &out, &before);
    }
}

/// Actions of several people by their error.
fn errors(settings: &str) -> BTreeMap<u32, u64> {
    let mut counts = BTreeMap::new();
    for seed in 0..6 {
        run(seed, 200, settings, |_, _, out, before| {
            if out.truth.actions != before.actions {
                *counts.entry(out.truth.error).or_default() += 1;
            }
        });
    }
    counts
}

#[test]
fn a_partner_without_errors_does_nothing_wrong() {
    let counts = errors("goal=0,request=0,means=0");
    let [valid, all]: [u64; 2] =
        [counts.get(&(PartnerError::None as u32)).copied().unwrap_or(0), counts.values().sum()];
    // The robot may do in the meantime what the person is about to do.
    assert!(valid > 50 && all - valid <= all / 50, "{counts:?}");
}

#[test]
fn every_kind_of_error_occurs_when_it_is_asked_for() {
    let counts = errors("idle=0,goal=0.3,request=0.2,means=0.2");
    for error in [PartnerError::None, PartnerError::Early, PartnerError::Done, PartnerError::AtHand] {
        assert!(counts.contains_key(&(error as u32)), "{error:?} among {counts:?}");
    }
}

#[test]
fn wrongly_taken_part_is_never_mounted_and_put_back_where_it_lay() {
    let mut returned = 0;
    for seed in 0..6 {
        let (mut lay, mut phase) = (Vec::new(), ActivityPhase::Rest);
        run(seed, 150, "goal=0.5,request=0,means=0,movement=500..500", |tick, world, out, before| {
            let (person, last) =
                (&world.simulation.person, std::mem::replace(&mut phase, world.simulation.person.phase()));
            assert!(
                before.error == 0 || (last, phase) != (ActivityPhase::Mount, ActivityPhase::Withdraw),
                "seed {seed} tick {tick}"
            );
            if before.phase == PartnerPhase::Idle as u32 {
                lay = world.parts.all().to_vec();
            }
            if let (ActivityPhase::Return, ActivityPhase::Withdraw, Some(part)) =
                (last, phase, person.part.get())
            {
                let (from, to) = (lay[part].position, world.parts.all()[part].position);
                let moved = (0..2).map(|axis| (from[axis] - to[axis]).powi(2)).sum::<f64>().sqrt();
                assert!(moved < 0.01, "seed {seed} tick {tick}: {moved} m from where it lay");
                returned += u32::from(out.truth.error != 0);
            }
        });
    }
    assert!(returned >= 10, "{returned} parts were put back");
}

#[test]
fn error_is_noticed_one_to_three_seconds_after_the_grasp() {
    let mut noticed = 0;
    run(3, 400, "goal=0.5,request=0,means=0", |tick, world, out, before| {
        let turns_back = world.simulation.person.phase() == ActivityPhase::Return;
        if out.truth.error != 0
            && before.person_wait().is_within_action()
            && turns_back
            && out.truth.waiting == 0
        {
            let since = tick - out.truth.grasp_cycle;
            assert!((1000..=3001).contains(&since), "noticed after {since} ms");
            noticed += 1;
        }
    });
    assert!(noticed > 0);
}

#[test]
fn tracker_loses_the_hand_in_bursts_at_the_rate_that_is_given() {
    let longest_gap = |settings: &str| {
        let (mut frames, mut last, mut longest) = (0, 0, 0);
        run(1, 100, settings, |tick, _, out, _| {
            let captured = out.sample.hands[0].captured_cycle;
            if captured != last {
                (frames, last) = (frames + 1, captured);
            }
            longest = longest.max(tick - last.min(tick));
        });
        (frames, longest)
    };
    let (all, short) = longest_gap("dropouts=0");
    let (fewer, long) = longest_gap("dropouts=2");
    assert!(short < 120 && (150..=400).contains(&long), "{short} ms, {long} ms");
    assert!(fewer < all * 8 / 10, "{fewer} of {all} frames");
}

#[test]
fn movement_time_stays_within_its_range() {
    let mut reaches = 0;
    run(2, 200, "movement=600..700,request=0,means=0", |_, world, out, before| {
        let grasped = before.grasp_cycle == 0 && out.truth.grasp_cycle > 0;
        if grasped && world.simulation.person.part.get().is_some() {
            let time = out.truth.grasp_cycle - out.truth.onset_cycle;
            assert!((600..=700).contains(&time), "{time} ms");
            reaches += 1;
        }
    });
    assert!(reaches > 10, "{reaches}");
}

#[test]
fn same_seed_gives_the_same_person_also_after_a_restart() {
    let settings = "goal=0.4,hidden=0.2,words=0.2,dropouts=1";
    let (mut one, mut hand, mut out) = (world(4, settings), FakeRobot::new(), Out::new());
    let (mut other, mut other_hand, mut other_out) = (world(4, settings), FakeRobot::new(), Out::new());
    for tick in 1..=60_000 {
        hand.step(tick, &mut one, &mut out);
        other_hand.step(tick, &mut other, &mut other_out);
        assert!(bytes_of(&*out.state) == bytes_of(&*other_out.state), "tick {tick}");
        assert!(bytes_of(&*out.sample) == bytes_of(&*other_out.sample), "tick {tick}");
        if tick % 977 == 0 {
            other = world(4, settings);
            other.resume(&other_out.state).unwrap();
        }
    }
}
