use crate::Cli;
use clap::{CommandFactory, ValueEnum};
use clap_complete::{Shell, generate};
use std::process::ExitCode;

/// Prints what makes a shell complete commands, options and their values.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact completions bash > ~/.local/share/bash-completion/completions/coact
  coact completions zsh > ~/.zfunc/_coact              (a folder of $fpath)
  coact completions fish > ~/.config/fish/completions/coact.fish")]
pub struct Args {
    /// The shell
    #[arg(value_enum)]
    shell: Kind,
}

/// Shells for which there are completions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Kind {
    Bash,
    Zsh,
    Fish,
}

/// Prints the script.
pub fn run(args: &Args) -> ExitCode {
    let shell = match args.shell {
        Kind::Bash => Shell::Bash,
        Kind::Zsh => Shell::Zsh,
        Kind::Fish => Shell::Fish,
    };
    generate(shell, &mut whole(), "coact", &mut std::io::stdout());
    ExitCode::SUCCESS
}

/// The command line of `coact`, with the studies in full.
fn whole() -> clap::Command {
    Cli::command()
        .get_subcommands()
        .fold(coact::command_line(), |whole, study| whole.mut_subcommand(study.get_name(), |_| study.clone()))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn coact_lists_every_study_with_its_description() {
        let cli = Cli::command();
        let own =
            cli.get_subcommands().map(|study| (study.get_name(), study.get_about().unwrap().to_string()));
        let listed = coact::STUDIES.map(|(name, about)| (name, about.to_owned()));
        assert_eq!(own.collect::<Vec<_>>(), listed);
    }

    #[test]
    fn studies_are_completed_with_their_options() {
        let whole = whole();
        let known = |study: &str, option: &str| {
            let study = whole.find_subcommand(study).unwrap();
            study.get_arguments().any(|argument| argument.get_long() == Some(option))
        };
        assert!(known("reaches", "realtime") && known("evaluate", "baseline") && known("launch", "inject"));
    }
}
