//! Recorded reaches, played to the sensors as they were made: nothing is simulated, and nobody moves but the person.

mod camera;
mod span;

pub use span::Span;

use crate::world::parked;
use camera::{Camera, origin};
use coact_joint_task::{Agent, Task};
use coact_messages::{HandView, JOINTS, NONE, PartnerPhase, SensorSample, Truth};
use coact_period::{CYCLES_PER_SECOND, cycles};
use coact_recordings::Reach;
use coact_robot::Robot;
use std::time::Duration;

/// How long the hand lies still as in the first frame, before the recording begins, cycles: time for the fields to
/// take up what lies where. Chosen by hand.
const SETTLING: u64 = cycles(Duration::from_millis(700));
/// Time between two frames while it lies still, cycles: a camera of 60 Hz, as that of the recordings.
const STILL_FRAME_TIME: u64 = cycles(Duration::from_millis(17));
/// Time without frames after each reach, cycles: the tracker loses the hand, and finds it where the next reach begins.
/// Chosen by hand.
const GAP: u64 = cycles(Duration::from_millis(600));
/// Time from one frame of the part recogniser to the next, cycles: a camera of 30 Hz.
const SCENE_FRAME_TIME: u64 = cycles(Duration::from_millis(33));

/// Plays one person's recorded reaches, one after the other, at 1 kHz.
///
/// What it shows at a cycle depends on the cycle alone: it has no state that a crash could take.
pub struct Replay {
    camera: Camera,
    reaches: Vec<Reach>,
    spans: Vec<Span>,
    /// For each reach: where the resting wrist is, pixels.
    origins: Vec<[f64; 2]>,
    /// For each reach: index of the chain of acts that it begins, and of the subgoal that this serves.
    meaning: Vec<[u32; 2]>,
    frames: Vec<Delivery>,
    /// Where the robot's joints are, rad.
    joints: [f64; JOINTS],
}

/// A frame of the hand tracker.
#[derive(Debug, Clone, Copy)]
struct Delivery {
    cycle: u64,
    reach: usize,
    frame: usize,
}

/// Whether the task has a part of the width that was reached for.
pub fn has_part_for(task: &Task, reach: &Reach) -> bool {
    kind_of(task, reach).is_some()
}

fn kind_of(task: &Task, reach: &Reach) -> Option<usize> {
    task.kinds.iter().position(|kind| (kind.width - reach.size.width()).abs() < 1e-6)
}

impl Replay {
    /// Of all the reaches of one `person`, plays those that are to be `played`; the robot looks on from its park posture.
    pub fn new(task: &Task, robot: &Robot, person: &[&Reach], played: impl Fn(&Reach) -> bool) -> Self {
        let reaches: Vec<Reach> = person.iter().filter(|reach| played(reach)).copied().cloned().collect();
        let (mut spans, mut frames) = (Vec::new(), Vec::new());
        for (index, reach) in reaches.iter().enumerate() {
            let begin = spans.last().map_or(1, |last: &Span| last.end);
            spans.push(schedule(reach, begin, |cycle, frame| {
                frames.push(Delivery { cycle, reach: index, frame });
            }));
        }
        Self {
            camera: Camera::new(task, person),
            origins: reaches.iter().map(origin).collect(),
            meaning: reaches.iter().map(|reach| meaning(task, reach)).collect(),
            reaches,
            spans,
            frames,
            joints: parked(robot).position,
        }
    }

    /// The reaches that are played, in their order.
    pub fn reaches(&self) -> &[Reach] {
        &self.reaches
    }

    /// When each of them is played.
    pub fn spans(&self) -> &[Span] {
        &self.spans
    }

    /// What the sensors say at cycle `tick`, and the truth about it.
    pub fn step(&self, tick: u64, sample: &mut SensorSample, truth: &mut Truth) {
        sample.joints = bytemuck::Zeroable::zeroed();
        sample.drive = bytemuck::Zeroable::zeroed();
        sample.joints.position = self.joints;
        sample.hands = [self.hand(tick), bytemuck::Zeroable::zeroed()];
        sample.scene = bytemuck::Zeroable::zeroed();
        sample.scene.frame = tick / SCENE_FRAME_TIME;
        sample.scene.captured_cycle = sample.scene.frame * SCENE_FRAME_TIME;
        if sample.scene.frame > 0 {
            self.camera.show_parts(&mut sample.scene);
        }
        self.tell(tick, truth);
    }

    fn hand(&self, tick: u64) -> HandView {
        let mut view: HandView = bytemuck::Zeroable::zeroed();
        let delivered = self.frames.partition_point(|delivery| delivery.cycle <= tick);
        view.frame = delivered as u64;
        if let Some(last) = delivered.checked_sub(1).map(|index| self.frames[index]) {
            view.captured_cycle = last.cycle;
            self.camera.show_hand(
                &self.reaches[last.reach].frames[last.frame],
                self.origins[last.reach],
                &mut view,
            );
        }
        view
    }

    /// The labels, as the monitor wants to know them.
    fn tell(&self, tick: u64, truth: &mut Truth) {
        let header = truth.header;
        *truth = Truth { header, chain: NONE, subgoal: NONE, ..bytemuck::Zeroable::zeroed() };
        let begun = self.spans.partition_point(|span| span.onset <= tick);
        truth.actions = begun as u32;
        let Some(index) = begun.checked_sub(1) else { return };
        let span = self.spans[index];
        truth.onset_cycle = span.onset;
        truth.grasp_cycle = if tick >= span.contact { span.contact } else { 0 };
        let phase = match tick {
            _ if tick < span.contact => PartnerPhase::Reach,
            _ if tick < span.end => PartnerPhase::Act,
            _ => PartnerPhase::Idle,
        };
        truth.phase = phase as u32;
        if phase != PartnerPhase::Idle {
            [truth.chain, truth.subgoal] = self.meaning[index];
        }
    }
}

/// When `reach` is played if the hand comes into view at `begin`; `deliver` receives the cycle of each frame and its
/// place in the recording.
fn schedule(reach: &Reach, begin: u64, mut deliver: impl FnMut(u64, usize)) -> Span {
    let start = begin + SETTLING;
    let first = reach.frames.first().map_or(0.0, |frame| frame.time);
    let cycle_of = |time: f64| start + ((time - first) * CYCLES_PER_SECOND as f64).round() as u64;
    for back in (1..=SETTLING / STILL_FRAME_TIME).rev() {
        deliver(start - back * STILL_FRAME_TIME, 0);
    }
    for (index, frame) in reach.frames.iter().enumerate() {
        deliver(cycle_of(frame.time), index);
    }
    Span {
        begin,
        onset: cycle_of(0.0),
        contact: cycle_of(0.0) + (reach.movement_time * CYCLES_PER_SECOND as f64).round() as u64,
        end: reach.frames.last().map_or(start, |frame| cycle_of(frame.time)) + GAP,
    }
}

/// The chain of the person's acts that takes a part of the size, and the subgoal that it serves.
fn meaning(task: &Task, reach: &Reach) -> [u32; 2] {
    let kind = kind_of(task, reach);
    let chain = task.chains.iter().position(|chain| Some(chain.kind) == kind && chain.from == Agent::Person);
    let subgoal = chain.and_then(|chain| task.goal_of(chain, |_| true));
    [chain, subgoal].map(|index| index.map_or(NONE, |index| index as u32))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic, reason = "a test that cannot go on fails")]
mod tests;
