use crate::state::{ArmState, FINGER_JOINTS, FingerState, split};
use coact_messages::{ARM_JOINTS, Command, JOINTS};
use coact_period::PERIOD_S;
use coact_robot::{JointLimits, Limiter, MotionState, PointToPoint, Posture};
use coact_stage_state::Flag;

/// How fast the speed override changes at most, 1/s. This and the next two are chosen by hand, between an arm that stops in time
/// for the guard and one whose joints need more acceleration and jerk for that than they have; where they do, the limiters
/// refuse, and less is tried.
const MOST_RATE: f64 = 4.0;
/// How fast that rate changes at most, 1/s².
const MOST_RATE_CHANGE: f64 = 40.0;
/// Rate at which the override goes to the wanted one, per unit of their difference, 1/s.
const GAIN: f64 = 12.0;
/// An override this near to the wanted one has arrived: the step that is left is a ten-thousandth of the planned speed.
const ARRIVED: f64 = 1e-4;
/// Fractions of a change of the override that are tried when the whole of it would break a limit of a joint.
const TRIED: [f64; 4] = [1.0, 0.5, 0.0, -0.5];

/// Turns trajectories and finger movements into setpoints, one cycle after the other, through the limiters.
#[derive(Debug)]
pub(crate) struct Servo {
    /// The setpoints.
    pub joints: [Limiter; JOINTS],
    limits: [JointLimits; JOINTS],
}

impl Servo {
    pub fn new(limits: [JointLimits; JOINTS], position: [f64; JOINTS]) -> Self {
        Self { joints: position.map(Limiter::at_rest), limits }
    }

    /// Continues from the setpoints of `command`; `false` when they are not within the limits.
    pub fn resume(&mut self, command: &Command) -> bool {
        let joints: [Limiter; JOINTS] = std::array::from_fn(|joint| Limiter {
            position: command.position[joint],
            velocity: command.velocity[joint],
            acceleration: command.acceleration[joint],
        });
        let sound = joints.iter().zip(&self.limits).all(|(joint, limits)| {
            limits.contain(joint.position, 0.0)
                && joint.velocity.abs() <= limits.velocity
                && joint.acceleration.abs() <= limits.acceleration
        });
        if sound {
            self.joints = joints;
        }
        sound
    }

    /// Position setpoints, rad.
    pub fn position(&self) -> [f64; JOINTS] {
        self.joints.map(|joint| joint.position)
    }

    /// Those of the arm, rad.
    pub fn posture(&self) -> Posture {
        split(self.position()).0
    }

    /// Whether the arm's setpoints stand still.
    pub fn arm_stands(&self) -> bool {
        self.joints[..ARM_JOINTS].iter().all(Limiter::is_at_rest)
    }

    /// Starts a movement of the fingers from wherever the present one is. When none from there keeps the limits, they
    /// brake first.
    pub fn launch_fingers(&self, fingers: &mut FingerState, target: [f64; FINGER_JOINTS]) {
        let plan = || PointToPoint::plan(fingers.now(), target, &self.finger_limits());
        match (!fingers.braking.is_set()).then(plan).flatten() {
            Some(movement) => fingers.follow(&movement),
            None => fingers.brake(target),
        }
    }

    /// One cycle: the arm goes on along its trajectory at the wanted speed override, the fingers in their movement.
    pub fn advance(&mut self, arm: &mut ArmState, fingers: &mut FingerState, wanted_override: f64) {
        self.advance_arm(arm, wanted_override);
        self.advance_fingers(fingers);
    }

    /// One cycle of braking: all joints come to a stand within their limits.
    pub fn brake(&mut self, arm: &mut ArmState, fingers: &mut FingerState) {
        (arm.braking, fingers.braking) = (Flag::Set, Flag::Set);
        self.brake_joints(0..JOINTS);
    }

    /// Brakes when the trajectory cannot be followed.
    fn advance_arm(&mut self, arm: &mut ArmState, wanted_override: f64) {
        if arm.braking.is_set() || !self.follow_trajectory(arm, wanted_override) {
            arm.braking = Flag::Set;
            self.brake_joints(0..ARM_JOINTS);
        }
    }

    /// Brakes when the movement cannot be followed; when the fingers stand after braking, it starts anew.
    fn advance_fingers(&mut self, fingers: &mut FingerState) {
        let stand = self.joints[ARM_JOINTS..].iter().all(Limiter::is_at_rest);
        if fingers.braking.is_set() && stand {
            let start = split(self.position()).1.map(MotionState::at_rest);
            let movement = PointToPoint::plan(start, fingers.target, &self.finger_limits());
            movement.into_iter().for_each(|movement| fingers.follow(&movement));
        }
        if fingers.braking.is_set() || !self.follow_fingers(fingers) {
            fingers.braking = Flag::Set;
            self.brake_joints(ARM_JOINTS..JOINTS);
        }
    }

    /// Takes the next point of the trajectory, as near to the wanted speed override as the limiters allow; `false`, and
    /// nothing changed, when they refuse all.
    fn follow_trajectory(&mut self, arm: &mut ArmState, wanted: f64) -> bool {
        if arm.speed_override == wanted && arm.override_rate == 0.0 {
            return self.take_point(arm, arm.speed_override, 0.0);
        }
        let rate = (GAIN * (wanted - arm.speed_override)).clamp(-MOST_RATE, MOST_RATE);
        let most_change = MOST_RATE_CHANGE * PERIOD_S;
        let change = (rate - arm.override_rate).clamp(-most_change, most_change);
        TRIED.iter().any(|fraction| {
            let rate = arm.override_rate + fraction * change;
            let speed_override = arm.speed_override + PERIOD_S * rate;
            if (speed_override - wanted).abs() < ARRIVED {
                self.take_point(arm, wanted, 0.0)
            } else if (0.0..=1.0).contains(&speed_override) {
                self.take_point(arm, speed_override, rate)
            } else {
                self.take_point(arm, speed_override.clamp(0.0, 1.0), 0.0)
            }
        })
    }

    /// Takes the point of the trajectory to which it comes at this speed override; `false`, and nothing changed, when a
    /// limiter refuses it.
    fn take_point(&mut self, arm: &mut ArmState, speed_override: f64, override_rate: f64) -> bool {
        let elapsed = arm.elapsed + PERIOD_S * speed_override;
        let accepted = self.take(0, &arm.trajectory.at(elapsed));
        if accepted {
            (arm.elapsed, arm.speed_override, arm.override_rate) = (elapsed, speed_override, override_rate);
        }
        accepted
    }

    fn follow_fingers(&mut self, fingers: &mut FingerState) -> bool {
        let accepted = self.take(ARM_JOINTS, &fingers.next());
        if accepted {
            fingers.advance();
        }
        accepted
    }

    /// Takes these setpoints for the joints from `first` on; `false`, and nothing changed, when a limiter refuses one.
    fn take(&mut self, first: usize, next: &[MotionState]) -> bool {
        let mut joints = self.joints;
        for (offset, wish) in next.iter().enumerate() {
            let joint = first + offset;
            match joints[joint].accept(wish.position, &self.limits[joint], PERIOD_S) {
                Some(accepted) => joints[joint] = accepted,
                None => return false,
            }
        }
        self.joints = joints;
        true
    }

    fn brake_joints(&mut self, joints: std::ops::Range<usize>) {
        for joint in joints {
            self.joints[joint] = self.joints[joint].brake(&self.limits[joint], PERIOD_S);
        }
    }

    fn finger_limits(&self) -> [JointLimits; FINGER_JOINTS] {
        std::array::from_fn(|joint| self.limits[ARM_JOINTS + joint])
    }
}
