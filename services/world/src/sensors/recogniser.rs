use super::depth_camera::picture;
use super::frame_rate::is_frame_due;
use super::lines_of_sight::LinesOfSight;
use crate::parts::Parts;
use coact_joint_task::{Scene, Task};
use coact_messages::{MAX_PARTS, SceneView, Sighting, WORKSPACES};
use coact_period::cycles;
use coact_random::{RandomStreams, Stream, is_in_burst};
use glam::{DQuat, DVec3};
use rand::{Rng, RngExt};
use rand_distr::{Distribution, StandardNormal};
use std::ops::RangeInclusive;
use std::time::Duration;

/// Frames per second, as of usual depth cameras.
const RATE: u64 = 30;
/// Scatter of a sighting's position, m. Chosen by hand, as are the next two: of the size of what marker-less pose
/// estimation reaches on a table.
const POSITION: f64 = 0.002;
/// Scatter of its orientation, rad.
const ORIENTATION: f64 = 0.015;
/// Fraction of the sightings that the recogniser misses.
const MISSED: f64 = 0.02;
/// Fraction of the intervals in each of which a part is taken for one of another kind for some frames. Chosen by hand, as are the next three.
const MISTAKEN: f64 = 0.01;
/// These intervals, and for how long that lasts, cycles: 1 to 6 frames.
const MISTAKEN_INTERVAL: u64 = cycles(Duration::from_millis(500));
const MISTAKEN_FOR: RangeInclusive<u64> =
    cycles(Duration::from_millis(33))..=cycles(Duration::from_millis(200));
/// Fraction of the frames that show a part where there is none.
const IMAGINED: f64 = 0.01;
/// Confidence of those that it reports. Not sensitive: it only has to be high.
const CONFIDENCE: std::ops::Range<f64> = 0.85..0.99;

/// Takes a frame when one is due: a picture of depth, and all parts; parts in hands and mounted parts are seen where they are, those whose
/// upper face something hides from both cameras are not. Now and then a part is missed or taken for one of another kind, or one is seen where there is none.
pub(crate) fn recognise(
    tick: u64,
    last: Option<u64>,
    random: &RandomStreams,
    (task, parts): (&Task, &Parts),
    sight: &LinesOfSight,
    view: &mut SceneView,
) {
    if !is_frame_due(RATE, last, tick) {
        return;
    }
    let mut rng = random.at(Stream::Recogniser, tick);
    view.frame += u64::from(last.is_some());
    view.captured_cycle = tick;
    view.sighting = [Sighting::default(); _];
    view.obstacle = [[0.0; 6]; _];
    view.obstacle[..sight.boxes.len()].copy_from_slice(sight.boxes);
    view.obstacles = sight.boxes.len() as u32;
    view.sightings = 0;
    for part in 0..parts.all().len() {
        let missed = rng.random_bool(MISSED);
        let taken_for = taken_for(part, tick, random, task).unwrap_or(parts.kind(part));
        let sighting = Sighting { kind: taken_for as u32, ..sighting(part, parts, &mut rng) };
        let top = parts.position(part) + parts.orientation(part) * DVec3::Z * height(task, parts.kind(part));
        if !missed && is_seen(top.into(), sight, &task.scene) {
            view.sighting[view.sightings as usize] = sighting;
            view.sightings += 1;
        }
    }
    if rng.random_bool(IMAGINED) && (view.sightings as usize) < view.sighting.len() {
        view.sighting[view.sightings as usize] = imagine(task, &mut rng);
        view.sightings += 1;
    }
    picture(sight, &task.scene, &mut random.at(Stream::Depth, tick), &mut view.surface);
}

/// Whether a place is seen past what stands before it, by the camera of these lines of `sight` or by the one beside the table.
pub(crate) fn is_seen(place: [f64; 3], sight: &LinesOfSight, scene: &Scene) -> bool {
    let beside = LinesOfSight { eye: scene.eye_beside(), ..*sight };
    !sight.hide(place) || (scene.is_before_eye_beside(place) && !beside.hide(place))
}

fn height(task: &Task, kind: usize) -> f64 {
    task.kinds[kind].shape.height()
}

/// The kind that a part is mistaken for at `tick`, if it is.
fn taken_for(part: usize, tick: u64, random: &RandomStreams, task: &Task) -> Option<usize> {
    let interval = (tick / MISTAKEN_INTERVAL) * MAX_PARTS as u64 + part as u64;
    let mut rng = random.at(Stream::Mistaking, interval);
    let happens = is_in_burst(&mut rng, MISTAKEN, tick, MISTAKEN_INTERVAL, MISTAKEN_FOR);
    happens.then(|| rng.random_range(0..task.kinds.len()))
}

/// A part that is not there, anywhere in a workspace.
fn imagine<R: Rng>(task: &Task, rng: &mut R) -> Sighting {
    let [low, high] = task.scene.workspace[rng.random_range(0..WORKSPACES)];
    let [x, y] = [0, 1].map(|axis| low[axis] + rng.random::<f64>() * (high[axis] - low[axis]));
    Sighting {
        kind: rng.random_range(0..task.kinds.len()) as u32,
        reserved: 0,
        confidence: rng.random_range(CONFIDENCE),
        position: [x, y, task.scene.table_height],
        orientation: [0.0, 0.0, 0.0, 1.0],
    }
}

/// One part as the recogniser sees it.
fn sighting<R: Rng>(part: usize, parts: &Parts, rng: &mut R) -> Sighting {
    let confidence = rng.random_range(CONFIDENCE);
    let mut deviates = || DVec3::from_array(std::array::from_fn(|_| StandardNormal.sample(rng)));
    let position = parts.position(part) + POSITION * deviates();
    let turn = DQuat::from_scaled_axis(ORIENTATION * deviates()) * parts.orientation(part);
    Sighting {
        kind: parts.kind(part) as u32,
        reserved: 0,
        confidence,
        position: position.into(),
        orientation: turn.normalize().into(),
    }
}
