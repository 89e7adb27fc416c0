//! Who did what, from hand-made truths and commands.

use crate::support::*;
use coact_messages::{Command, MotionPhase, PartnerPhase, PersonWait, Truth};
use coact_monitor::Timeline;
use coact_run_records::{Occupation, TimelineSpan, Waiting};

fn span(who: Waiting, occupation: Occupation, what: &str, from_ms: u64, until_ms: u64) -> TimelineSpan {
    TimelineSpan { who, occupation, what: what.into(), from_ms, until_ms }
}

#[test]
fn spans_of_each_follow_each_other_without_a_gap_and_say_what_for() {
    let (mut timeline, mut spans) = (Timeline::new(&task()), Vec::new());
    let mut command: Box<Command> = bytemuck::zeroed_box();
    (command.action, command.speed_override) = (STEADY_LID as u32, 1.0);
    for cycle in 0_u64..1000 {
        // The arm is held back from 500 to 600 and comes at 700; the person stands at the place from 400 on and mounts from 700 on.
        command.phase = if cycle < 700 { MotionPhase::Reach } else { MotionPhase::Dwell } as u32;
        command.speed_override = if (500..600).contains(&cycle) { 0.4 } else { 1.0 };
        command.velocity[0] = if cycle < 700 { 0.5 } else { 0.0 };
        let acting = acting(cycle, 1, MOUNT, LID, 100, 200);
        let waiting = if (400..700).contains(&cycle) { PersonWait::Steadying } else { PersonWait::Nothing };
        let phase = if cycle < 400 { PartnerPhase::Transport } else { PartnerPhase::Act };
        let truth = Truth { phase: phase as u32, waiting: waiting as u32, ..acting };
        timeline.tick(&truth, &command, &mut spans);
    }
    timeline.finish(1000, &mut spans);
    let of = |who: Waiting| spans.iter().filter(move |span| span.who == who).cloned().collect::<Vec<_>>();
    let steady = &task().actions[STEADY_LID].name;
    let robot = [
        (Occupation::Reaches, 0, 500),
        (Occupation::HeldBack, 500, 600),
        (Occupation::Reaches, 600, 700),
        (Occupation::Steadies, 700, 1000),
    ];
    assert_eq!(
        of(Waiting::Robot),
        robot.map(|(what, from, until)| span(Waiting::Robot, what, steady, from, until))
    );
    let meaning = format!("{}: {}", task().chains[MOUNT as usize].name, task().subgoals[LID as usize].name);
    let person = [
        (Occupation::Carries, 0, 400),
        (Occupation::WaitsForSteadying, 400, 700),
        (Occupation::Handles, 700, 1000),
    ];
    assert_eq!(
        of(Waiting::Person),
        person.map(|(what, from, until)| span(Waiting::Person, what, &meaning, from, until))
    );
}
