use crate::Settings;
use crate::person::PersonArm;
use crate::request::Request;
use crate::servo::PERIOD;
use coact_messages::{Decision, FieldFrame, Percept, ROBOT, SceneView, SensorSample, Sighting};
use coact_motion::Capsule;
use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion};

/// Touch below this is nothing, N.
const TOUCH: f64 = 0.02;
/// Evidence above this is believed.
const BELIEF: f64 = 0.5;
/// The person's wrist is at a place when nearer than this, m: a hand's length and some.
const HAND_LENGTH: f64 = 0.25;
/// A hand slower than this waits, m/s.
const WAITING: f64 = 0.25;
/// Nothing that concerns the robot is farther away than this, m.
const FAR: f64 = 10.0;

/// What the newest messages say, where they are young enough to say anything.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Senses<'a> {
    tick: u64,
    sample: Option<&'a SensorSample>,
    percept: Option<&'a Percept>,
    frame: Option<&'a FieldFrame>,
}

impl<'a> Senses<'a> {
    pub fn new(
        settings: &Settings,
        tick: u64,
        sample: Option<&'a SensorSample>,
        percept: Option<&'a Percept>,
        frame: Option<&'a FieldFrame>,
    ) -> Self {
        let young = |cycle: u64| tick.saturating_sub(cycle) <= settings.stale_after;
        Self {
            tick,
            sample: sample.filter(|message| young(message.header.cycle)),
            percept: percept.filter(|message| young(message.header.cycle)),
            frame: frame.filter(|message| young(message.header.cycle)),
        }
    }

    /// Whether a sensor sample or a field frame is missing: the robot must not move on.
    pub fn blind(&self) -> bool {
        self.sample.is_none() || self.frame.is_none()
    }

    /// The cycle.
    pub fn tick(&self) -> u64 {
        self.tick
    }

    pub fn decision(&self) -> Option<Decision> {
        self.frame.map(|frame| frame.decision)
    }

    /// Whether the fingers feel something; `None` when that is not known.
    pub fn touch(&self) -> Option<bool> {
        let touch = self.sample?.joints.touch;
        touch.is_finite().then_some(touch > TOUCH)
    }

    /// Frame of the part of this kind in workspace `workspace`, if one is believed to lie there.
    pub fn part(&self, workspace: usize, kind: usize) -> Option<Isometry3<f64>> {
        let seen = &self.percept?.workspace[workspace];
        let position = Point3::from(seen.position[kind]);
        if !(seen.seen[kind] > BELIEF && position.iter().all(|value| value.abs() < FAR)) {
            return None;
        }
        let [x, y, z, w] = seen.orientation[kind];
        let rotation = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-3);
        let rotation = rotation.filter(|rotation| rotation.coords.iter().all(|value| value.is_finite()));
        Some(Isometry3::from_parts(Translation3::from(position), rotation.unwrap_or_default()))
    }

    /// Places of all parts that are believed to lie in the robot's workspace.
    pub fn parts(&self) -> impl Iterator<Item = [f64; 3]> + Clone + use<'a> {
        let workspace = self.percept.map(|percept| &percept.workspace[ROBOT]);
        workspace.into_iter().flat_map(|workspace| {
            let seen = workspace.seen.iter().zip(workspace.position);
            seen.filter(|(seen, _)| **seen > BELIEF).map(|(_, position)| position)
        })
    }

    /// Whether the place of this subgoal is believed to be empty.
    pub fn open(&self, subgoal: usize) -> bool {
        self.percept.is_some_and(|percept| percept.open[subgoal] > BELIEF)
    }

    /// Kind of part that perception believes in the robot's hand, while the fingers feel something.
    pub fn in_robot_hand(&self) -> Option<usize> {
        let percept = self.percept.filter(|_| self.touch() == Some(true))?;
        percept.robot_holds.iter().position(|evidence| *evidence > BELIEF)
    }

    /// Whether the person holds a part of this kind.
    pub fn in_person_hand(&self, kind: usize) -> bool {
        self.percept.and_then(|percept| percept.person_holds.get(kind)).is_some_and(|holds| *holds > BELIEF)
    }

    /// Whether the person's hand holds nothing but perhaps a part of this kind.
    pub fn person_can_take(&self, kind: usize) -> bool {
        let other = |(own, evidence): (usize, &f64)| own != kind && *evidence > BELIEF;
        self.percept.is_some_and(|percept| !percept.person_holds.iter().enumerate().any(other))
    }

    /// Whether the person's hand waits at `place`.
    pub fn person_waits_at(&self, place: &Point3<f64>) -> bool {
        self.percept.is_some_and(|percept| {
            let hand = &percept.hand;
            let [x, y, z] = hand.velocity;
            let speed = (x * x + y * y + z * z).sqrt();
            let distance = (Point3::from(hand.wrist) - place).norm();
            hand.tracked == 1 && speed < WAITING && distance < HAND_LENGTH
        })
    }

    /// The person's arm with what the hand holds, when it is tracked. `hulls`: capsules around each kind of part.
    pub fn person_arm(&self, hulls: &[Capsule]) -> Option<PersonArm> {
        let scene = &self.sample?.scene;
        let held =
            parts_in(scene).iter().enumerate().filter(|(_, seen)| self.in_person_hand(seen.kind as usize));
        let hulls = held.filter_map(|(index, seen)| {
            Some((index, hulls.get(seen.kind as usize)?.within(&frame_of(seen)?)))
        });
        let ago = self.tick.saturating_sub(scene.captured_cycle) as f64 * PERIOD;
        Some(PersonArm::of(&self.percept?.hand, &self.sample?.hand)?.holding(hulls, ago))
    }

    /// Force with which somebody pulls or pushes at the hand and what it holds, N; `None` when it is not measured.
    pub fn pull(&self) -> Option<f64> {
        let [x, y, z] = self.sample?.joints.wrist_force;
        Some((x * x + y * y + z * z).sqrt()).filter(|force| force.is_finite())
    }

    /// Frame of the part of this kind that the recogniser's newest camera frame has nearest to `expected`, within
    /// `within` m; and the cycle of that camera frame.
    pub fn sighting(
        &self,
        kind: usize,
        expected: &Point3<f64>,
        within: f64,
    ) -> Option<(u64, Isometry3<f64>)> {
        let scene = &self.sample?.scene;
        let places = parts_in(scene).iter().filter(|sighting| sighting.kind as usize == kind);
        let near = places.map(|sighting| ((Point3::from(sighting.position) - expected).norm(), sighting));
        let nearest =
            near.filter(|(distance, _)| *distance < within).min_by(|one, other| one.0.total_cmp(&other.0));
        let (_, sighting) = nearest?;
        Some((scene.captured_cycle, frame_of(sighting)?))
    }

    /// All parts and screens in sight, into a request.
    pub fn surroundings(&self, request: &mut Request) {
        let Some(scene) = self.sample.map(|sample| &sample.scene) else { return };
        let parts = parts_in(scene);
        request.seen = parts.len();
        request.parts[..request.seen].copy_from_slice(parts);
        request.screened = (scene.occluders as usize).min(scene.occluder.len());
        request.screens[..request.screened].copy_from_slice(&scene.occluder[..request.screened]);
    }
}

/// Frame of a part as the recogniser has seen it; none when that is none.
pub(crate) fn frame_of(sighting: &Sighting) -> Option<Isometry3<f64>> {
    let [x, y, z, w] = sighting.orientation;
    let turn = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-3)?;
    let frame = Isometry3::from_parts(Translation3::from(sighting.position), turn);
    frame.translation.vector.iter().all(|value| value.is_finite()).then_some(frame)
}

/// The parts that the recogniser has seen, as many as a message can hold.
fn parts_in(scene: &SceneView) -> &[Sighting] {
    &scene.sighting[..(scene.sightings as usize).min(scene.sighting.len())]
}
