//! How near robot and person came does not depend on when somebody looks.
#![allow(clippy::unwrap_used)]

use crate::shipped::settings;
use coact_lockstep::Lockstep;
use coact_messages::Command;
use coact_period::CYCLES_PER_SECOND;
use coact_pipeline::{RunSettings, WorldMode};
use coact_run_records::SeparationReport;

/// How long each assembly is watched, s: the first one has two handovers by then, with the next movement out of the second.
const WATCHED: u64 = 25;
/// How long after each other one looks who is held up, ticks: the monitor, of the ordinary class, is at times on a busy machine.
const HELD_UP: u64 = 200;

/// What two meters say that know the newest command of each tick, and of the last look.
fn measured(world: WorldMode) -> [SeparationReport; 2] {
    let mut stages = Lockstep::new(&RunSettings { world, ..settings(371, "random") }).unwrap();
    let [mut timely, mut late] = [0, 1].map(|_| stages.separation_meter().unwrap());
    let (mut seen, mut handovers, mut handed_over): (Box<Command>, _, _) = (stages.command.clone(), 0, 0);
    for _ in 0..WATCHED * CYCLES_PER_SECOND {
        let followed = stages.command.handover;
        stages.step();
        assert_eq!(stages.truth.handover, followed, "tick {}", stages.ticks());
        timely.tick(&stages.truth, &stages.command);
        late.tick(&stages.truth, &seen);
        handovers += u64::from(followed > handed_over);
        handed_over = followed;
        if stages.ticks().is_multiple_of(HELD_UP) {
            seen.clone_from(&stages.command);
        }
    }
    assert!(handovers >= 2, "{handovers} handovers");
    // Speeds of the arm are those of the newest command known.
    [timely, late].map(|meter| SeparationReport { held_back_ms: 0, stopped_ms: 0, ..meter.report().clone() })
}

#[test]
fn who_looks_late_measures_the_same_separation() {
    for world in [WorldMode::Kinematic, WorldMode::Physics] {
        let [timely, late] = measured(world);
        assert_eq!(timely, late, "{world:?}");
        assert_eq!(timely.robot_closing_ms, 0, "{world:?}: {timely:?}");
    }
}
