use crate::state::{ArmState, FINGER_JOINTS, FingerState, split};
use coact_messages::{ARM_JOINTS, JOINTS};
use coact_period::PERIOD_S;
use coact_robot::{JointLimits, Limiter, MotionState, PathProgress, PointToPoint, Posture};
use coact_stage_state::Flag;

/// Fractions of what the joints can bear with which the override rises: nothing is urgent then, and a gentle start looks human.
const GENTLE: [f64; 3] = [0.4, 0.2, 0.0];

/// Turns trajectories and finger movements into setpoints, one cycle after the other, through the limiters.
#[derive(Debug)]
pub(crate) struct Servo {
    /// The setpoints.
    pub joints: [Limiter; JOINTS],
    limits: [JointLimits; JOINTS],
}

/// One step of the arm along its trajectory.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ArmStep {
    pub progress: PathProgress,
    joints: [Limiter; JOINTS],
}

impl Servo {
    pub fn new(limits: [JointLimits; JOINTS], position: [f64; JOINTS]) -> Self {
        Self { joints: position.map(Limiter::at_rest), limits }
    }

    /// Continues from these setpoints; `false`, and nothing changed, when they are not within the limits.
    pub fn resume(
        &mut self,
        position: &[f64; JOINTS],
        velocity: &[f64; JOINTS],
        acceleration: &[f64; JOINTS],
    ) -> bool {
        let joints: [Limiter; JOINTS] = std::array::from_fn(|joint| Limiter {
            position: position[joint],
            velocity: velocity[joint],
            acceleration: acceleration[joint],
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

    /// Greatest speed of the fingers' setpoints, rad/s.
    pub fn finger_speed(&self) -> f64 {
        self.joints[ARM_JOINTS..].iter().fold(0.0, |most, joint| joint.velocity.abs().max(most))
    }

    /// Time in which the fingers stand if they brake now, s.
    pub fn fingers_stop_in(&self) -> f64 {
        let fingers = self.joints[ARM_JOINTS..].iter().zip(&self.limits[ARM_JOINTS..]);
        fingers.fold(0.0, |longest, (joint, limits)| joint.stops_in(limits).max(longest))
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

    /// One cycle: the arm takes this step, or brakes; the fingers go on in their movement, or brake.
    pub fn advance(
        &mut self,
        arm: &mut ArmState,
        step: Option<ArmStep>,
        fingers: &mut FingerState,
        fingers_move: bool,
    ) {
        match step {
            Some(step) => self.take(arm, &step),
            None => self.brake_arm(arm),
        }
        if fingers_move {
            self.advance_fingers(fingers);
        } else {
            fingers.braking = Flag::Set;
            self.brake_joints(ARM_JOINTS..JOINTS);
        }
    }

    /// One cycle of braking: the arm along its trajectory, the fingers where they are.
    pub fn brake(&mut self, arm: &mut ArmState, fingers: &mut FingerState) {
        fingers.braking = Flag::Set;
        self.brake_arm(arm);
        self.brake_joints(ARM_JOINTS..JOINTS);
    }

    /// One cycle of braking along the trajectory; an arm that the limiters keep from that brakes joint by joint.
    fn brake_arm(&mut self, arm: &mut ArmState) {
        if let Some(step) = self.step_towards(arm, 0.0) {
            self.take(arm, &step);
        } else {
            arm.braking = Flag::Set;
            self.brake_joints(0..ARM_JOINTS);
        }
    }

    /// The arm's next step along the trajectory, if the override goes towards `wanted`; none when the limiters refuse all:
    /// the arm cannot go on along it.
    pub fn step_towards(&self, arm: &ArmState, wanted: f64) -> Option<ArmStep> {
        let efforts =
            if wanted < arm.progress.speed_override { &PathProgress::EFFORTS[..] } else { &GENTLE[..] };
        efforts.iter().find_map(|effort| {
            let limits = self.arm_limits();
            let progress = arm.progress.towards(wanted, arm.trajectory.knots(), limits, *effort, PERIOD_S);
            let joints = self.accept(0, &arm.trajectory.at(progress.elapsed))?;
            Some(ArmStep { progress, joints })
        })
    }

    fn take(&mut self, arm: &mut ArmState, step: &ArmStep) {
        (self.joints, arm.progress) = (step.joints, step.progress);
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

    fn follow_fingers(&mut self, fingers: &mut FingerState) -> bool {
        let Some(joints) = self.accept(ARM_JOINTS, &fingers.next()) else { return false };
        self.joints = joints;
        fingers.advance();
        true
    }

    /// All joints after those from `first` on have gone to these setpoints; none when a limiter refuses one.
    fn accept(&self, first: usize, next: &[MotionState]) -> Option<[Limiter; JOINTS]> {
        let mut joints = self.joints;
        for (offset, wish) in next.iter().enumerate() {
            let joint = first + offset;
            joints[joint] = joints[joint].accept(wish.position, &self.limits[joint], PERIOD_S)?;
        }
        Some(joints)
    }

    fn brake_joints(&mut self, joints: std::ops::Range<usize>) {
        for joint in joints {
            self.joints[joint] = self.joints[joint].brake(&self.limits[joint], PERIOD_S);
        }
    }

    /// Limits of the arm's joints.
    pub fn arm_limits(&self) -> &[JointLimits; ARM_JOINTS] {
        self.limits.first_chunk().unwrap_or_else(|| unreachable!("an arm has fewer joints than a robot"))
    }

    fn finger_limits(&self) -> [JointLimits; FINGER_JOINTS] {
        std::array::from_fn(|joint| self.limits[ARM_JOINTS + joint])
    }
}
