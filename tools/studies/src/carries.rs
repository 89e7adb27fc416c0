//! `coact carries`: the ways of hands that carry, give and withdraw, out of motion capture.

use anyhow::{Context, Result, bail};
use coact::installation::Installation;
use coact_carries::{Extraction, LeftOut, extract};
use coact_pipeline::RunSettings;
use coact_recordings::{Way, WayKind, ways_text};
use std::path::PathBuf;
use std::process::ExitCode;

/// Extracts the ways along which hands of real people carry, give and withdraw, from motion capture:
/// what moves the person's hand with recorded movements.
///
/// The same recordings make the same file, bit by bit.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact carries                            makes the shipped file anew
  coact carries --from DIR --out mine.csv  from other recordings, into another file

DIR holds folders named after what was done in them (CollaborativeStacking, HumanRobotHandover,
RobotHumanHandover; others are left out), and these hold files of motion capture (.csv): t_s, then
x_mm, y_mm and z_mm of left_hand, left_shoulder, of the right ones, and of hip. Beside each lies a
.json file of the same name with its keyframes and the hand that holds the object first.

Exit status: 0, or 2 for bad usage or files.")]
pub struct Args {
    /// Folder of motion capture [default: ../shared/data/motion-capture beside the checkout]
    #[arg(long, value_name = "DIR")]
    from: Option<PathBuf>,
    /// Where to write the ways [default: data/carries/carries.csv]
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// Where the recordings lie that are not shipped, from the checkout's root.
const RECORDINGS: &str = "../shared/data/motion-capture";

/// Extracts and writes the ways.
///
/// # Errors
/// The recordings are absent or refused, or the file cannot be written.
pub fn run(args: Args) -> Result<ExitCode> {
    let Installation { configuration, .. } = Installation::find()?;
    let folder = match args.from {
        Some(folder) => folder,
        None => configuration.with_file_name(RECORDINGS),
    };
    if !folder.is_dir() {
        bail!("{}: no such folder; expected motion capture. Name its folder with --from", folder.display());
    }
    let extraction = extract(&folder)?;
    let out = args.out.unwrap_or_else(|| RunSettings::shipped(&configuration).carries);
    if let Some(folder) = out.parent() {
        std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    }
    std::fs::write(&out, ways_text(&extraction.ways)).with_context(|| out.display().to_string())?;
    println!("{}: {} ways from {} recordings", out.display(), extraction.ways.len(), extraction.recordings);
    tell(&extraction);
    Ok(ExitCode::SUCCESS)
}

fn tell(extraction: &Extraction) {
    for kind in WayKind::ALL {
        let of = |value: fn(&Way) -> f64| {
            let mut values: Vec<f64> =
                extraction.ways.iter().filter(|way| way.kind == kind).map(value).collect();
            values.sort_by(f64::total_cmp);
            values
        };
        let (times, distances) = (of(|way| way.duration), of(|way| way.distance));
        println!(
            "{:9} {:2}   duration {} s   distance {} m   (median, 5 and 95 %)",
            kind.name(),
            times.len(),
            spread(&times),
            spread(&distances)
        );
    }
    let count = |reason: LeftOut| extraction.left_out.iter().filter(|own| **own == reason).count();
    let told = LeftOut::ALL.map(|reason| format!("{} {}", count(reason), reason.name()));
    println!("left out  {}", told.join(", "));
}

/// Median, 5th and 95th percentile of ascending values: nearest ranks.
fn spread(values: &[f64]) -> String {
    let rank = |fraction: f64| (fraction * (values.len().saturating_sub(1)) as f64).round() as usize;
    let at = |fraction: f64| values.get(rank(fraction)).copied().unwrap_or(f64::NAN);
    format!("{:.2} ({:.2} to {:.2})", at(0.5), at(0.05), at(0.95))
}
