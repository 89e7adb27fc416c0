use crate::{Cell, FaultKind, MessageFault, Moment, Target};
use coact_messages::Refusal;
use coact_supervisor::Fault;
use std::collections::{BTreeMap, BTreeSet};

/// The processes that send a pulse in each cycle, in their order.
pub(crate) const CHAIN: [&str; 4] = ["world", "perception", "fields", "control"];
/// The others.
const BESIDE: [&str; 2] = ["monitor", "voice"];
/// While the robot works.
const WORKING: [Moment; 4] = [Moment::Idle, Moment::Moving, Moment::Grasping, Moment::HandingOver];
/// What can be done to a process before it listens, and while it ends.
const BY_SIGNAL: [Fault; 3] = [Fault::Kill, Fault::Abort, Fault::StopForGood];
/// Cells of one run at most: each moment comes some four times within two minutes. Chosen by hand: the more, the more is to be
/// repeated when one of them is not green.
const CELLS_OF_A_RUN: usize = 16;
/// So often one process may have to be restarted in a run: the restart policy allows five times in 30 s.
const RESTARTS_OF_A_RUN: usize = 4;

/// What the issue of faults knows and no cell does yet, with the reason.
pub const NOT_COVERED: [(&str, &str); 1] =
    [("poisoned resume of world", "the simulated body would begin at its start, where no real one is")];

/// Every cell.
pub fn whole() -> Vec<Cell> {
    let nothing = |moment| Cell { fault: FaultKind::Nothing, target: Target::Set, moment };
    let mut cells: Vec<_> = WORKING.map(nothing).into();
    let processes = || CHAIN.into_iter().chain(BESIDE);
    for fault in Fault::ALL {
        for process in processes().filter(|process| applies(fault, process)) {
            let moments = if fault == Fault::CrashLoop { &[Moment::Moving][..] } else { &WORKING };
            cells.extend(moments.iter().map(|moment| cell(fault, Target::Process(process), *moment)));
        }
    }
    for (fault, moment) in
        BY_SIGNAL.into_iter().flat_map(|fault| [(fault, Moment::StartUp), (fault, Moment::Shutdown)])
    {
        cells.extend(processes().map(|process| cell(fault, Target::Process(process), moment)));
    }
    for fault in [Fault::Kill, Fault::StopForGood] {
        for two in [Target::Two("fields", "control"), Target::Two("world", "perception")] {
            cells.extend([Moment::Idle, Moment::Moving].map(|moment| cell(fault, two.clone(), moment)));
        }
    }
    for fault in [Fault::Kill, Fault::Abort, Fault::Stop, Fault::StopShort] {
        cells.extend(WORKING.map(|moment| cell(fault, Target::Supervisor, moment)));
    }
    let adoption = |moment| Cell { fault: FaultKind::Adoption, target: Target::Supervisor, moment };
    cells.extend(WORKING.map(adoption));
    for (writer, reader) in
        [("world", "perception"), ("perception", "fields"), ("fields", "control"), ("control", "world")]
    {
        // Both must be connected to the other's replacement.
        for (starved, killed) in [(reader, writer), (writer, reader)] {
            cells.push(cell(Fault::NoHandles, Target::Two(starved, killed), Moment::Moving));
        }
    }
    cells.push(cell(Fault::NoHandles, Target::Supervisor, Moment::Moving));
    for fault in MessageFault::ALL {
        for process in CHAIN {
            let fault = FaultKind::Message(fault);
            let cell = |moment| Cell { fault, target: Target::Process(process), moment };
            cells.extend([Moment::Idle, Moment::Moving].map(cell));
        }
    }
    for process in ["fields", "control", "perception", "voice"] {
        let target = Target::Process(process);
        cells.push(Cell { fault: FaultKind::ViewerFlood, target, moment: Moment::Moving });
    }
    for process in CHAIN {
        let target = Target::Process(process);
        cells.push(Cell { fault: FaultKind::MemoryFull, target, moment: Moment::Moving });
    }
    for fault in [FaultKind::SecondSet, FaultKind::PlantedRun, FaultKind::ReportFull] {
        cells.push(Cell { fault, target: Target::Set, moment: Moment::Moving });
    }
    cells
}

/// Some of them, each fault at least once where it is worst: what takes four minutes.
pub fn quick() -> Vec<Cell> {
    let moving = |fault, process| cell(fault, Target::Process(process), Moment::Moving);
    let message = |fault, process, moment| Cell {
        fault: FaultKind::Message(fault),
        target: Target::Process(process),
        moment,
    };
    let other = |fault, target| Cell { fault, target, moment: Moment::Moving };
    vec![
        other(FaultKind::Nothing, Target::Set),
        cell(Fault::Kill, Target::Supervisor, Moment::Moving),
        moving(Fault::Kill, "world"),
        moving(Fault::Kill, "perception"),
        moving(Fault::Kill, "fields"),
        moving(Fault::Kill, "control"),
        moving(Fault::Kill, "voice"),
        message(MessageFault::Future, "fields", Moment::Moving),
        message(MessageFault::NotANumber, "control", Moment::Moving),
        moving(Fault::SlowByFive, "control"),
        moving(Fault::StopForGood, "fields"),
        moving(Fault::Block, "perception"),
        moving(Fault::FreezePlanner, "control"),
        moving(Fault::Panic, "control"),
        moving(Fault::ExitSuccess, "world"),
        moving(Fault::ExitFailure, "perception"),
        moving(Fault::Abort, "fields"),
        moving(Fault::StopShort, "control"),
        moving(Fault::SlowByHalf, "world"),
        message(MessageFault::Garbage, "world", Moment::Moving),
        message(MessageFault::Stale, "perception", Moment::Moving),
        moving(Fault::PoisonedResume, "control"),
        moving(Fault::DropOut, "world"),
        moving(Fault::NoHandles, "perception"),
        moving(Fault::Kill, "monitor"),
        moving(Fault::CrashOnStart, "perception"),
        moving(Fault::StuckOnStart, "fields"),
        moving(Fault::Stop, "voice"),
        other(FaultKind::Process(Fault::Kill), Target::Two("fields", "control")),
        other(FaultKind::ViewerFlood, Target::Process("control")),
        other(FaultKind::PlantedRun, Target::Set),
        other(FaultKind::Process(Fault::StopShort), Target::Supervisor),
        moving(Fault::CrashLoop, "control"),
        cell(Fault::Kill, Target::Process("fields"), Moment::StartUp),
        cell(Fault::Kill, Target::Process("world"), Moment::Shutdown),
    ]
}

/// Divides cells into runs: those that would disturb each other are in different ones.
pub(crate) fn runs(cells: Vec<Cell>) -> Vec<Vec<Cell>> {
    let mut runs: Vec<Vec<Cell>> = Vec::new();
    for cell in cells {
        let place = runs.iter_mut().find(|run| goes_with(&cell, run));
        match place {
            Some(run) => run.push(cell),
            None => runs.push(vec![cell]),
        }
    }
    runs
}

fn goes_with(cell: &Cell, run: &[Cell]) -> bool {
    if cell.needs_own_run() || run.iter().any(Cell::needs_own_run) || run.len() >= CELLS_OF_A_RUN {
        return false;
    }
    // Where what was remembered may be lost, nobody can say by whom it was.
    if run.iter().any(|other| other.fault.spoils_state() != cell.fault.spoils_state()) {
        return false;
    }
    let cells = || run.iter().chain([cell]);
    let mut restarts: BTreeMap<&str, usize> = BTreeMap::new();
    for (cell, process) in cells().flat_map(|cell| cell.struck().into_iter().map(move |p| (cell, p))) {
        *restarts.entry(process).or_default() += cell.fault.restarts();
    }
    // What was refused is counted over the whole run: each reason belongs to one cell.
    let mut reasons = BTreeSet::new();
    // The monitor's own count of what it ignored ends with it.
    let counted = !reasons_are_counted(run, cell) || !restarts.contains_key("monitor");
    counted
        && restarts.values().all(|restarts| *restarts <= RESTARTS_OF_A_RUN)
        && cells().filter_map(refusal).all(|reason| reasons.insert(reason as usize))
}

fn reasons_are_counted(run: &[Cell], cell: &Cell) -> bool {
    run.iter().chain([cell]).any(|cell| refusal(cell).is_some())
}

fn refusal(cell: &Cell) -> Option<Refusal> {
    match cell.fault {
        FaultKind::Message(fault) => Some(fault.refusals()[0]),
        _ => None,
    }
}

fn cell(fault: Fault, target: Target, moment: Moment) -> Cell {
    Cell { fault: FaultKind::Process(fault), target, moment }
}

/// Slowness belongs to processes with cycles; and what is not needed is restarted for ever, so that no loop ends it.
fn applies(fault: Fault, process: &str) -> bool {
    let of_the_chain =
        matches!(fault, Fault::SlowByHalf | Fault::Slow | Fault::SlowByFive | Fault::CrashLoop);
    let can_be_done = fault.only_of().is_none_or(|only| only == process);
    let has_state = CHAIN.contains(&process) && process != "world";
    can_be_done
        && (!of_the_chain || CHAIN.contains(&process))
        && (fault != Fault::PoisonedResume || has_state)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quick_part_belongs_to_the_whole_and_no_cell_is_there_twice() {
        let whole = whole();
        let unique: std::collections::HashSet<_> = whole.iter().collect();
        assert_eq!(unique.len(), whole.len());
        for cell in quick() {
            assert!(unique.contains(&cell), "{cell}");
        }
    }

    #[test]
    fn runs_hold_every_cell_once_and_none_that_disturb_each_other() {
        let runs = runs(whole());
        assert_eq!(runs.iter().map(Vec::len).sum::<usize>(), whole().len());
        for run in &runs {
            assert!(run.len() == 1 || !run.iter().any(Cell::needs_own_run), "{run:?}");
            for process in CHAIN {
                let of_it = run.iter().filter(|cell| cell.target.processes().contains(&process));
                assert!(of_it.map(|cell| cell.fault.restarts()).sum::<usize>() <= RESTARTS_OF_A_RUN);
            }
        }
    }
}
