use crate::person::PersonCapsules;
use coact_messages::{
    ARM_JOINTS, Decision, FieldFrame, Header, LayerKind, Percept, PersonArm, ROBOT, SceneView, SensorSample,
};
use coact_motion::Capsule;
use coact_period::{cycles, seconds};
use coact_robot::HAND_JOINTS;
use coact_safety::{SafetyLimits, StaleLimits};
use coact_seen_parts::{SHORTEST, SeenParts, frame_of};
use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion};
use std::time::Duration;

/// Touch below this is nothing, N. Chosen by hand: above a sensor's noise, and fingers that are closed on a part press far harder.
const TOUCH: f64 = 0.2;
/// Evidence above this is believed: more likely than not.
const BELIEF: f64 = 0.5;
/// The person's wrist is at a place when nearer than this, m: a hand's length and some.
const HAND_LENGTH: f64 = 0.25;
/// A hand slower than this waits, m/s. Chosen by hand: a hand that is held out sways, one that reaches is several times
/// faster.
const WAITING: f64 = 0.25;
/// An action is preshaped when its population has come so far from its resting level to its threshold. Chosen by hand: above what one source of
/// several alone excites it by; one that is decided has come by 0.8 or more.
const PRESHAPED: f64 = 0.25;
/// How much farther another one must have come for the hand to get ready for that one instead. Chosen by hand, above the noise of the layer.
const CLEARLY: f64 = 0.08;
/// Nothing that concerns the robot is farther away than this, m: it stands at a table. What is, is garbled.
const FAR: f64 = 10.0;

/// What the newest messages say, where they are young enough to say anything.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Inputs<'a> {
    tick: u64,
    sample: Option<&'a SensorSample>,
    percept: Option<&'a Percept>,
    frame: Option<&'a FieldFrame>,
    /// Cycles up to which what a camera frame has shown of the person's hand counts.
    hand_after: u64,
}

impl<'a> Inputs<'a> {
    /// Takes those messages that were sent within [`StaleLimits::input_after`] and descend from a sensor sample that is no older than that
    /// than the newest one: a stage that hears nothing any more sends on time, about the past.
    pub fn new(
        limits: &StaleLimits,
        tick: u64,
        sample: Option<&'a SensorSample>,
        percept: Option<&'a Percept>,
        frame: Option<&'a FieldFrame>,
    ) -> Self {
        let acquired_ns = sample.map_or(0, |sample| sample.header.sensor_ns);
        let fresh = |header: &Header| {
            let sent = tick.saturating_sub(header.cycle);
            let behind = Duration::from_nanos(acquired_ns.saturating_sub(header.sensor_ns));
            sent <= cycles(limits.input_after) && behind <= limits.input_after
        };
        Self {
            tick,
            sample: sample.filter(|message| fresh(&message.header)),
            percept: percept.filter(|message| fresh(&message.header)),
            frame: frame.filter(|message| fresh(&message.header)),
            hand_after: cycles(limits.hand_after),
        }
    }

    /// Whether a message is missing, or one of the person's arms has not been seen yet and may be anywhere: the robot must not move on.
    pub fn blind(&self) -> bool {
        let knows_person =
            self.percept.is_some_and(|percept| percept.arms.iter().all(|arm| arm.age < u64::MAX));
        self.sample.is_none() || self.frame.is_none() || !knows_person
    }

    /// The present cycle.
    pub fn tick(&self) -> u64 {
        self.tick
    }

    /// The newest decision; one that names no action is a decision as well.
    pub fn decision(&self) -> Option<Decision> {
        self.frame.map(|frame| frame.decision)
    }

    /// The action that is preshaped: of those that `can` be prepared, the one whose population in AEL is nearest to its threshold, unless it is hardly
    /// nearer than the `present` one. None where all are at rest.
    pub fn preshaped(&self, present: Option<usize>, can: impl Fn(usize) -> bool) -> Option<usize> {
        let frame = self.frame?;
        let excitation = |action: &usize| frame.excitation(LayerKind::ActionExecution, *action);
        let count = frame.populations(LayerKind::ActionExecution).len();
        let able = (0..count).filter(|action| excitation(action) > PRESHAPED && can(*action));
        let most = able.max_by(|one, other| excitation(one).total_cmp(&excitation(other)))?;
        let stays = |action: &usize| can(*action) && excitation(action) > excitation(&most) - CLEARLY;
        Some(present.filter(stays).unwrap_or(most))
    }

    /// Whether the fingers feel something; `None` when that is not known.
    pub fn touch(&self) -> Option<bool> {
        let touch = self.sample?.joints.touch;
        touch.is_finite().then_some(touch > TOUCH)
    }

    /// Measured angles of the hand's joints, rad; `None` when they are not known.
    pub fn fingers(&self) -> Option<[f64; HAND_JOINTS]> {
        let measured = &self.sample?.joints.position;
        let fingers = std::array::from_fn(|joint| measured[ARM_JOINTS + joint]);
        fingers.iter().all(|angle: &f64| angle.is_finite()).then_some(fingers)
    }

    /// Frame of the part of this kind in workspace `workspace`, if one is believed to lie there.
    pub fn part(&self, workspace: usize, kind: usize) -> Option<Isometry3<f64>> {
        let seen = &self.percept?.workspace[workspace];
        let position = Point3::from(seen.position[kind]);
        if !(seen.seen[kind] > BELIEF && position.iter().all(|value| value.abs() < FAR)) {
            return None;
        }
        let [x, y, z, w] = seen.orientation[kind];
        let rotation = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), SHORTEST);
        let rotation = rotation.filter(|rotation| rotation.coords.iter().all(|value| value.is_finite()));
        Some(Isometry3::from_parts(Translation3::from(position), rotation.unwrap_or_default()))
    }

    /// Places of all parts that are believed to lie in the robot's workspace.
    pub fn robot_parts(&self) -> impl Iterator<Item = [f64; 3]> + Clone + use<'a> {
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

    /// The person's acting arm, where perception tracks it and a camera frame has shown the hand recently enough.
    fn arm(&self) -> Option<&'a PersonArm> {
        let arm = self.percept.map(Percept::acting_arm);
        arm.filter(|arm| arm.is_tracked() && arm.age.saturating_add(self.percept_age()) <= self.hand_after)
    }

    /// Cycles since perception made the newest percept: one that is late, or the last one, tells of the past.
    fn percept_age(&self) -> u64 {
        self.percept.map_or(0, |percept| self.tick.saturating_sub(percept.header.cycle))
    }

    /// Whether the person's acting hand waits at `place`.
    pub fn person_waits_at(&self, place: &Point3<f64>) -> bool {
        self.arm().is_some_and(|arm| {
            let wrist = &arm.wrist;
            let [x, y, z] = wrist.velocity;
            let speed = (x * x + y * y + z * z).sqrt();
            let distance = (Point3::from(wrist.position) - place).norm();
            speed < WAITING && distance < HAND_LENGTH
        })
    }

    /// The person with whichever of the `parts` the hand holds, where she was seen last; none when she never was.
    /// `part_capsules`: around each kind of part.
    pub fn person(
        &self,
        parts: &SeenParts,
        part_capsules: &[Capsule],
        limits: &SafetyLimits,
    ) -> Option<PersonCapsules> {
        let held = parts.with_cycles().enumerate();
        // Where a hand has carried it since is not known of one that was not seen for long: it lies somewhere.
        let held = held.filter(|(_, (part, seen))| {
            self.in_person_hand(part.kind as usize) && !parts.is_covered_since(*seen)
        });
        let capsules = held.filter_map(|(index, (part, seen))| {
            let capsule = part_capsules.get(part.kind as usize)?.within(&frame_of(part)?);
            Some((index, capsule, seconds(self.tick.saturating_sub(seen))))
        });
        let person = PersonCapsules::of(self.percept?, self.percept_age(), &limits.person, &limits.stale)?;
        Some(person.holding(capsules, limits.person.carried_within))
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
        let places = scene.sightings().iter().filter(|sighting| sighting.kind as usize == kind);
        let near = places.map(|sighting| ((Point3::from(sighting.position) - expected).norm(), sighting));
        let nearest =
            near.filter(|(distance, _)| *distance < within).min_by(|one, other| one.0.total_cmp(&other.0));
        let (_, sighting) = nearest?;
        Some((scene.captured_cycle, frame_of(sighting)?))
    }

    /// What the recogniser sees.
    pub fn scene(&self) -> Option<&'a SceneView> {
        Some(&self.sample?.scene)
    }

    /// All obstacles in sight: centre and half extents, m.
    pub fn obstacles(&self) -> &'a [[f64; 6]] {
        self.sample.map_or(&[], |sample| sample.scene.obstacles())
    }
}
