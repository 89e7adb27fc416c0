//! Who waited for whom, from hand-made truths and commands.

use crate::support::*;
use coact_messages::{Command, MotionPhase, PartnerPhase, Truth};
use coact_monitor::Waits;
use coact_run_records::{Event, WaitEvent, Waiting};

fn waits(who: Waiting, from_ms: u64, until_ms: u64) -> Event {
    Event::Wait(WaitEvent { who, from_ms, until_ms, subgoal: "lid".into() })
}

/// The person at the place of the lid.
fn at_place(cycle: u64, waiting: u32) -> Truth {
    let truth = acting(cycle, 1, MOUNT, LID, 100, 200);
    Truth { phase: PartnerPhase::Act as u32, waiting, ..truth }
}

#[test]
fn the_person_waits_until_the_base_is_steadied_and_the_robot_until_something_is_mounted() {
    let (mut found, mut events) = (Waits::new(&task()), Vec::new());
    let mut command: Box<Command> = bytemuck::zeroed_box();
    command.action = STEADY_LID as u32;
    for cycle in 0_u64..1000 {
        // The arm comes at 700; the person stands at the place from 400 on, takes the lid away at 750, and mounts it from 900 on.
        command.phase = if cycle < 700 { MotionPhase::Transport } else { MotionPhase::Dwell } as u32;
        let truth = match cycle {
            750..900 => acting(cycle, 1, MOUNT, LID, 100, 200),
            _ => at_place(cycle, u32::from((400..700).contains(&cycle))),
        };
        found.tick(&truth, &command, &mut events);
    }
    assert_eq!(events, [waits(Waiting::Person, 400, 700), waits(Waiting::Robot, 750, 900)]);
    command.phase = MotionPhase::Rest as u32;
    found.tick(&at_place(1000, 1), &command, &mut events);
    found.finish(&mut events);
    assert_eq!(events[2..], [waits(Waiting::Person, 1000, 1001)], "what lasts at the end counts up to there");
}
