use super::frame_rate::is_frame_due;
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_messages::{Flaw, HandView, Keypoint};
use coact_random::{RandomStreams, Stream};
use coact_stage_state::{Flag, Implausible, ensure};
use glam::DVec3;
use rand::{Rng, RngExt};
use rand_distr::{Distribution, StandardNormal};

/// Frames per second, as of usual cameras and of the recorded reaches.
const RATE: u64 = 60;
/// Scatter of a keypoint, m. Chosen by hand, as are the next two; perception is tested with them.
const POSITION: f64 = 0.002;
/// Fraction of the frames that are lost.
const LOST_FRAMES: f64 = 0.01;
/// Fraction of the keypoints that are lost in a frame.
const LOST_KEYPOINTS: f64 = 0.005;
/// Confidence of the others. Chosen by hand: about the upper half of what the detector of the recorded reaches gives.
const CONFIDENCE: std::ops::Range<f64> = 0.7..0.95;

/// The frame that was delivered last, and the one that is still being processed.
#[repr(C)]
#[derive(Debug, Clone, Copy, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct TrackerState {
    pub delivered: HandView,
    pending: HandView,
    /// Whether the pending frame will be delivered.
    is_pending: Flag,
    /// Set once a frame was delivered.
    has_delivered: Flag,
}

impl TrackerState {
    /// Refuses frames that no camera has counted so far.
    pub fn check(&self) -> Result<(), Implausible> {
        let frames = [self.delivered.frame, self.pending.frame];
        ensure(
            frames.iter().all(|frame| *frame <= u64::from(u32::MAX)),
            "tracker: frame",
            "a frame of this run",
        )
    }
}

impl TrackerState {
    /// Refuses keypoints that nobody could take in.
    pub fn check_views(&self) -> Result<(), Flaw> {
        self.delivered.check()?;
        self.pending.check()
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

/// Whether the tracker captures a frame after tick `last` and up to `tick`; the recogniser captures none at any other.
pub(crate) fn is_captured(last: Option<u64>, tick: u64) -> bool {
    is_frame_due(RATE, last, tick)
}

/// When a frame is due: delivers the one before, and captures a new one. So a frame is one frame time old when it
/// comes. `noise` is drawn for each arm by itself. Keypoints that `hides` names are lost; a frame without any, of the hand or of the rest
/// of the arm, is not delivered.
pub(crate) fn track(
    tick: u64,
    last: Option<u64>,
    (random, noise): (&RandomStreams, Stream),
    state: &mut TrackerState,
    capture: impl FnOnce() -> Capture,
    hides: impl Fn([f64; 3]) -> bool,
) {
    if !is_frame_due(RATE, last, tick) {
        return;
    }
    if state.is_pending.is_set() {
        state.pending.frame = state.delivered.frame + u64::from(state.has_delivered.is_set());
        state.delivered = state.pending;
        state.has_delivered = Flag::Set;
    }
    let (came, mut keypoints) = match capture() {
        Capture::Nothing => (false, [Keypoint::default(); 9]),
        Capture::Recorded(keypoints) => (true, keypoints),
        Capture::Simulated(points) => blur(random.at(noise, tick), &points),
    };
    for point in keypoints.iter_mut().filter(|point| hides(point.position)) {
        *point = Keypoint::default();
    }
    state.is_pending = Flag::from(came && keypoints.iter().any(|point| point.confidence > 0.0));
    state.pending.captured_cycle = tick;
    state.pending.keypoints = keypoints;
}

/// The tracker's own noise and gaps. The flag says whether the frame came through.
fn blur<R: Rng>(mut rng: R, points: &[DVec3; 9]) -> (bool, [Keypoint; 9]) {
    let seen = !rng.random_bool(LOST_FRAMES);
    let keypoints = points.map(|point| {
        let scatter = DVec3::from_array(std::array::from_fn(|_| StandardNormal.sample(&mut rng)));
        let confidence = rng.random_range(CONFIDENCE);
        if rng.random_bool(LOST_KEYPOINTS) {
            return Keypoint::default();
        }
        Keypoint { position: (point + POSITION * scatter).into(), confidence }
    });
    (seen, keypoints)
}
