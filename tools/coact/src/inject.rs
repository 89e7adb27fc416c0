use crate::living_runs;
use anyhow::{Context, Result};
use coact_supervisor::Fault;
use std::process::ExitCode;

/// Injects a fault into a process of a running process set, now.
#[derive(Debug, clap::Args)]
#[command(after_help = after_help())]
pub struct Args {
    /// Name of the process, as in rt-config/pipeline.toml
    process: String,
    /// Name of the fault: one of those below
    fault: Fault,
    /// Which run, when there are several
    #[arg(long, value_name = "ID")]
    run: Option<String>,
}

fn after_help() -> String {
    let fault = |fault: Fault| format!("\n  {:<14}  {}", fault.name(), fault.description());
    let examples = "Examples:\n  coact inject fields kill\n  coact inject perception stop --run 1a2b-0";
    format!("{examples}\n\nFaults:{}", Fault::ALL.map(fault).concat())
}

/// Asks the run's supervisor.
///
/// # Errors
/// There is no such run, process or fault, or the process is not running just now.
pub fn run(args: Args) -> Result<ExitCode> {
    let run = living_runs::only(args.run.as_deref())?;
    coact_supervisor::request_fault(&run, &args.process, args.fault.name())
        .with_context(|| format!("run {}", run.id()))?;
    eprintln!("run {}: {} injected into {}", run.id(), args.fault, args.process);
    Ok(ExitCode::SUCCESS)
}
