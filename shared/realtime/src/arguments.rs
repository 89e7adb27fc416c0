use std::path::PathBuf;

/// Command line of every process of the set. The supervisor writes it; a person uses `tools/launch`.
#[derive(Debug, clap::Parser)]
#[command(about = "A process of a coact set; started by the supervisor, see tools/launch")]
pub struct Arguments {
    /// Directory of the run to take part in.
    #[arg(long, value_name = "DIR")]
    pub run: PathBuf,
    /// Take part as the standby of the stage.
    #[arg(long)]
    pub standby: bool,
    /// Take part only when a byte comes on standard input; end when that is closed.
    #[arg(long)]
    pub spare: bool,
}
