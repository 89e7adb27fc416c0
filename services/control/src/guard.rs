use crate::person_capsules::PersonCapsules;
use crate::robot::{CollisionModels, FingerShape, RobotModel};
use crate::state::ControlState;
use coact_motion::{Capsule, CollisionModel, Mechanism};
use coact_robot::{JointLimits, RobotError};
use coact_safety::GuardLimits;

/// Keeps the protective separation between the robot, with what it holds, and the person: says how fast the trajectory
/// under way may go on.
#[derive(Debug)]
pub(crate) struct Guard {
    limits: GuardLimits,
    mechanism: Mechanism,
    /// Arm and empty hand, the fingers ever farther closed.
    empty: Vec<CollisionModel>,
    /// Arm and hand with a part in it, in each grip of the table.
    holding: Vec<CollisionModel>,
    /// Limits of the fingers' bases.
    bases: JointLimits,
    /// Where the person is at the moment looked at.
    person: Vec<Capsule>,
}

/// Finger shapes of the empty hand for which there is a collision model. Chosen by hand, between memory and how far the
/// fingers are from the nearest of them; not sensitive: the hand moves among people with its fingers in a shape at rest.
const SHAPES: usize = 13;
/// Steps ahead at which leaving is compared with standing still, besides the last one: close together at first, where the
/// arm is nearest to the person.
const COMPARED: [u32; 3] = [1, 2, 4];

impl Guard {
    /// # Errors
    /// [`RobotError`] when the robot's collision geometry cannot be used.
    pub fn new(
        model: &RobotModel,
        models: &CollisionModels,
        limits: GuardLimits,
    ) -> Result<Self, RobotError> {
        let (hand, bases) = (&model.robot.hand, model.robot.hand.joints[1].limits);
        let base =
            |shape: usize| bases.lower + (bases.upper - bases.lower) * shape as f64 / (SHAPES - 1) as f64;
        let empty = (0..SHAPES).map(|shape| models.of(&[hand.posture(base(shape))], None));
        let holding = model.grips.all().iter().enumerate().map(|(index, grip)| {
            let closed = model.hand_angles(FingerShape::Closed(index));
            models.of(&[closed], Some((grip.kind, grip.in_palm)))
        });
        Ok(Self {
            limits,
            mechanism: models.mechanism.clone(),
            empty: empty.collect::<Result<_, _>>()?,
            holding: holding.collect::<Result<_, _>>()?,
            bases,
            person: Vec::with_capacity(PersonCapsules::MOST),
        })
    }

    /// Speed override at which the trajectory under way may go on, with a part held in `grip`, or with an empty hand whose
    /// finger closure is `closure` rad.
    ///
    /// Where the protective separation will be violated within the horizon, the arm slows down in proportion to the time that
    /// is left, and stands when that is the time that it takes to stop. Where it is violated already, the arm stands, unless
    /// it leaves the person.
    pub fn speed_override(
        &mut self,
        state: &ControlState,
        grip: Option<usize>,
        closure: f64,
        person: &PersonCapsules,
    ) -> f64 {
        let GuardLimits { protective_separation, horizon_steps, .. } = self.limits;
        let (horizon, stopped) =
            (self.limits.horizon.as_secs_f64(), self.limits.stopped_within.as_secs_f64());
        let ahead = |step: u32| horizon / f64::from(horizon_steps) * f64::from(step);
        let mut violates = |ahead: f64| {
            let t = state.arm.elapsed + ahead;
            self.separation(state, grip, closure, person, (t, ahead), protective_separation)
                < protective_separation
        };
        if violates(0.0) {
            let leaves = self.leaves(state, grip, closure, person, ahead);
            return if leaves { self.limits.escape_override } else { 0.0 };
        }
        let violated = (1..=horizon_steps).map(ahead).find(|ahead| violates(*ahead));
        violated.map_or(1.0, |ahead| ((ahead - stopped) / (horizon - stopped)).clamp(0.0, 1.0))
    }

    /// Whether going on brings the arm away from a person who is too near: at the horizon it is farther away than if it
    /// stood still, and nowhere on the way is it nearer than that. The person moves on in both cases.
    fn leaves(
        &mut self,
        state: &ControlState,
        grip: Option<usize>,
        closure: f64,
        person: &PersonCapsules,
        ahead: impl Fn(u32) -> f64,
    ) -> bool {
        let now = state.arm.elapsed;
        let steps = COMPARED.into_iter().chain([self.limits.horizon_steps]);
        let gains = steps.map(ahead).map(|ahead| {
            let mut separation =
                |t: f64| self.separation(state, grip, closure, person, (t, ahead), f64::INFINITY);
            separation(now + ahead) - separation(now)
        });
        let (least, last) = gains.fold((0.0, 0.0), |(least, _): (f64, f64), gain| (least.min(gain), gain));
        least > -self.limits.escape_loss && last > self.limits.escape_gain
    }

    /// Distance between the robot at time `t` of the trajectory, s, and the person `ahead` s from now, m; `most` when it is
    /// more. Where the hands shall touch, without the robot's.
    fn separation(
        &mut self,
        state: &ControlState,
        grip: Option<usize>,
        closure: f64,
        person: &PersonCapsules,
        (t, ahead): (f64, f64),
        most: f64,
    ) -> f64 {
        self.person.clear();
        self.person.extend(person.after(ahead));
        let model = match grip.and_then(|grip| self.holding.get(grip)) {
            Some(holding) => holding,
            None => &self.empty[self.shape(closure)],
        };
        let with_hand = !state.may_touch_person(t);
        model.distance(&self.mechanism, &state.arm.trajectory.posture(t), &self.person, with_hand, most)
    }

    /// The collision model of an empty hand that is most like one with this finger closure, rad.
    fn shape(&self, closure: f64) -> usize {
        let fraction = (closure - self.bases.lower) / (self.bases.upper - self.bases.lower);
        (fraction * (SHAPES - 1) as f64).round().clamp(0.0, (SHAPES - 1) as f64) as usize
    }
}
