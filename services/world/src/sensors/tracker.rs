use super::is_frame_due;
use bytemuck::{Pod, Zeroable};
use coact_messages::{HandView, Keypoint, KeypointName};
use coact_random::{RandomStreams, Stream};
use glam::DVec3;
use rand::RngExt;
use rand_distr::{Distribution, StandardNormal};

/// Frames per second.
const RATE: u64 = 60;
/// Scatter of a keypoint, m.
const POSITION: f64 = 0.002;
/// Share of frames that are lost.
const LOST_FRAMES: f64 = 0.01;
/// Share of keypoints that are lost in a frame.
const LOST_KEYPOINTS: f64 = 0.005;

/// The frame that was delivered last, and the one that is still being processed.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct TrackerState {
    pub delivered: HandView,
    pending: HandView,
    /// 1 if the pending frame will be delivered.
    is_pending: u64,
    /// 1 once a frame was delivered.
    has_delivered: u64,
}

impl PartialEq for TrackerState {
    fn eq(&self, other: &Self) -> bool {
        bytemuck::bytes_of(self) == bytemuck::bytes_of(other)
    }
}

/// What is before the camera.
pub(crate) enum Capture {
    /// The tracker is blind.
    Nothing,
    /// A simulated hand, m: the tracker's noise and gaps are added.
    Simulated([DVec3; 9]),
    /// A recorded one, with what its own detector misplaced and missed.
    Recorded([Keypoint; 9]),
}

/// When a frame is due: delivers the one before, and captures a new one. So a frame is one frame time old when it
/// comes. Keypoints that `hides` names are lost; a frame without any is not delivered.
pub(crate) fn track(
    tick: u64,
    last: Option<u64>,
    random: &RandomStreams,
    memory: &mut TrackerState,
    capture: impl FnOnce() -> Capture,
    hides: impl Fn([f64; 3]) -> bool,
) {
    if !is_frame_due(RATE, last, tick) {
        return;
    }
    if memory.is_pending == 1 {
        memory.pending.frame = memory.delivered.frame + memory.has_delivered;
        memory.delivered = memory.pending;
        memory.has_delivered = 1;
    }
    let (came, mut keypoints) = match capture() {
        Capture::Nothing => (false, [Keypoint::default(); 9]),
        Capture::Recorded(keypoints) => (true, keypoints),
        Capture::Simulated(points) => blur(tick, random, &points),
    };
    for point in keypoints.iter_mut().filter(|point| hides(point.position)) {
        *point = Keypoint::default();
    }
    let hand = &keypoints[KeypointName::Wrist as usize..];
    memory.is_pending = u64::from(came && hand.iter().any(|point| point.confidence > 0.0));
    memory.pending.captured_cycle = tick;
    memory.pending.keypoints = keypoints;
}

/// The tracker's own noise and gaps. The flag says whether the frame came through.
fn blur(tick: u64, random: &RandomStreams, points: &[DVec3; 9]) -> (bool, [Keypoint; 9]) {
    let mut rng = random.at(Stream::Tracker, tick);
    let seen = !rng.random_bool(LOST_FRAMES);
    let keypoints = points.map(|point| {
        let scatter = DVec3::from_array(std::array::from_fn(|_| StandardNormal.sample(&mut rng)));
        let confidence = rng.random_range(0.7..0.95);
        if rng.random_bool(LOST_KEYPOINTS) {
            return Keypoint::default();
        }
        Keypoint { position: (point + POSITION * scatter).into(), confidence }
    });
    (seen, keypoints)
}
