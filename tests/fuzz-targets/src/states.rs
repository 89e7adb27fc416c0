//! What a replacement resumes from: checkpoints with changes, whose checksum is right all the same.
//!
//! The checksum tells what was damaged; these targets ask what lies behind it. A stage need not send what is good then, since its
//! own numbers were changed to others that could be; but it goes on.

use crate::assembly::{INSTANTS, Instant};
use crate::messages::Stages;
use crate::patch::{patched, which};
use bytemuck::Pod;
use coact_messages::{FieldFrame, Plausible};
use coact_stage_state::seal_words;

/// How many cycles a stage goes on from what it has taken up.
const GOES_ON: u64 = 3;

/// The instant, and its message of which the words of the stage's state are changed and sealed again.
fn damaged<T: Pod>(
    bytes: &[u8],
    of: impl Fn(&Instant) -> &T,
    words: impl Fn(&mut T) -> &mut [f64],
) -> (&'static Instant, Box<T>) {
    let instant = &INSTANTS[which(bytes, INSTANTS.len())];
    let mut message = patched(of(instant), &[]);
    let state = words(&mut message);
    // The checksum is the last word that is not zero.
    let end = state.iter().rposition(|word| word.to_bits() != 0).unwrap_or_default();
    let changed = state.split_at_mut(end).0;
    crate::patch::apply(bytemuck::cast_slice_mut(changed), bytes);
    seal_words(state, end);
    (instant, message)
}

/// A frame is the network's state itself, with a checksum of its own.
pub(crate) fn fields(bytes: &[u8]) -> bool {
    let instant = &INSTANTS[which(bytes, INSTANTS.len())];
    let mut frame = patched(&*instant.frame, bytes);
    assert!(
        !frame.is_whole() || rows(&frame) == rows(&instant.frame),
        "a frame that was changed counts as whole"
    );
    frame.seal();
    Stages::with(|stages| {
        let resumed = stages.network.fits(&frame) && frame.check().is_ok();
        let ticks = instant.tick + 1..=instant.tick + GOES_ON;
        for tick in ticks.filter(|_| resumed) {
            let previous = frame.clone();
            stages.network.step(tick, Some(&instant.percept), &previous, &mut frame);
        }
        resumed
    })
}

/// The bits of what the next frame is computed from.
fn rows(frame: &FieldFrame) -> [&[u64]; 6] {
    let (sites, populations) = (frame.layers.used_sites(), frame.layers.used_populations());
    [
        bytemuck::cast_slice(&frame.destination[..frame.table.used()]),
        bytemuck::cast_slice(&frame.grip[..frame.shapes.used()]),
        bytemuck::cast_slice(&frame.activity[..sites]),
        bytemuck::cast_slice(&frame.resting[..populations]),
        bytemuck::cast_slice(&frame.signal[..populations]),
        &frame.since[..populations],
    ]
}

pub(crate) fn perception(bytes: &[u8]) -> bool {
    let (instant, percept) = damaged(bytes, |instant| &*instant.percept, |message| &mut message.state);
    Stages::with(|stages| {
        let resumed = stages.perception.resume(&percept).is_ok();
        let mut out = instant.percept.clone();
        for tick in instant.tick + 1..=instant.tick + GOES_ON {
            stages.perception.step(tick, Some(&instant.sample), &mut out);
        }
        resumed
    })
}

pub(crate) fn control(bytes: &[u8]) -> bool {
    let (instant, command) = damaged(bytes, |instant| &*instant.command, |message| &mut message.state);
    Stages::with(|stages| {
        let resumed = stages.control.resume(&command);
        let mut out = instant.command.clone();
        for tick in instant.tick + 1..=instant.tick + GOES_ON {
            let Instant { sample, percept, frame, .. } = instant;
            stages.control.step(tick, Some(sample), Some(percept), Some(frame), None, &mut out);
        }
        resumed
    })
}

pub(crate) fn world(bytes: &[u8]) -> bool {
    let (instant, damaged) = damaged(bytes, |instant| &*instant.state, |message| &mut message.state);
    Stages::with(|stages| {
        stages.world.resume(&instant.state).unwrap();
        let resumed = stages.world.resume(&damaged).is_ok();
        let Instant { sample, truth, state, .. } = instant;
        let (mut sample, mut truth, mut state) = (sample.clone(), truth.clone(), state.clone());
        for tick in instant.tick + 1..=instant.tick + GOES_ON {
            stages.world.step(tick, Some(&instant.command), &mut sample, &mut truth, &mut state);
        }
        // A person whose hand comes from outside does other things with the same state.
        if stages.live.resume(&instant.state).and_then(|()| stages.live.resume(&damaged)).is_ok() {
            for tick in instant.tick + 1..=instant.tick + GOES_ON {
                stages.live.step(tick, Some(&instant.command), &mut sample, &mut truth, &mut state);
            }
        }
        resumed
    })
}
