//! What the program says about itself: help that fits the terminal, its version, completions.
#![allow(clippy::unwrap_used)]

use std::process::{Command, Output};

/// Widest line of a help text, characters.
const COLUMNS: usize = 100;

/// Runs `coact` with these arguments, to its end.
fn coact(arguments: &[&str]) -> Output {
    Command::new(coact_tests::coact()).args(arguments).output().unwrap()
}

/// What `coact ... --help` prints.
fn help(command: &[&str]) -> String {
    let output = coact(&[command, &["--help"]].concat());
    assert_eq!(output.status.code(), Some(0), "{command:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// The lines of a section of a help text, without its heading.
fn section<'a>(help: &'a str, heading: &str) -> Vec<&'a str> {
    let below = help.lines().skip_while(|line| *line != heading).skip(1);
    below.take_while(|line| !line.is_empty()).collect()
}

/// The subcommands that a help text names.
fn subcommands(help: &str) -> Vec<&str> {
    let entries = section(help, "Commands:").into_iter().filter(|line| !line.starts_with("   "));
    entries.map(|line| line.split_whitespace().next().unwrap()).filter(|name| *name != "help").collect()
}

/// Every command, with that of which it is a subcommand, and its help.
fn all() -> Vec<(Vec<String>, String)> {
    let mut found = vec![(Vec::new(), help(&[]))];
    let mut next = 0;
    while next < found.len() {
        let (command, text) = found[next].clone();
        for name in subcommands(&text) {
            let deeper: Vec<String> = command.iter().cloned().chain([name.to_owned()]).collect();
            let text = help(&deeper.iter().map(String::as_str).collect::<Vec<_>>());
            found.push((deeper, text));
        }
        next += 1;
    }
    found
}

#[test]
fn help_of_every_command_fits_the_terminal_and_has_examples() {
    let commands = all();
    assert!(commands.len() > 15, "{commands:?}");
    for (command, text) in commands {
        let wide = text.lines().find(|line| line.chars().count() > COLUMNS);
        assert_eq!(wide, None, "{command:?}: wider than {COLUMNS} columns");
        let mut examples = section(&text, "Examples:");
        examples.extend(section(&text, "Example:"));
        assert!(!examples.is_empty(), "{command:?} has no example:\n{text}");
        // A line that was broken to fit would begin with something else.
        let broken = examples.iter().find(|line| !line.starts_with("  coact "));
        assert_eq!(broken, None, "{command:?}: an example is no line of its own");
    }
}

#[test]
fn help_of_a_study_is_the_same_in_both_words() {
    for study in ["evaluate", "learn"] {
        let output = coact(&["help", study]);
        assert!(output.status.success());
        assert_eq!(String::from_utf8(output.stdout).unwrap(), help(&[study]));
    }
}

#[test]
fn a_command_that_is_mistyped_is_one_error_that_names_the_nearest() {
    let output = coact(&["evalute"]);
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("'evaluate'"), "{said}");
}

#[test]
fn version_is_that_of_the_package() {
    let output = coact(&["--version"]);
    assert!(output.status.success());
    assert_eq!(String::from_utf8(output.stdout).unwrap(), concat!("coact ", env!("CARGO_PKG_VERSION"), "\n"));
}

#[test]
fn completions_of_every_shell_know_the_commands() {
    for shell in ["bash", "zsh", "fish"] {
        let output = coact(&["completions", shell]);
        assert!(output.status.success(), "{shell}");
        let script = String::from_utf8(output.stdout).unwrap();
        for word in ["launch", "snapshots", "mapping", "realtime"] {
            assert!(script.contains(word), "{shell}: {word} is missing");
        }
    }
    assert_eq!(coact(&["completions", "powershell"]).status.code(), Some(2));
}
