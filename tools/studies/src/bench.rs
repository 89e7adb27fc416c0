//! `coact bench`: what is measured beside what it is to be compared with.

mod latency;
mod recovery;

use anyhow::Result;
use std::path::PathBuf;
use std::process::ExitCode;

/// Measures the pipeline beside what it is to be compared with.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact bench latency --load all --out reports/bench
  coact bench recovery --faults 1000 --standby")]
pub struct Args {
    #[command(subcommand)]
    bench: Bench,
}

#[derive(Debug, clap::Subcommand)]
enum Bench {
    /// Latencies of a real set, of an idle thread and of iceoryx2 alone, at the same time
    Latency(latency::Args),
    /// What many deaths of fields and control cost a real set
    Recovery(recovery::Args),
    /// The raw hop's other process, which `latency` starts
    #[command(hide = true)]
    SendRaw {
        /// The run's directory
        run: PathBuf,
        /// Where its iceoryx2 keeps its files
        folder: PathBuf,
    },
}

/// Measures.
///
/// # Errors
/// The configuration is refused, the set cannot be started, or its load is not there.
pub fn run(args: Args) -> Result<ExitCode> {
    match args.bench {
        Bench::Latency(args) => latency::run(args),
        Bench::Recovery(args) => recovery::run(args),
        Bench::SendRaw { run, folder } => {
            coact_bench::send_raw(&run, &folder)?;
            Ok(ExitCode::SUCCESS)
        }
    }
}
