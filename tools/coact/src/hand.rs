use crate::living_runs;
use anyhow::{Context, Result, bail, ensure};
use coact_joint_task::Task;
use coact_messages::{HandPoints, Plausible, topic};
use coact_person::HandModel;
use coact_pipeline::Run;
use coact_realtime::{Bus, Output, Schedule, now};
use coact_world::Partner;
use glam::DVec3;
use std::io::{BufRead, Read};
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// Moves the hand of a running process set's partner, as lines on standard input say.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact launch --partner hand           in one terminal; then in another one:
  coact hand < my-hand.jsonl
  coact hand --run 1a2b-0

A program of any language can be its source: python3 examples/hand.py | coact hand")]
pub struct Args {
    /// Which run, when there are several
    #[arg(long, value_name = "ID")]
    run: Option<String>,
}

/// Longest line, bytes: far more than 27 numbers take.
const LONGEST_LINE: u64 = 4096;
/// How often it is looked whether the run has ended. Chosen by hand.
const LOOK_EVERY: Duration = Duration::from_millis(500);
/// What a line is to be.
const EXPECTED: &str = "expected a JSON array of 27 numbers (x, y, z of nine keypoints, m) or of 5 \
                        (x, y, z, m; pitch, degrees; aperture, m); see coact hand --help";

/// Publishes each line's hand until the lines or the run end.
///
/// # Errors
/// There is no such run, its partner is another one, or a line is no hand.
pub fn run(args: Args) -> Result<ExitCode> {
    let run = living_runs::only(args.run.as_deref())?;
    let partner = &run.settings().partner;
    ensure!(
        partner == Partner::HAND,
        "run {}: its partner is {partner}; expected a set that was started with: coact launch --partner hand",
        run.id()
    );
    let model = HandModel::new(&Task::load(&run.settings().task)?.scene);
    let bus = Bus::open(&run, "hand", 0)?;
    // Those that were killed have left their places on the topic taken.
    bus.clean_dead();
    let mut output: Output<HandPoints> = bus.output(topic::HAND)?;
    let (mut lines, mut looked) = (std::io::stdin().lock(), Instant::now());
    for number in 1_u64.. {
        let here = || format!("standard input, line {number}");
        let Some(line) = next_line(&mut lines).with_context(here)? else { break };
        if looked.elapsed() > LOOK_EVERY {
            looked = Instant::now();
            if !run.owner_lives() {
                eprintln!("run {} has ended", run.id());
                break;
            }
        }
        let mut message = output.loan()?;
        message.position = keypoints(&line, &model).with_context(here)?;
        message.check().with_context(here)?;
        message.send(cycle(&run)?, now())?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The present cycle of the run; 0 before it has begun.
fn cycle(run: &Run) -> Result<u64> {
    Ok(run.start_ns()?.map_or(0, |start_ns| Schedule { start_ns }.tick_at(now())))
}

fn next_line(lines: &mut impl BufRead) -> Result<Option<String>> {
    let mut line = String::new();
    lines.take(LONGEST_LINE).read_line(&mut line)?;
    ensure!((line.len() as u64) < LONGEST_LINE, "more than {LONGEST_LINE} bytes; {EXPECTED}");
    Ok(Some(line).filter(|line| !line.is_empty()))
}

/// The nine keypoints that a line tells, m.
///
/// # Errors
/// What is wrong with it, and what was expected. Whether they can be those of an arm is not looked at.
pub fn keypoints(line: &str, model: &HandModel) -> Result<[[f64; 3]; 9]> {
    let numbers: Vec<f64> = match serde_json::from_str(line) {
        Ok(numbers) => numbers,
        Err(error) => bail!("{error}; {EXPECTED}"),
    };
    if let [x, y, z, pitch, aperture] = numbers[..] {
        let points = model.reaching(DVec3::new(x, y, z), pitch.to_radians(), aperture);
        return Ok(points.map(|point| point.to_array()));
    }
    let ([], Ok(points)) = (numbers.as_chunks::<3>().1, <[[f64; 3]; 9]>::try_from(numbers.as_chunks().0))
    else {
        bail!("{} numbers; {EXPECTED}", numbers.len());
    };
    Ok(points)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use std::path::Path;

    fn model() -> HandModel {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
        HandModel::new(&Task::load(&file).unwrap().scene)
    }

    #[test]
    fn five_numbers_are_a_hand_and_twenty_seven_its_keypoints() {
        let five = keypoints("[-0.95, 0.14, 0.85, -75, 0.09]\n", &model()).unwrap();
        let message = HandPoints { position: five, ..bytemuck::Zeroable::zeroed() };
        assert_eq!(message.check(), Ok(()));
        let again = keypoints(&serde_json::to_string(five.as_flattened()).unwrap(), &model()).unwrap();
        assert_eq!(again, five);
    }

    #[test]
    fn what_is_no_hand_is_refused_with_what_was_expected() {
        for line in ["", "hand", "[1, 2]", "[1, 2, 3, 4, \"5\"]", "{\"x\": 1}", "[null]", "[[1]]", "[1e999]"]
        {
            let message = keypoints(line, &model()).unwrap_err().to_string();
            assert!(message.contains("27 numbers"), "{line}: {message}");
        }
        let long = "1".repeat(LONGEST_LINE as usize);
        assert!(next_line(&mut long.as_bytes()).unwrap_err().to_string().contains("4096 bytes"));
        assert_eq!(next_line(&mut "".as_bytes()).unwrap(), None);
    }
}
