use super::frame_rate::is_frame_due;
use crate::parts::Parts;
use coact_messages::{SceneView, Sighting};
use coact_random::{RandomStreams, Stream};
use glam::{DQuat, DVec3};
use rand::{Rng, RngExt};
use rand_distr::{Distribution, StandardNormal};

/// Frames per second, as of usual depth cameras.
const RATE: u64 = 30;
/// Scatter of a sighting's position, m. Chosen by hand, as are the next two: of the size of what marker-less pose
/// estimation reaches on a table.
const POSITION: f64 = 0.002;
/// Scatter of its orientation, rad.
const ORIENTATION: f64 = 0.015;
/// Fraction of the sightings that the recogniser misses.
const MISSED: f64 = 0.02;
/// Confidence of those that it reports. Not sensitive: it only has to be high.
const CONFIDENCE: std::ops::Range<f64> = 0.85..0.99;

/// Takes a frame of all parts when one is due, from `eye` (m); parts in hands and mounted parts are seen where they are,
/// those behind one of the `occluders` are not.
pub(crate) fn recognise(
    tick: u64,
    last: Option<u64>,
    random: &RandomStreams,
    parts: &Parts,
    (eye, occluders): ([f64; 3], &[[f64; 6]]),
    view: &mut SceneView,
) {
    if !is_frame_due(RATE, last, tick) {
        return;
    }
    let mut rng = random.at(Stream::Recogniser, tick);
    view.frame += u64::from(last.is_some());
    view.captured_cycle = tick;
    view.sighting = [Sighting::default(); _];
    view.occluder = [[0.0; 6]; _];
    view.occluder[..occluders.len()].copy_from_slice(occluders);
    view.occluders = occluders.len() as u32;
    view.sightings = 0;
    for part in 0..parts.all().len() {
        let missed = rng.random_bool(MISSED);
        let sighting = sight(part, parts, &mut rng);
        if !missed && !view.hides(eye, parts.position(part).into(), 0.0) {
            view.sighting[view.sightings as usize] = sighting;
            view.sightings += 1;
        }
    }
}

/// One part as the recogniser sees it.
fn sight<R: Rng>(part: usize, parts: &Parts, rng: &mut R) -> Sighting {
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
