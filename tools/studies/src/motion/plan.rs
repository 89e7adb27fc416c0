//! `coact motion plan`: one movement, planned, drawn and written down.

use super::robot::RobotArgs;
use anyhow::{Context, Result, bail, ensure};
use coact_drawing::Lettering;
use coact_motion::{Goal, Obstacle, Plan, Problem, Scene, SegmentKind, Solid};
use coact_motion_suite::{MovementPage, Quality, Setting};
use coact_robot::{HandGoal, MotionState};
use nalgebra::{Isometry3, Point3, Vector3};
use serde::Serialize;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Plans one movement and writes movement.svg, movement.png and plan.json.
#[derive(Debug, clap::Args)]
#[command(after_help = "Examples:
  coact motion plan --to=-0.4,0.55,0.83 --task rt-config/tasks/toy-vehicle.toml --out motion
  coact motion plan --to=-0.4,0.55,0.83 --approach-length 0.15 --out motion
  coact motion plan --to=-0.5,0.3,1 --obstacle cylinder:-0.4,0.4,1,0.04,0.6 --out motion
  coact motion plan --to 0.4,0.2,-0.6 --robot arm.urdf --missing-meshes capsules --out motion
  coact motion plan --to=-0.4,0.55,0.9 --hand hand.urdf --missing-meshes capsules --out motion

Points are in the world frame (z up). A list of numbers that begins with a minus needs the equals
sign: --to=-0.4,...")]
pub struct Args {
    #[command(flatten)]
    robot: RobotArgs,
    /// Task whose table, base and parts are obstacles
    #[arg(long, value_name = "FILE")]
    task: Option<PathBuf>,
    /// Joint angles at the start, rad, with commas between [default: the park posture]
    #[arg(long, value_name = "ANGLES", value_delimiter = ',', allow_hyphen_values = true)]
    from: Vec<f64>,
    /// Point at which the hand grasps: x,y,z in m
    #[arg(long, value_name = "X,Y,Z", value_delimiter = ',', allow_hyphen_values = true)]
    to: Vec<f64>,
    /// Direction in which the hand approaches
    #[arg(long, value_name = "X,Y,Z", value_delimiter = ',', allow_hyphen_values = true, default_values_t = [0.0, 0.0, -1.0])]
    approach: Vec<f64>,
    /// Length of the straight approach before the goal, m
    #[arg(long, value_name = "M", default_value_t = 0.0)]
    approach_length: f64,
    /// Another obstacle: box:X,Y,Z,DX,DY,DZ or cylinder:X,Y,Z,RADIUS,HEIGHT (centre, then size, m)
    #[arg(long, value_name = "KIND:NUMBERS", allow_hyphen_values = true)]
    obstacle: Vec<String>,
    /// Folder for the files; it is made if it is not there
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// Approaches that make sense, m: a longer one would be a movement of its own. Chosen by hand.
const APPROACH_LENGTHS: RangeInclusive<f64> = 0.0..=0.5;
/// A direction that is shorter is none: far above rounding, far below what anybody types.
const ZERO_LENGTH: f64 = 1e-9;
/// Samples of plan.json in a second: enough to draw a movement from.
const SAMPLES_PER_SECOND: f64 = 100.0;

/// The content of plan.json.
#[derive(Serialize)]
struct Record<'a> {
    robot: &'a str,
    joints: Vec<&'a str>,
    quality: Quality,
    bounces: bool,
    segments: Vec<(&'static str, f64)>,
    /// Every 10 ms: time, s; positions, rad; velocities, rad/s.
    samples: Vec<(f64, Vec<f64>, Vec<f64>)>,
}

/// Plans, draws, writes and prints.
///
/// # Errors
/// Arguments or files that are refused, a movement that cannot be made, or a folder that cannot be written to.
pub fn run(args: Args) -> Result<ExitCode> {
    let setting = args.robot.setting(args.task.as_ref())?;
    let scene = scene(&args, &setting)?;
    let (start, goal) = (start(&args, &setting)?, Goal::Hand(vec![goal(&args)?]));
    let problem = Problem::new(&setting.mechanism, &setting.open, &scene, start, goal);
    let plan = problem.plan()?;
    let quality = Quality::of(&problem, &plan);
    let sheet = MovementPage { problem: &problem, plan: &plan }.draw();
    std::fs::create_dir_all(&args.out).with_context(|| format!("{}: cannot be made", args.out.display()))?;
    write(&args.out, "movement.svg", sheet.svg()?.as_bytes())?;
    write(&args.out, "movement.png", &sheet.png(&Lettering::new()?)?)?;
    write(&args.out, "plan.json", &serde_json::to_vec_pretty(&record(&setting, &plan, quality))?)?;
    println!(
        "{:.2} s, {}; {} peak(s) of the hand's speed, normalised jerk {:.0}, {:.2} mm from the goal, at least {:.0} mm clear",
        quality.duration_s,
        if plan.bounces { "around something" } else { "direct" },
        quality.units,
        quality.normalised_jerk,
        1e3 * quality.position_error,
        1e3 * quality.clearance
    );
    println!("{}", args.out.join("movement.svg").display());
    Ok(ExitCode::SUCCESS)
}

fn write(folder: &Path, name: &str, bytes: &[u8]) -> Result<()> {
    let file = folder.join(name);
    std::fs::write(&file, bytes).with_context(|| format!("{}: cannot be written", file.display()))
}

fn start(args: &Args, setting: &Setting) -> Result<[MotionState; 7]> {
    if args.from.is_empty() {
        return Ok(setting.mechanism.park.map(MotionState::at_rest));
    }
    let joints = &setting.mechanism.arm.joints;
    let count = joints.len();
    ensure!(args.from.len() == count, "--from has {} angles; this arm has {count} joints", args.from.len());
    let mut start = [MotionState::default(); 7];
    for ((state, angle), joint) in start.iter_mut().zip(&args.from).zip(joints) {
        let (low, high) = (joint.limits.lower, joint.limits.upper);
        ensure!(
            joint.limits.contain(*angle, 0.0),
            "--from: {angle} rad is outside the limits of \"{}\", {low:.3} to {high:.3} rad",
            joint.name
        );
        *state = MotionState::at_rest(*angle);
    }
    Ok(start)
}

fn goal(args: &Args) -> Result<HandGoal> {
    let three = |name: &str, values: &[f64]| -> Result<Vector3<f64>> {
        ensure!(values.len() == 3, "--{name} has {} numbers; expected X,Y,Z", values.len());
        Ok(Vector3::from_column_slice(values))
    };
    let approach = three("approach", &args.approach)?;
    let approach = approach.try_normalize(ZERO_LENGTH).context("--approach is zero; expected a direction")?;
    ensure!(
        APPROACH_LENGTHS.contains(&args.approach_length),
        "--approach-length {}: expected 0 to 0.5 m",
        args.approach_length
    );
    Ok(HandGoal {
        point: Point3::from(three("to", &args.to)?),
        approach,
        closing_axis: Vector3::y(),
        rolls: 0,
        along: approach,
        back: args.approach_length,
        floor: f64::NEG_INFINITY,
    })
}

fn scene(args: &Args, setting: &Setting) -> Result<Scene> {
    let mut scene = Scene::default();
    if let (Some(_), Some(task)) = (&args.task, &setting.task) {
        scene.obstacles = coact_workplace::fixtures(task);
        for (index, part) in task.parts.iter().enumerate() {
            let place = Isometry3::translation(part.at[0], part.at[1], task.scene.table_height);
            let kind = &task.kinds[part.kind];
            scene.obstacles.push(coact_workplace::upright(
                &format!("{} ({index})", kind.name),
                kind.shape,
                &place,
            ));
        }
    }
    for (index, text) in args.obstacle.iter().enumerate() {
        let (solid, place) = obstacle(text)?;
        scene.obstacles.push(Obstacle::new(format!("obstacle {}", index + 1), solid, &place));
    }
    Ok(scene)
}

fn obstacle(text: &str) -> Result<(Solid, Isometry3<f64>)> {
    let wrong = || {
        format!("--obstacle {text}: expected box:X,Y,Z,DX,DY,DZ or cylinder:X,Y,Z,RADIUS,HEIGHT, all in m")
    };
    let (kind, numbers) = text.split_once(':').with_context(wrong)?;
    let numbers: Vec<f64> = numbers
        .split(',')
        .map(|number| number.trim().parse())
        .collect::<Result<_, _>>()
        .with_context(wrong)?;
    let (solid, size) = match (kind, numbers.as_slice()) {
        ("box", [_, _, _, x, y, z]) => (Solid::Box(Vector3::new(*x, *y, *z)), &numbers[3..]),
        ("cylinder", [_, _, _, radius, height]) => {
            (Solid::Cylinder { radius: *radius, height: *height }, &numbers[3..])
        }
        _ => bail!(wrong()),
    };
    if !size.iter().all(|length| *length > 0.0 && length.is_finite()) {
        bail!("--obstacle {text}: expected sizes above zero");
    }
    Ok((solid, Isometry3::translation(numbers[0], numbers[1], numbers[2])))
}

fn record<'a>(setting: &'a Setting, plan: &Plan, quality: Quality) -> Record<'a> {
    let joints = setting.mechanism.joints();
    let samples = (0..=(plan.duration() * SAMPLES_PER_SECOND).ceil() as u32).map(|sample| {
        let t = (f64::from(sample) / SAMPLES_PER_SECOND).min(plan.duration());
        let states = plan.at(t);
        let column = |of: fn(&MotionState) -> f64| states[..joints].iter().map(of).collect();
        (t, column(|state| state.position), column(|state| state.velocity))
    });
    let name = |kind: &SegmentKind| match kind {
        SegmentKind::Leave => "leave",
        SegmentKind::Reach => "reach",
        SegmentKind::Approach => "approach",
    };
    Record {
        robot: &setting.mechanism.name,
        joints: setting.mechanism.arm.joints.iter().map(|joint| joint.name.as_str()).collect(),
        quality,
        bounces: plan.bounces,
        segments: plan.segments.iter().map(|(kind, end)| (name(kind), *end)).collect(),
        samples: samples.collect(),
    }
}
