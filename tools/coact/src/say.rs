use crate::living_runs;
use anyhow::{Result, ensure};
use coact_messages::{Speech, topic};
use coact_realtime::{Bus, Output};
use std::process::ExitCode;
use std::time::Duration;

/// Says something to the robot of a running process set, as the person would.
#[derive(Debug, clap::Args)]
#[command(
    after_help = "Examples:\n  coact say \"give me the wheel\"\n  coact say \"I give you the nut\" --run 1a2b-0\n\n\
What the robot understands are the phrases of its task file (`says` of each chain)."
)]
pub struct Args {
    /// The sentence
    sentence: String,
    /// Which run, when there are several
    #[arg(long, value_name = "ID")]
    run: Option<String>,
}

/// How long this program waits for the world to read the sentence, before it takes its end of the topic away.
///
/// Chosen by hand: hundreds of the world's cycles.
const HEARD_WITHIN: Duration = Duration::from_millis(300);

/// Publishes the sentence to the run's world.
///
/// # Errors
/// There is no such run, or nothing was said, or more than a message can hold.
pub fn run(args: Args) -> Result<ExitCode> {
    let sentence = args.sentence.trim();
    ensure!(!sentence.is_empty(), "nothing was said; expected a sentence such as \"give me the wheel\"");
    ensure!(sentence.len() <= 256, "the sentence has {} bytes; expected at most 256", sentence.len());
    let run = living_runs::only(args.run.as_deref())?;
    let bus = Bus::open(&run, "say", 0)?;
    let mut speech: Output<Speech> = bus.output(topic::HEARD)?;
    let mut message = speech.loan()?;
    message.write(sentence);
    message.send(0, coact_realtime::now())?;
    std::thread::sleep(HEARD_WITHIN);
    eprintln!("run {}: said \u{201c}{sentence}\u{201d}", run.id());
    Ok(ExitCode::SUCCESS)
}
