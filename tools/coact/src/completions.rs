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
    generate(shell, &mut Cli::command(), "coact", &mut std::io::stdout());
    ExitCode::SUCCESS
}
