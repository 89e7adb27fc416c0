use super::*;
use coact_recordings::{Frame, ImagePoint, Size};
use std::path::Path;

fn reach(size: Size, trial: u32) -> Reach {
    let frame = |index: u32| Frame {
        time: f64::from(index) * 0.02 - 0.1,
        joints: [ImagePoint { x: 100.0 + f64::from(index * trial), y: 50.0, confidence: 0.7 }; 9],
    };
    Reach { participant: 1, size, trial, movement_time: 0.5, frames: (0..40).map(frame).collect() }
}

fn replay(reaches: &[Reach]) -> (Task, Replay) {
    let configuration = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
    let task = Task::load(&configuration.join("tasks/two-objects.toml")).unwrap();
    let robot = Robot::load(&configuration.join("robots/aros.toml")).unwrap();
    let person: Vec<&Reach> = reaches.iter().collect();
    let replay = Replay::new(&task, &robot, &person, |reach| has_part_for(&task, reach));
    (task, replay)
}

fn step(replay: &Replay, tick: u64) -> (Box<SensorSample>, Truth) {
    let (mut sample, mut truth) = (bytemuck::zeroed_box(), bytemuck::Zeroable::zeroed());
    replay.step(tick, &mut sample, &mut truth);
    (sample, truth)
}

#[test]
fn reaches_for_what_the_task_has_are_played_one_after_the_other() {
    let (_, replay) = replay(&[reach(Size::Large, 1), reach(Size::Medium, 1), reach(Size::Small, 2)]);
    let widths: Vec<f64> = replay.reaches().iter().map(|reach| reach.size.width()).collect();
    assert_eq!(widths, [Size::Large.width(), Size::Small.width()]);
    let [first, second] = replay.spans() else { panic!("two spans") };
    assert_eq!(*first, Span { begin: 1, onset: 801, contact: 1301, end: 701 + 780 + 600 });
    assert_eq!((second.begin, second.onset), (first.end, first.end + 800));
}

#[test]
fn every_frame_is_shown_once_at_its_time_and_the_hand_is_lost_in_between() {
    let (_, replay) = replay(&[reach(Size::Large, 1), reach(Size::Small, 2)]);
    let [first, second] = replay.spans() else { panic!("two spans") };
    let frame = |tick: u64| step(&replay, tick).0.hands[0].frame;
    assert_eq!(frame(first.begin), 0);
    assert_eq!(frame(first.onset) - frame(first.onset - 1), 1, "the frame of time 0");
    assert_eq!(frame(first.onset + 19), frame(first.onset));
    assert_eq!(frame(first.end - 1), frame(first.end - GAP), "nothing is seen between the reaches");
    assert!(frame(second.onset) > frame(first.end));
    let shown = step(&replay, first.onset + 7).0.hands[0];
    assert_eq!(shown.captured_cycle, first.onset);
}

#[test]
fn truth_tells_the_labels() {
    let (task, replay) = replay(&[reach(Size::Large, 1), reach(Size::Small, 2)]);
    let second = replay.spans()[1];
    let at = |tick: u64| step(&replay, tick).1;
    assert_eq!((at(5).actions, at(5).chain), (0, NONE));
    let truth = at(second.contact - 1);
    assert_eq!((truth.actions, truth.onset_cycle, truth.grasp_cycle), (2, second.onset, 0));
    assert_eq!(truth.phase, PartnerPhase::Reach as u32);
    let chain = &task.chains[truth.chain as usize];
    assert!((task.kinds[chain.kind].width - Size::Small.width()).abs() < 1e-9);
    assert_eq!(at(second.contact).grasp_cycle, second.contact);
    assert_eq!(at(second.end).phase, PartnerPhase::Idle as u32);
}
