//! A message of zeros, or one of a network, can be; garbage cannot. Judging is cheap beside a cycle.
#![allow(clippy::unwrap_used)]

use bytemuck::{Pod, zeroed_box};
use coact_messages::{
    Command, FieldFrame, HandPoints, Header, LayerKind, MAX_POPULATIONS, Percept, Plausible, Pulse,
    SensorSample, Speech, StopState, Truth, WorldState,
};
use std::hint::black_box;
use std::time::Instant;

/// Sites and populations of the toy vehicle's network.
const SITES: usize = 1920;
const POPULATIONS: usize = 192;

/// Checks a message with all bytes zero, and one with all bytes behind its header set: NaN, indices and counts without end.
fn refuses_garbage<T: Pod + Plausible>() {
    let mut message: Box<T> = zeroed_box();
    assert_eq!(message.check(), Ok(()), "{}", std::any::type_name::<T>());
    // The header is judged by who knows the time and the writer.
    bytemuck::bytes_of_mut(&mut *message)[size_of::<Header>()..].fill(0xff);
    assert!(message.check().is_err(), "{}", std::any::type_name::<T>());
}

#[test]
fn garbage_is_refused_and_messages_of_zeros_are_not() {
    refuses_garbage::<SensorSample>();
    refuses_garbage::<Percept>();
    refuses_garbage::<FieldFrame>();
    refuses_garbage::<Command>();
    refuses_garbage::<Pulse>();
    refuses_garbage::<Speech>();
    refuses_garbage::<StopState>();
    refuses_garbage::<Truth>();
    refuses_garbage::<WorldState>();
}

fn frame() -> Box<FieldFrame> {
    let mut frame: Box<FieldFrame> = zeroed_box();
    frame.layers.count = 1;
    frame.layers.kind[0] = LayerKind::ActionExecution as u32;
    frame.layers.sites[0] = SITES as u32;
    frame.layers.populations[0] = POPULATIONS as u32;
    frame
}

#[test]
fn each_number_of_a_frame_that_a_layer_uses_is_looked_at() {
    let bad = [f64::NAN, f64::INFINITY, -f64::INFINITY, 1e300, f64::from_bits(0xfff0_dead_beef_0001)];
    for value in bad {
        for site in 0..SITES {
            let mut frame = frame();
            frame.activity[site] = value;
            assert_eq!(frame.check().unwrap_err().field, "activity", "{site}: {value}");
        }
        let mut frame = frame();
        frame.activity[SITES] = value;
        assert_eq!(frame.check(), Ok(()), "no layer stands there");
    }
}

#[test]
fn a_frame_whose_layers_do_not_fit_into_it_is_refused() {
    let damage: [fn(&mut FieldFrame); 5] = [
        |frame| frame.layers.count = 17,
        |frame| frame.layers.kind[0] = 9,
        |frame| frame.layers.first_site[0] = u32::MAX,
        |frame| frame.layers.populations[0] = MAX_POPULATIONS as u32 + 1,
        |frame| frame.since[3] = 2,
    ];
    for damage in damage {
        let mut frame = frame();
        damage(&mut frame);
        assert!(frame.check().is_err());
    }
}

#[test]
fn a_force_that_is_not_measured_and_a_joint_that_is_lost_are_told_by_nan() {
    let mut sample: Box<SensorSample> = zeroed_box();
    sample.joints.wrist_force = [f64::NAN; 3];
    sample.hands[0].keypoints[2].position = [f64::NAN; 3];
    assert_eq!(sample.check(), Ok(()));
    sample.hands[0].keypoints[2].confidence = 0.5;
    assert_eq!(sample.check().unwrap_err().field, "hands.keypoints.position");
    sample.joints.position[3] = f64::NAN;
    assert_eq!(sample.check().unwrap_err().field, "joints.position");
}

#[test]
fn text_that_is_none_is_refused() {
    let mut speech: Box<Speech> = zeroed_box();
    speech.write("give me the wheel");
    assert_eq!(speech.check(), Ok(()));
    speech.text[0] = 0xff;
    assert_eq!(speech.check().unwrap_err().field, "text");
    speech.write("");
    speech.length = 257;
    assert!(speech.check().is_err());
}

/// Prints the cost (`--nocapture`); 200 us would be seen in every cycle, and are far above what a busy machine makes of some.
#[test]
fn judging_a_frame_costs_little_of_a_cycle() {
    let (frame, percept) = (frame(), zeroed_box::<Percept>());
    for (name, message) in [("FieldFrame", &*frame as &dyn Plausible), ("Percept", &*percept)] {
        let mut spans: Vec<_> = (0..2000)
            .map(|_| {
                let begin = Instant::now();
                assert!(black_box(black_box(message).check()).is_ok());
                begin.elapsed()
            })
            .collect();
        spans.sort_unstable();
        println!("{name}: {} ns median, {} ns p99", spans[1000].as_nanos(), spans[1980].as_nanos());
        assert!(spans[1000].as_micros() < 200, "{name}: {:?}", spans[1000]);
    }
}

#[test]
fn a_pulse_with_a_count_that_no_run_reaches_is_refused() {
    let pulse = Pulse { refused_topic: coact_messages::NONE, ..Pulse::default() };
    assert_eq!(pulse.check(), Ok(()));
    let header = Header { sequence: u64::MAX, ..Header::default() };
    assert_eq!(Pulse { header, ..pulse }.check().unwrap_err().field, "counts");
    assert_eq!(Pulse { missed: u64::MAX, ..pulse }.check().unwrap_err().field, "counts");
}

/// An arm that reaches over a table.
fn hand() -> Box<HandPoints> {
    let mut hand: Box<HandPoints> = zeroed_box();
    hand.position = [
        [-1.28, 0.12, 1.18],
        [-1.15, 0.05, 0.92],
        [-0.95, 0.14, 1.00],
        [-0.93, 0.16, 0.99],
        [-0.88, 0.18, 0.90],
        [-0.88, 0.16, 0.94],
        [-0.88, 0.10, 0.90],
        [-0.87, 0.09, 0.89],
        [-0.88, 0.10, 0.94],
    ];
    hand
}

#[test]
fn a_hand_is_near_finite_and_of_a_person_s_size() {
    assert_eq!(hand().check(), Ok(()));
    assert!(zeroed_box::<HandPoints>().check().is_err(), "all in one place is no hand");
    for joint in 0..9 {
        for value in [f64::NAN, f64::INFINITY, 5.1, -1e9] {
            let mut hand = hand();
            hand.position[joint][2] = value;
            assert!(hand.check().is_err(), "keypoint {joint} at {value}");
        }
    }
    for (joint, moved) in [(1, 0.5), (2, 0.6), (3, 0.2), (4, 0.3), (5, 0.3), (8, 0.3)] {
        let mut hand = hand();
        hand.position[joint][0] += moved;
        assert_eq!(hand.check().unwrap_err().field, "position", "keypoint {joint}");
    }
}
