//! `coact evaluate`: whole assemblies with random partners, counted.

mod people;
mod tables;

use anyhow::{Context, Result, bail};
use clap::ValueEnum;
use coact::installation::Installation;
use coact::partner;
use coact_control::PlannerDelay;
use coact_evaluation::{
    Ablation, Campaign, Comparison, EvaluationReport, NetworkVariant, RecordedPerson, Trial, draw_fluency,
    draw_leads, draw_timeline,
};
use coact_joint_task::NetworkPlan;
use coact_pipeline::{Layout, RunSettings, WorldMode};
use coact_world::Partner;
use indicatif::{ProgressBar, ProgressStyle};
use serde::Serialize;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Runs whole assemblies in lockstep, on all cores, and counts what the robot understood.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact evaluate                                      100 with a partner who errs now and then
  coact evaluate --trials 10000 --out reports/random  many, with every action written down
  coact evaluate --baseline reactive                  against a robot without anticipation
  coact evaluate --baseline myopic                    ... that does not look ahead either
  coact evaluate --baseline unguarded                 what keeping clear of the person costs
  coact evaluate --ablate oml                         without object memory
  coact evaluate --partner random:goal=0.2,clarity=0.3..1
  coact evaluate --partner random:changes=0.5         who changes the mind in mid-reach
  coact evaluate --layout random                      parts lie elsewhere in each
  coact evaluate --movement recorded                  the hand reaches as recorded people did
  coact evaluate --assemblies 4                       people whom the robot knows
  coact evaluate --person mine.toml                   people hold the hand as that file says
  coact evaluate --world physics --trials 20          with contact forces; takes longer
  coact evaluate --planner-delay measured             movements are there as late as in real time
  coact evaluate --task a.toml b.toml --trials 20     ten of each task

Keys of random, after a colon, separated by commas:
  idle, goal, request, means  fractions of the person's choices: idling; a part taken for a subgoal
                              whose turn has not come or that is achieved; a part requested out of
                              turn; a part requested that is at hand
  hidden, words               fractions of valid actions: a part taken behind an occluder that hides
                              it and the hand at it; an action that comes with a sentence
  clarity=LOW..HIGH           of a grip: 1 its own pitch, 0 the middle to the nearest other grip's
  dropouts                    bursts per second in which the tracker loses the hand
  withdraws, late             fractions of handovers: the person lets go, or takes back, too early;
                              the person comes 2 to 6 s late for the part
  changes                     fraction of valid reaches to a part in which the person changes the mind
                              in mid-reach: the hand turns to another part
  left                        fraction of takings of an own part that lies nearer to the left hand, with
                              that one
  movement=LOW..HIGH          movement time of a reach, ms

Exit status: 0, or 2 for bad usage or configuration.")]
pub struct Args {
    /// The task, or several, which the assemblies take in turn [default: the toy vehicle]
    #[arg(long, value_name = "FILE", num_args = 1..)]
    task: Vec<PathBuf>,
    /// Where parts lie at first: as the task has them, or anywhere in the workspace in which the task has them, elsewhere in each assembly
    #[arg(long, value_enum, default_value = "task")]
    layout: Laid,
    /// How the person's hand reaches: on straight lines, or as the recorded people of data/reaches did, who take turns, each
    /// read by a model of preshaping that was made without them; it then carries and withdraws along the ways of data/carries
    #[arg(long, value_enum, default_value = "minimum-jerk")]
    movement: Moved,
    /// How the world computes: kinematic (no contact forces), or physics
    #[arg(long, default_value = "kinematic")]
    world: WorldMode,
    /// How many assemblies
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u64).range(1..))]
    trials: u64,
    /// How many assemblies each person builds one after another: figures of people whom the robot knows are told apart; what is told of
    /// one assembly, times as well, is then told of all that the person builds
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=100))]
    assemblies: u64,
    /// Seed of the first assembly; the others follow
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Who works with the robot: random[:KEY=VALUE,...], synthetic, active, script:FILE, recorded,
    /// recorded:DIR, left-arm:FILE or right-arm:FILE
    #[arg(long, default_value = "random")]
    partner: String,
    /// How simulated people show grips and gestures, and how much they differ [default: rt-config/person.toml]
    #[arg(long, value_name = "FILE")]
    person: Option<PathBuf>,
    /// Evaluate another robot with the same seeds, and compare
    #[arg(long, value_enum)]
    baseline: Option<Baseline>,
    /// Evaluate an ablation: without this layer, or without noise; may be repeated
    #[arg(long, value_enum, value_name = "LAYER")]
    ablate: Vec<Ablated>,
    /// How long the planner's answers are held back, as in real time: measured, or ms; without it they are there at once
    #[arg(long, value_name = "measured|MS")]
    planner_delay: Option<PlannerDelay>,
    /// How many assemblies at the same time [default: one per core]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,
    /// Print one JSON document instead of tables
    #[arg(long)]
    json: bool,
    /// Write evaluation.json, every assembly as a line of JSON, and pictures to this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Where parts lie at first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "lowercase")]
enum Laid {
    /// As the task has them
    Task,
    /// Anywhere in their workspace, elsewhere in each assembly
    Random,
}

/// How the person's hand reaches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Serialize)]
#[serde(rename_all = "kebab-case")]
enum Moved {
    /// On a straight line, as smoothly as can be
    MinimumJerk,
    /// As recorded people did
    Recorded,
}

impl Laid {
    /// What the head of the table says of it.
    fn told(self) -> &'static str {
        match self {
            Self::Task => "",
            Self::Random => ", parts elsewhere in each",
        }
    }
}

impl Moved {
    /// What the head of the table says of it.
    fn told(self) -> &'static str {
        match self {
            Self::MinimumJerk => "",
            Self::Recorded => ", reaches of recorded people",
        }
    }
}

/// The robot to compare with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Baseline {
    /// Without anticipation: it answers what the person has done, never what the person is about to do
    Reactive,
    /// Without anticipation and look-ahead: moreover its hand gets ready for nothing
    Myopic,
    /// Without its guard: it goes on at its planned speed however near the person is
    Unguarded,
}

/// What is taken away from the network.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Ablated {
    /// Object memory
    Oml,
    /// Common subgoals
    Csgl,
    /// Error monitoring
    Eml,
    /// The decision layers' noise
    Noise,
}

/// The content of `evaluation.json`.
#[derive(Debug, Serialize)]
struct Evaluation {
    /// Their names; the assemblies take them in turn.
    tasks: Vec<String>,
    layout: Laid,
    movement: Moved,
    world: WorldMode,
    /// For how long the planner's answers were held back; none when they were not.
    #[serde(skip_serializing_if = "Option::is_none")]
    planner_delay: Option<String>,
    partner: String,
    person: PathBuf,
    seed: u64,
    trials: u64,
    /// How many each person built one after another.
    assemblies: u64,
    report: EvaluationReport,
    /// What the baseline is without.
    #[serde(skip_serializing_if = "Option::is_none")]
    without: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    baseline: Option<EvaluationReport>,
    #[serde(skip_serializing_if = "Option::is_none")]
    comparison: Option<Comparison>,
}

/// Runs all assemblies and prints the metrics.
///
/// # Errors
/// A file, partner or setting is refused, or the folder cannot be written to.
pub fn run(args: Args) -> Result<ExitCode> {
    let settings = settings(&args)?;
    let tasks = tasks(&args, &settings)?;
    if let Some(out) = &args.out {
        std::fs::create_dir_all(out)
            .with_context(|| format!("--out {}: expected a folder that can be written to", out.display()))?;
    }
    let network = NetworkVariant {
        reactive: false,
        myopic: false,
        without: args.ablate.iter().map(|layer| layer.ablation()).collect(),
    };
    let models = tempfile::tempdir().context("no folder for models of preshaping")?;
    let people = match args.movement {
        Moved::MinimumJerk => Vec::new(),
        Moved::Recorded => recorded_people(models.path())?,
    };
    let assemble = |robot, what: String| assemble(&args, (&settings, &people), robot, what);
    let trials = assemble((&network, true), "assemblies".into())?;
    let baseline = match args.baseline {
        None => None,
        Some(baseline) => {
            let myopic = baseline == Baseline::Myopic;
            let reactive = myopic || baseline == Baseline::Reactive;
            let network = NetworkVariant { reactive, myopic, ..network.clone() };
            let guarded = baseline != Baseline::Unguarded;
            let what = format!("without {}", baseline.lacks());
            let trials = assemble((&network, guarded), what)?;
            Some((EvaluationReport::new(&network, &trials), trials))
        }
    };
    let evaluation = Evaluation {
        tasks,
        layout: args.layout,
        movement: args.movement,
        world: args.world,
        planner_delay: args.planner_delay.map(|delay| delay.to_string()),
        partner: settings.partner.clone(),
        person: settings.person.clone(),
        seed: args.seed,
        trials: args.trials,
        assemblies: args.assemblies,
        report: EvaluationReport::new(&network, &trials),
        without: args.baseline.map(Baseline::lacks),
        comparison: baseline.as_ref().map(|(_, rivals)| Comparison::new(&trials, rivals)),
        baseline: baseline.as_ref().map(|(report, _)| report.clone()),
    };
    if let Some(out) = &args.out {
        write(out, &evaluation, &trials, baseline.as_ref().map(|(_, rivals)| rivals.as_slice()))?;
    }
    match args.json {
        true => println!("{}", serde_json::to_string_pretty(&evaluation)?),
        false => tables::print(&evaluation),
    }
    Ok(ExitCode::SUCCESS)
}

impl Baseline {
    /// What it is without.
    fn lacks(self) -> &'static str {
        match self {
            Self::Reactive => "anticipation",
            Self::Myopic => "anticipation and look-ahead",
            Self::Unguarded => "guard",
        }
    }
}

impl Ablated {
    fn ablation(self) -> Ablation {
        match self {
            Self::Oml => Ablation::Oml,
            Self::Csgl => Ablation::Csgl,
            Self::Eml => Ablation::Eml,
            Self::Noise => Ablation::Noise,
        }
    }
}

fn settings(args: &Args) -> Result<RunSettings> {
    let Installation { configuration, reaches, .. } = Installation::find()?;
    if args.seed.checked_add(args.trials).is_none() {
        bail!("--seed {}: too large for {} trials", args.seed, args.trials);
    }
    let shipped = RunSettings::shipped(&configuration);
    Ok(RunSettings {
        layout: match args.layout {
            Laid::Task => Layout::Task,
            Laid::Random => Layout::Random(args.seed),
        },
        seed: args.seed,
        partner: partner::setting(&args.partner, &reaches),
        world: args.world,
        person: args.person.clone().unwrap_or(shipped.person),
        ..shipped
    })
}

/// Reads all tasks, and what the partner means in each; their names.
fn tasks(args: &Args, settings: &RunSettings) -> Result<Vec<String>> {
    let shipped = std::slice::from_ref(&settings.task);
    let files = if args.task.is_empty() { shipped } else { &args.task };
    let name = |file: &PathBuf| {
        let (task, _) = NetworkPlan::load(file)?;
        Partner::load(&settings.partner, &task, settings.seed)?;
        Ok(task.name)
    };
    files.iter().map(name).collect()
}

fn recorded_people(models: &Path) -> Result<Vec<RecordedPerson>> {
    let Installation { configuration, reaches, .. } = Installation::find()?;
    eprintln!("making models of preshaping, each without one of the people");
    people::people(&reaches, &configuration, models)
}

fn assemble(
    args: &Args,
    (settings, people): (&RunSettings, &[RecordedPerson]),
    (network, guarded): (&NetworkVariant, bool),
    what: String,
) -> Result<Vec<Trial>> {
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let threads = args.threads.map_or(cores, usize::from);
    let style = ProgressStyle::with_template("{msg} {wide_bar} {pos}/{len}, {eta} left")?;
    let bar = ProgressBar::new(args.trials).with_style(style).with_message(what);
    let Args { trials, assemblies, .. } = *args;
    let tasks = args.task.as_slice();
    let planner_delay = args.planner_delay.unwrap_or_default();
    let campaign =
        Campaign { settings, tasks, people, network, guarded, planner_delay, trials, assemblies, threads };
    let trials = coact_evaluation::run(&campaign, || bar.inc(1));
    bar.finish_and_clear();
    Ok(trials?)
}

fn write(out: &Path, evaluation: &Evaluation, trials: &[Trial], baseline: Option<&[Trial]>) -> Result<()> {
    let save = |name: &str, text: String| {
        let path = out.join(name);
        std::fs::write(&path, text).with_context(|| format!("{}: cannot be written", path.display()))
    };
    save("evaluation.json", serde_json::to_string_pretty(evaluation)?)?;
    save("trials.jsonl", lines(trials)?)?;
    if let Some(baseline) = baseline {
        save("baseline.jsonl", lines(baseline)?)?;
    }
    draw_leads(trials, &out.join("leads.svg"))?;
    draw_timeline(trials, &out.join("timeline.svg"))?;
    let whole = evaluation.without.map_or("the robot".into(), |lacks| format!("with {lacks}"));
    let mut variants = vec![(whole.as_str(), &evaluation.report)];
    variants.extend(evaluation.baseline.as_ref().map(|report| ("without", report)));
    draw_fluency(&variants, &out.join("fluency.svg"))?;
    Ok(())
}

fn lines(trials: &[Trial]) -> Result<String> {
    let mut text = String::new();
    for trial in trials {
        writeln!(text, "{}", serde_json::to_string(trial)?)?;
    }
    Ok(text)
}
