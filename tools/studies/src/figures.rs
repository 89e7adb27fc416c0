//! `coact figures`: the chapter's figures, from runs made now.

use anyhow::Result;
use coact::installation::Installation;
use coact_figures::{Figure, Gallery, Step};
use coact_period::{cycles, seconds};
use indicatif::{ProgressBar, ProgressStyle};
use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Duration;

/// Draws the chapter's figures from runs that are made now.
///
/// Each figure becomes figure-NN.svg and figure-NN.png; figures.json tells what stands in them, for machines.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact figures --out figures              all of them: 3, 4, 6, 7, 8, 9, 11, 12, 13, 15 and 16
  coact figures --out figures --only 7,8   these only
  coact figures --out figures --seed 2     the same scenes with other noise")]
pub struct Args {
    /// Folder for the pictures; it is made if it is not there
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Numbers of the figures, with commas between [default: all]
    #[arg(long, value_name = "N", value_delimiter = ',')]
    only: Vec<u32>,
    /// Seed of every run
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u64,
}

/// How often the progress of a run is shown. Chosen by hand.
const SHOW_EVERY: u64 = cycles(Duration::from_millis(500));

/// Makes the runs, draws the figures and names the files.
///
/// # Errors
/// A number that no figure has, a scenario that is refused, or a folder that cannot be written to.
pub fn run(args: Args) -> Result<ExitCode> {
    let figures = Figure::select(&args.only)?;
    let installation = Installation::find()?;
    let bar = ProgressBar::new_spinner().with_style(ProgressStyle::with_template("{spinner} {msg}")?);
    let gallery =
        Gallery { configuration: &installation.configuration, out: &args.out, figures, seed: args.seed };
    let index = gallery.draw(&mut |step| {
        bar.tick();
        match step {
            Step::Run(scenario, tick) if tick.is_multiple_of(SHOW_EVERY) => {
                bar.set_message(format!("{}: {:.1} s", scenario.file(), seconds(tick)));
            }
            Step::Run(..) => {}
            Step::Figure(number) => bar.set_message(format!("figure {number}")),
        }
    })?;
    bar.finish_and_clear();
    for entry in index.figures {
        let [svg, _] = entry.files.map(|file| args.out.join(file));
        println!("{} and .png: {}", svg.display(), entry.title);
    }
    Ok(ExitCode::SUCCESS)
}
