//! Commands that no run needs: those of the program `coact-studies` beside this one, which is built when it is first used.

use crate::companion;
use anyhow::Error;
use std::ffi::OsString;
use std::process::Command;

/// Name and description of each study.
pub const STUDIES: [(&str, &str); 13] = [
    ("task", "Show what is made of a task file"),
    ("learn", "Learn connections of the network: a plan from demonstrations, what acts show"),
    ("reaches", "Measure anticipation on recorded reaches of real people"),
    ("evaluate", "Evaluate whole assemblies with random partners, and compare with ablations"),
    ("bench", "Measure latencies beside an idle thread and iceoryx2 alone, under load and with kills"),
    ("separation", "Measure the separation of the working robot from recorded people"),
    ("faults", "Break process sets in every way, and judge what happens"),
    ("replay", "Compute a recorded run again, and compare it with the recording to the bit"),
    ("figures", "Draw the chapter's figures from runs made now"),
    ("motion", "Plan a movement of the arm, or measure the planner"),
    ("train", "Train the model of preshaping from recorded reaches"),
    ("carries", "Extract the ways of hands that carry, give and withdraw, from motion capture"),
    ("completions", "Print completions for a shell"),
];

/// Name of the program and of its package.
const PROGRAM: &str = "coact-studies";

/// Whether these arguments, or the help that they ask for, are those of a study.
pub fn are_meant(arguments: &[OsString]) -> bool {
    let command = match arguments {
        [help, command, ..] if help == "help" => Some(command),
        arguments => arguments.first(),
    };
    command.is_some_and(|command| STUDIES.iter().any(|(name, _)| command == name))
}

/// Becomes the program of the studies, with these arguments; returns only what prevented it.
pub fn run(arguments: &[OsString]) -> Error {
    companion::up_to_date(PROGRAM, "the studies").map_or_else(
        |error| error,
        |program| {
            let mut command = Command::new(program);
            command.args(arguments);
            companion::become_it(command)
        },
    )
}
