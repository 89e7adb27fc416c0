//! Made-up people with habits of their own: what is learned, and what the tested person's labels are not used for.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use coact_joint_task::{NetworkPlan, Task};
use coact_perception::PreshapeModel;
use coact_reaches::{Evaluation, ReachOutcome, ReachesReport, model_file, train};
use coact_recordings::{Frame, ImagePoint, Order, Reach, Size};
use coact_robot::Robot;
use std::path::PathBuf;

/// Scale of the made-up images: a forearm is 0.26 m long in them.
const METRES_PER_PIXEL: f64 = 0.008;

fn configuration(file: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../rt-config").join(file)
}

fn plan(file: &str) -> (Task, NetworkPlan) {
    NetworkPlan::load(&configuration(file)).unwrap()
}

fn robot() -> Robot {
    Robot::load(&configuration("robots/aros.toml")).unwrap()
}

/// A number in [-1, 1) that only its arguments decide.
fn scatter(parts: [u32; 4]) -> f64 {
    let mixed = parts.iter().fold(0x9E37_79B9_7F4A_7C15_u64, |hash, part| {
        (hash ^ u64::from(*part)).wrapping_mul(0xBF58_476D_1CE4_E5B9).rotate_left(27)
    });
    (mixed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

/// A reach of 0.44 m to an object of `size`, by a person who opens the hand by some offset of his own.
fn reach(participant: u32, size: Size, trial: u32) -> Reach {
    let movement_time = 0.55 + 0.04 * scatter([participant, size as u32, trial, 0]);
    let frames = (0..90)
        .map(|index| frame(participant, size, trial, index as f64 / 60.0 - 0.45, movement_time))
        .collect();
    Reach { participant, size, trial, movement_time, frames }
}

fn frame(participant: u32, size: Size, trial: u32, time: f64, movement_time: f64) -> Frame {
    let t = ((time + 0.06) / (movement_time + 0.06)).clamp(0.0, 1.0);
    let along = t * t * t * (10.0 + t * (-15.0 + 6.0 * t)) * 0.44;
    let habit = 0.02 * scatter([participant, 7, 7, 7]);
    let own = 0.004 * scatter([participant, size as u32, trial, 1]);
    let opening = (t / 0.7).min(1.0) * (0.05 + habit + own + size.width());
    let noise =
        |joint: u32| 0.001 * scatter([participant + 100 * trial, size as u32, joint, (time * 1000.0) as u32]);
    let at = |joint: u32, ahead: f64, aside: f64| ImagePoint {
        x: 110.0 + (along + ahead + noise(joint)) * 0.6 / METRES_PER_PIXEL - aside * 0.8 / METRES_PER_PIXEL,
        y: 100.0
            + (along + ahead + noise(joint + 50)) * 0.8 / METRES_PER_PIXEL
            + aside * 0.6 / METRES_PER_PIXEL,
        confidence: 0.8,
    };
    let half = 0.02 + 0.5 * opening;
    let joints = [
        at(0, -0.45, 0.2),
        at(1, -0.26, 0.0),
        at(2, 0.0, 0.0),
        at(3, 0.02, 0.02),
        at(4, 0.13, half),
        at(5, 0.09, 0.02),
        at(6, 0.15, -half),
        at(7, 0.16, -half),
        at(8, 0.08, -0.04),
    ];
    Frame { time, joints }
}

fn people(count: u32, trials: u32) -> Vec<Reach> {
    let mut all = Vec::new();
    for participant in 1..=count {
        for size in Size::ALL {
            all.extend((1..=trials).map(|trial| reach(participant, size, trial)));
        }
    }
    all
}

fn decide(file: &str, reaches: &[Reach], model: Option<&PreshapeModel>) -> Vec<ReachOutcome> {
    let (task, plan) = plan(file);
    let order = Order::Trial { seed: 3 };
    let evaluation = Evaluation { task: &task, plan: &plan, robot: &robot(), model, order, seed: 1 };
    evaluation.in_lockstep(&evaluation.subjects(reaches).unwrap()).unwrap()
}

#[test]
fn training_is_repeatable_bit_by_bit_and_survives_its_file() {
    let (task, _) = plan("tasks/three-objects.toml");
    let reaches = people(4, 4);
    let make = || {
        let model = train(&task, &robot(), &reaches, Order::Trial { seed: 1 }).unwrap();
        (model_file(&model, &reaches, "a test").unwrap(), model)
    };
    let ((text, model), (again, _)) = (make(), make());
    assert_eq!(text, again);
    assert_eq!(PreshapeModel::parse(&text).unwrap(), model);
    assert!(
        model.whole.mean.is_sorted_by(|a, b| a < b),
        "larger objects, larger coordinates: {:?}",
        model.whole.mean
    );
    let way = &model.movement.mean;
    let [along, aside] = way[way.len() - 1];
    assert!((along - 1.0).abs() < 1e-9 && aside.abs() < 1e-9, "all end where they end: {along} {aside}");
    assert!(way.windows(2).all(|pair| pair[1][0] > pair[0][0] - 0.01), "they go there: {way:?}");
}

#[test]
fn too_few_people_make_no_model() {
    let (task, _) = plan("tasks/three-objects.toml");
    let error = train(&task, &robot(), &people(2, 3), Order::File).unwrap_err();
    assert!(error.to_string().contains("three people"), "{error}");
}

#[test]
fn goals_of_unseen_people_are_decided_before_contact() {
    let report = ReachesReport::new("three", 3, decide("tasks/three-objects.toml", &people(4, 5), None));
    assert_eq!((report.overall.reaches, report.people.len()), (60, 4));
    assert!(report.overall.right_fraction > 0.85, "{:?}", report.overall);
    let two = ReachesReport::new("two", 2, decide("tasks/two-objects.toml", &people(4, 5), None));
    assert_eq!(two.overall.reaches, 40);
    assert!(two.overall.right_fraction > 0.95, "{:?}", two.overall);
    let lead = two.overall.lead_ms.unwrap();
    assert!(lead[0] > 0 && lead.is_sorted(), "{lead:?}");
}

/// What was decided, without what it is compared with.
fn decisions(outcomes: &[ReachOutcome], participant: u32) -> Vec<Option<(i64, u64)>> {
    let own = outcomes.iter().filter(|outcome| outcome.participant == participant);
    own.map(|outcome| outcome.decision.map(|decided| (decided.lead_ms, decided.width.to_bits()))).collect()
}

#[test]
fn labels_of_the_tested_person_change_no_decision_about_him() {
    let reaches = people(4, 4);
    let mut relabelled = reaches.clone();
    let own: Vec<usize> = (0..reaches.len()).filter(|index| reaches[*index].participant == 2).collect();
    for (place, index) in own.iter().enumerate() {
        relabelled[*index].size = Size::ALL[(place * 7 + 1) % 3];
    }
    let task = "tasks/three-objects.toml";
    let (as_labelled, otherwise) = (decide(task, &reaches, None), decide(task, &relabelled, None));
    assert_eq!(decisions(&as_labelled, 2), decisions(&otherwise, 2));
    assert_ne!(as_labelled, otherwise, "the judgement must change");
    let others = |participant| decisions(&as_labelled, participant) == decisions(&otherwise, participant);
    assert!(!(others(1) && others(3) && others(4)), "the other people's model must change");
}

/// The shipped recordings.
fn recorded() -> Vec<Reach> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../data/reaches");
    coact_recordings::read_folder(&folder).unwrap()
}

#[test]
fn the_shipped_model_is_what_the_shipped_recordings_make() {
    let (task, _) = plan("tasks/three-objects.toml");
    let reaches = recorded();
    let model = train(&task, &robot(), &reaches, Order::Trial { seed: 1 }).unwrap();
    let source = "github.com/nsoul97/object_size_prediction at 976a346";
    let shipped = std::fs::read_to_string(configuration("perception/preshape.toml")).unwrap();
    assert_eq!(model_file(&model, &reaches, source).unwrap(), shipped);
}

#[test]
fn goals_of_recorded_people_are_inferred_as_often_as_measured() {
    let reaches = recorded();
    for (task, goals, least) in [("tasks/three-objects.toml", 3, 0.78), ("tasks/two-objects.toml", 2, 0.95)] {
        let report = ReachesReport::new(task, goals, decide(task, &reaches, None));
        assert!(report.overall.right_fraction >= least, "{task}: {:?}", report.overall);
        assert!(report.overall.lead_ms.unwrap()[1] >= 100, "{task}: {:?}", report.overall);
    }
}
