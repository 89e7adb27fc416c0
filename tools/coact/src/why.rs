use crate::{closed_pipe, living_runs};
use anyhow::{Context, Result, bail, ensure};
use coact_fields::{Explanation, Share};
use coact_joint_task::NetworkPlan;
use coact_messages::{FieldFrame, LayerKind, Percept, topic};
use coact_pipeline::Run;
use coact_realtime::{Bus, Input, Message};
use owo_colors::{OwoColorize, Stream};
use serde_json::json;
use std::fmt::Write as _;
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// Asks the robot of a running process set why it does what it does: what a population of the network gets right now, and from
/// where.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact why                       what has been decided, and why
  coact why \"AEL grasp\"           the actions called so: why they are chosen, or not
  coact why IL                    all inferred goals
  coact why \"IL insert\" --json    the same for a program

Amounts are in units of the input that ignites a population at rest; negative ones hold it down.
A peak that stands needs less.")]
pub struct Args {
    /// Layer and words of the population's name [default: what is decided]
    population: Option<String>,
    /// Which run, when there are several
    #[arg(long, value_name = "ID")]
    run: Option<String>,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

/// Longest wait for a message of the set: a stage that is replaced sends again within milliseconds.
const HEARD_WITHIN: Duration = Duration::from_secs(2);
/// What gives or takes less than this is not told in the sentence, in units of the igniting input.
const TOLD: f64 = 0.005;

/// Explains what is asked for.
///
/// # Errors
/// There is no such run or population, or the set sends nothing.
pub fn run(args: Args) -> Result<ExitCode> {
    let run = living_runs::only(args.run.as_deref())?;
    let (_, plan) = NetworkPlan::load(&run.settings().task)?;
    let (frame, percept) = newest(&run)?;
    closed_pipe::ends_the_program();
    let asked = match &args.population {
        Some(words) => find(&plan, words)?,
        None => standing(&plan, &frame, LayerKind::ActionExecution),
    };
    let explanations: Vec<_> = asked
        .into_iter()
        .map(|population| Explanation::of(&plan, population, &frame, percept.as_deref()))
        .collect();
    let cycle = frame.header.cycle;
    if args.json {
        let told: Vec<_> = explanations.iter().map(|explained| as_json(&plan, explained)).collect();
        println!("{}", serde_json::to_string_pretty(&json!({ "cycle": cycle, "populations": told }))?);
    } else if explanations.is_empty() {
        println!("nothing is decided; coact why AEL tells of each action why not");
    } else {
        explanations.iter().for_each(|explained| print!("{}", in_words(&plan, explained, cycle)));
    }
    Ok(ExitCode::SUCCESS)
}

/// The newest frame, and the newest percept, if one comes.
fn newest(run: &Run) -> Result<(Box<FieldFrame>, Option<Box<Percept>>)> {
    let bus = Bus::open(run, "why", 0)?;
    let (mut frames, mut percepts): (Input<FieldFrame>, Input<Percept>) =
        (bus.input(topic::FIELDS)?, bus.input(topic::PERCEPT)?);
    let frame = heard(&mut frames)?.with_context(|| {
        format!("run {} sends no field frames; expected one that works: coact launch", run.id())
    })?;
    Ok((frame, heard(&mut percepts)?))
}

fn heard<T: Message>(input: &mut Input<T>) -> Result<Option<Box<T>>> {
    let begin = Instant::now();
    while begin.elapsed() < HEARD_WITHIN {
        input.refresh()?;
        if let Some(message) = input.latest() {
            return Ok(Some(Box::new(*message)));
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    Ok(None)
}

/// The populations of a layer that hold a peak.
fn standing(plan: &NetworkPlan, frame: &FieldFrame, layer: LayerKind) -> Vec<usize> {
    plan.layer(layer).populations.clone().filter(|population| frame.since[*population] > 0).collect()
}

/// The populations whose name has all these words, in any case.
fn find(plan: &NetworkPlan, words: &str) -> Result<Vec<usize>> {
    ensure!(!words.trim().is_empty(), "no population was named; expected words such as \"AEL grasp\"");
    let words: Vec<_> = words.split_whitespace().map(str::to_lowercase).collect();
    let has_all = |population: &usize| {
        let name = plan.name(*population).to_lowercase();
        words.iter().all(|word| name.contains(word))
    };
    let found: Vec<usize> = (0..plan.populations.len()).filter(has_all).collect();
    if found.is_empty() {
        let layers = LayerKind::ALL.map(LayerKind::name).join(", ");
        bail!(
            "no population is called so: {}; expected words of a name, such as one of the layers {layers}",
            words.join(" ")
        );
    }
    Ok(found)
}

fn in_words(plan: &NetworkPlan, explained: &Explanation, cycle: u64) -> String {
    let name = plan.name(explained.population);
    let name = name.if_supports_color(Stream::Stdout, |text| text.bold());
    let state = match explained.since {
        Some(since) => format!("has stood for {:.2} s", cycle.saturating_sub(since) as f64 / 1000.0),
        None => "does not stand".to_owned(),
    };
    let mut text = format!("{name} {state}; it gets {:.2}:\n", explained.input());
    let told: Vec<_> = explained.shares.iter().filter(|share| share.amount.abs() >= TOLD).collect();
    if told.is_empty() {
        text.push_str("    nothing from anywhere\n");
    }
    for share in told {
        // To write to a string cannot fail.
        let _ = writeln!(
            text,
            "  {:>6.2}  from {} ({})",
            share.amount,
            share.from(plan),
            plan.reasons[share.rule]
        );
    }
    for (share, missing) in explained.shares.iter().filter_map(|share| Some((share, share.missing()?))) {
        let _ = writeln!(
            text,
            "       -  {:.2} if {} stood as well ({})",
            share.weight,
            plan.name(missing),
            plan.reasons[share.rule]
        );
    }
    text
}

fn as_json(plan: &NetworkPlan, explained: &Explanation) -> serde_json::Value {
    let source = |(place, signal): &(usize, f64)| json!({ "name": plan.name(*place), "signal": signal });
    let share = |share: &Share| {
        json!({
            "amount": share.amount,
            "weight": share.weight,
            "counts": share.pool.name(),
            "why": plan.reasons[share.rule],
            "sources": share.sources.iter().map(source).collect::<Vec<_>>(),
        })
    };
    json!({
        "name": plan.name(explained.population),
        "signal": explained.signal,
        "since_cycle": explained.since,
        "input": explained.input(),
        "shares": explained.shares.iter().map(share).collect::<Vec<_>>(),
    })
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use std::path::Path;

    fn plan() -> NetworkPlan {
        let task = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
        NetworkPlan::load(&task).unwrap().1
    }

    #[test]
    fn populations_are_found_by_words_of_their_names_and_others_are_refused_with_the_layers() {
        let plan = plan();
        assert_eq!(find(&plan, "ael").unwrap().len(), plan.populations_of(LayerKind::ActionExecution).len());
        let inserts = find(&plan, "il INSERT").unwrap();
        assert!(!inserts.is_empty());
        assert!(inserts.iter().all(|place| plan.name(*place).starts_with("IL insert")));
        let refused = find(&plan, "telepathy").unwrap_err().to_string();
        assert!(refused.contains("telepathy") && refused.contains("AOL, OML robot"), "{refused}");
        assert!(find(&plan, "  ").is_err());
    }

    #[test]
    fn a_goal_that_is_inferred_says_from_what_and_one_that_is_not_what_it_lacks() {
        let plan = plan();
        let goal = find(&plan, "IL insert").unwrap()[0];
        let mut frame: Box<FieldFrame> = bytemuck::zeroed_box();
        let silent = Explanation::of(&plan, goal, &frame, None);
        let told = in_words(&plan, &silent, 100);
        assert!(told.contains("does not stand"), "{told}");
        for share in &silent.shares {
            let sources = share.sources.iter().filter(|(source, _)| *source < plan.populations.len());
            sources.for_each(|(source, _)| frame.signal[*source] = 1.0);
        }
        frame.since[goal] = 40;
        let told = in_words(&plan, &Explanation::of(&plan, goal, &frame, None), 250);
        assert!(told.contains("has stood for 0.21 s") && told.contains("from ASL"), "{told}");
    }
}
