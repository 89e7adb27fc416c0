//! What holds of everything that happens to a hand in mid-reach, whatever it is.

use super::Out;
use super::fake_robot::FakeRobot;
use crate::world::World;
use bytemuck::bytes_of;
use coact_messages::Truth;

/// Steps until it has begun: `begun` tells in which cycle.
pub fn until_begun(world: &mut World, robot: &mut FakeRobot, out: &mut Out, begun: fn(&Truth) -> u64) -> u64 {
    for tick in 1..=120_000 {
        robot.step(tick, world, out);
        if begun(&out.truth) == tick {
            return tick;
        }
    }
    panic!("it never happened");
}

/// Until it begins, a world in which it will and one in which it never does are equal to the bit.
pub fn nothing_tells_that_it_will([mut one, mut other]: [World; 2], begun: fn(&Truth) -> u64) {
    let (mut robots, mut outs) = ([FakeRobot::new(), FakeRobot::new()], [Out::new(), Out::new()]);
    for tick in 1..=60_000 {
        robots[0].step(tick, &mut one, &mut outs[0]);
        robots[1].step(tick, &mut other, &mut outs[1]);
        if begun(&outs[0].truth) > 0 {
            break;
        }
        assert!(bytes_of(&*outs[0].sample) == bytes_of(&*outs[1].sample), "tick {tick}");
        assert!(bytes_of(&*outs[0].truth) == bytes_of(&*outs[1].truth), "tick {tick}");
    }
    assert!(begun(&outs[0].truth) > 0 && begun(&outs[1].truth) == 0);
}

/// A world that is killed `late` cycles after it began, and one that takes over, go on to the bit.
pub fn goes_on_to_the_bit([mut first, mut second]: [World; 2], late: u64, begun: fn(&Truth) -> u64) {
    let (mut hand, mut out, mut other) = (FakeRobot::new(), Out::new(), Out::new());
    let began = until_begun(&mut first, &mut hand, &mut out, begun);
    for tick in began + 1..=began + late {
        hand.step(tick, &mut first, &mut out);
    }
    second.resume(&out.state).unwrap();
    for tick in began + late + 1..=began + 3000 {
        first.step(tick, None, &mut out.sample, &mut out.truth, &mut out.state);
        second.step(tick, None, &mut other.sample, &mut other.truth, &mut other.state);
        assert!(bytes_of(&*out.sample) == bytes_of(&*other.sample), "{late}, tick {tick}");
        assert!(bytes_of(&*out.state) == bytes_of(&*other.state), "{late}, tick {tick}");
    }
    assert!(out.truth.grasp_cycle > began);
}
