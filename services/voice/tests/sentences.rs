//! What is said for hand-made frames of a hand-made task.

use coact_joint_task::{Act, Action, ActionType, Agent, Chain, Kind, Scene, Shape, Subgoal, Task};
use coact_messages::{FieldFrame, LayerKind, NONE};
use coact_voice::{Goal, Meanings, Mistake, Voice};

const ACTION_TYPES: [ActionType; 8] = [
    ActionType::Insert,
    ActionType::Request,
    ActionType::Receive,
    ActionType::Give,
    ActionType::Steady,
    ActionType::Point,
    ActionType::Speak,
    ActionType::Report,
];
const LAYERS: [LayerKind; 5] = [
    LayerKind::ActionObservation,
    LayerKind::SubgoalsAchieved,
    LayerKind::SubgoalsAvailable,
    LayerKind::Intention,
    LayerKind::ErrorMonitoring,
];

fn chain(name: &str, answer: &str) -> Chain {
    let (act, side) = (Act::Grasp { grip: 0, kind: 0 }, Agent::Person);
    let (name, answer) = (name.into(), Some(answer.into()));
    Chain { name, act, kind: 0, from: side, side, answer, pointing: false, says: Vec::new() }
}

fn subgoal(name: &str) -> Subgoal {
    let (name, axis, side) = (name.into(), [0.0, 0.0, 1.0], Agent::Robot);
    Subgoal {
        name,
        kind: 0,
        side,
        socket: [0.0; 3],
        axis,
        steadied: true,
        after: vec![],
        after_choices: vec![],
    }
}

/// Three subgoals; one action for each motor skill, all for the first subgoal.
fn task() -> Task {
    let action = |action_type: ActionType| {
        let rule = format!("{action_type:?}");
        Action { name: format!("{rule}: lid"), rule, action_type, kind: Some(0), subgoal: Some(0) }
    };
    Task {
        name: "box".into(),
        kinds: vec![Kind {
            name: "plate".into(),
            width: 0.05,
            shape: Shape::Box { size: [0.05; 3] },
            mass: 0.1,
        }],
        parts: vec![],
        subgoals: ["lid on the box", "hinge on the left", "foot below"].map(subgoal).into(),
        choices: Vec::new(),
        grips: vec![],
        gestures: vec![],
        acts: vec![],
        chains: vec![chain("mount", "Steady"), chain("hand over", "Receive")],
        actions: ACTION_TYPES.map(action).into(),
        scene: Scene {
            table_height: 0.0,
            table_centre: [0.0; 2],
            table_size: [1.0; 2],
            platform: [0.0; 3],
            platform_radius: 0.1,
            platform_height: 0.1,
            steady: vec![[0.0; 3]],
            handover: [0.0; 3],
            person_rest: [0.0; 3],
            person_shoulder: [0.0; 3],
            workspace: [[[0.0; 2]; 2]; 2],
            fit: coact_joint_task::Fit { position: 0.01, angle: 0.2 },
        },
        fingerprint: 42,
    }
}

fn voice() -> Voice {
    let goals = [0, 1].map(|chain| Some(Goal { chain, subgoal: 0 })).into();
    let errors = [Mistake::Goal(0), Mistake::Means(0), Mistake::Loss(0)].map(Some).into();
    Voice::new(&task(), Meanings { words: vec![None, Some(0), Some(1)], goals, errors })
}

/// A frame at rest; every layer has three populations.
fn frame(cycle: u64) -> Box<FieldFrame> {
    let mut frame: Box<FieldFrame> = bytemuck::zeroed_box();
    (frame.header.cycle, frame.task, frame.decision.action) = (cycle, 42, NONE);
    frame.layers.count = LAYERS.len() as u32;
    for (index, kind) in LAYERS.into_iter().enumerate() {
        frame.layers.kind[index] = kind as u32;
        frame.layers.first_population[index] = 3 * index as u32;
        frame.layers.populations[index] = 3;
    }
    frame
}

fn peak(frame: &mut FieldFrame, layer: LayerKind, index: usize, since: u64) {
    let first = frame.populations(layer).start;
    frame.since[first + index] = since;
}

fn decide(frame: &mut FieldFrame, action_type: ActionType, since: u64) {
    let action = ACTION_TYPES.iter().position(|&own| own == action_type);
    frame.decision.action = action.map_or(NONE, |index| index as u32);
    frame.decision.since = since;
}

/// What is said while a state lasts that `set` makes, from cycle 100 to 1000.
fn said(set: impl Fn(&mut FieldFrame)) -> Vec<(u64, String)> {
    let mut voice = voice();
    let frames = (1..1000).map(|cycle| {
        let mut frame = frame(cycle);
        if cycle >= 100 {
            set(&mut frame);
        }
        frame
    });
    frames.filter_map(|frame| voice.observe(&frame)).map(|said| (said.cycle, said.text)).collect()
}

#[test]
fn each_motor_skill_is_announced_once_when_its_decision_has_stood() {
    let sentences = ACTION_TYPES.map(|action_type| {
        let sentences = said(|frame| decide(frame, action_type, 100));
        assert!(sentences.iter().all(|(cycle, _)| *cycle == 250), "{sentences:?}");
        sentences.into_iter().map(|(_, text)| text).collect::<Vec<_>>().join(" | ")
    });
    insta::assert_snapshot!(sentences.join("\n"));
}

#[test]
fn the_inferred_goal_is_the_reason_only_for_its_own_answer() {
    let sentences = [ActionType::Steady, ActionType::Receive, ActionType::Insert].map(|action_type| {
        let goal = usize::from(action_type == ActionType::Receive);
        let sentences = said(|frame| {
            peak(frame, LayerKind::Intention, goal, 90);
            decide(frame, action_type, 100);
        });
        sentences[0].1.clone()
    });
    insta::assert_snapshot!(sentences.join("\n"));
}

#[test]
fn errors_are_explained_by_what_the_fields_hold() {
    let cases: [(&[usize], &[usize]); 4] = [(&[], &[]), (&[], &[1]), (&[], &[0, 1, 2]), (&[0], &[2])];
    let sentences = cases.map(|(achieved, available)| {
        let sentences = said(|frame| {
            achieved.iter().for_each(|&index| peak(frame, LayerKind::SubgoalsAchieved, index, 1));
            available.iter().for_each(|&index| peak(frame, LayerKind::SubgoalsAvailable, index, 1));
            peak(frame, LayerKind::ErrorMonitoring, 0, 80);
            decide(frame, ActionType::Speak, 100);
        });
        sentences[0].1.clone()
    });
    insta::assert_snapshot!(sentences.join("\n"));
}

#[test]
fn an_error_of_the_inferred_goal_is_told_in_the_terms_of_that_goal() {
    let sentences = said(|frame| {
        peak(frame, LayerKind::SubgoalsAvailable, 1, 1);
        peak(frame, LayerKind::Intention, 1, 60);
        peak(frame, LayerKind::ErrorMonitoring, 0, 80);
        decide(frame, ActionType::Speak, 100);
    });
    assert_eq!(sentences[0].1, "You cannot hand over the plate yet; first we need the hinge on the left.");
}

#[test]
fn errors_in_means_and_losses_are_told_with_what_is_done_about_them() {
    let sentences = [(1, ActionType::Point), (2, ActionType::Request), (2, ActionType::Report)].map(
        |(error, action_type)| {
            let sentences = said(|frame| {
                peak(frame, LayerKind::ErrorMonitoring, error, 80);
                decide(frame, action_type, 100);
            });
            sentences[0].1.clone()
        },
    );
    insta::assert_snapshot!(sentences.join("\n"));
}

#[test]
fn words_that_the_hand_belies_are_reported_and_words_that_it_bears_out_are_not() {
    let heard = |word: usize| {
        said(|frame| {
            peak(frame, LayerKind::ActionObservation, word, 70);
            peak(frame, LayerKind::Intention, 1, 90);
        })
    };
    let text = "You speak as if to mount the plate, but your hand is about to hand over the plate.";
    assert_eq!(heard(1), [(240, text.to_owned())]);
    assert_eq!(heard(2), []);
}

#[test]
fn a_short_change_of_mind_is_not_spoken_of() {
    let mut voice = voice();
    for cycle in 1..1000 {
        let mut frame = frame(cycle);
        let action_type = if cycle / 100 % 2 == 0 { ActionType::Insert } else { ActionType::Steady };
        decide(&mut frame, action_type, cycle / 100 * 100);
        assert_eq!(voice.observe(&frame), None, "{cycle}");
    }
}

#[test]
fn the_same_sentence_is_not_repeated_within_five_seconds() {
    let mut voice = voice();
    let mut cycles = Vec::new();
    for cycle in 1..9000 {
        let mut frame = frame(cycle);
        // The decision comes and goes every second.
        if cycle % 1000 >= 500 {
            decide(&mut frame, ActionType::Insert, cycle / 1000 * 1000 + 500);
        }
        cycles.extend(voice.observe(&frame).map(|said| said.cycle));
    }
    assert_eq!(cycles, [650, 5650]);
}

#[test]
fn a_restarted_voice_does_not_speak_of_old_decisions() {
    let mut voice = voice();
    for cycle in 5000..5400 {
        let mut frame = frame(cycle);
        decide(&mut frame, ActionType::Insert, 1000);
        assert_eq!(voice.observe(&frame), None);
    }
    let mut frame = frame(5600);
    decide(&mut frame, ActionType::Steady, 5400);
    assert!(voice.observe(&frame).is_some());
}

#[test]
fn frames_of_another_task_are_not_spoken_of() {
    let sentences = said(|frame| {
        decide(frame, ActionType::Insert, 100);
        frame.task = 43;
    });
    assert_eq!(sentences, []);
}
