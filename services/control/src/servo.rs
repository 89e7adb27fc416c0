use crate::Memory;
use crate::memory::{FINGER_JOINTS, split};
use coact_messages::{ARM_JOINTS, Command, JOINTS};
use coact_robot::{JointLimits, Limiter, MotionState, PointToPoint, Posture};

/// Length of a cycle, s.
pub(crate) const PERIOD: f64 = 1e-3;
/// How fast the pace of a movement changes at most, 1/s, and the change of that, 1/s².
const PACE: (f64, f64) = (4.0, 40.0);
/// How fast the pace goes to what it shall be, 1/s.
const PROMPT: f64 = 12.0;
/// What is tried of a change of pace when the whole of it would break a limit of a joint.
const TRIED: [f64; 4] = [1.0, 0.5, 0.0, -0.5];

/// Turns the movements in memory into setpoints, one cycle after the other, through the limiters.
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
    pub fn recall(&mut self, command: &Command) -> bool {
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
    pub fn launch_fingers(&self, memory: &mut Memory, target: [f64; FINGER_JOINTS]) {
        let start = if memory.fingers_arrived() {
            memory.finger_target.map(MotionState::at_rest)
        } else {
            memory.finger_movement().at(memory.finger_elapsed as f64 * PERIOD)
        };
        let halted = memory.fingers_halted == 1;
        match (!halted).then(|| PointToPoint::plan(start, target, &self.finger_limits())).flatten() {
            Some(movement) => memory.set_finger_movement(&movement),
            None => (memory.finger_target, memory.fingers_halted) = (target, 1),
        }
    }

    /// One cycle: the arm's course goes on at `pace`, the share of its own speed. With `go` false, or when a movement
    /// cannot be followed, the joints brake; when the fingers stand and `go` is true, theirs starts anew.
    pub fn advance(&mut self, memory: &mut Memory, go: bool, pace: f64) {
        if !go {
            (memory.arm_halted, memory.fingers_halted) = (1, 1);
        }
        if memory.arm_halted == 1 || !self.follow_course(memory, pace) {
            memory.arm_halted = 1;
            self.brake(0..ARM_JOINTS);
        }
        let fingers_stand = self.joints[ARM_JOINTS..].iter().all(Limiter::is_at_rest);
        if memory.fingers_halted == 1 && go && fingers_stand {
            let start = split(self.position()).1.map(MotionState::at_rest);
            let movement = PointToPoint::plan(start, memory.finger_target, &self.finger_limits());
            movement.into_iter().for_each(|movement| memory.set_finger_movement(&movement));
        }
        if memory.fingers_halted == 1 || !self.follow_fingers(memory) {
            memory.fingers_halted = 1;
            self.brake(ARM_JOINTS..JOINTS);
        }
    }

    /// Takes the next point of the course, as near to the wanted pace as the limiters allow; `false`, and nothing
    /// changed, when they refuse all.
    fn follow_course(&mut self, memory: &mut Memory, wanted: f64) -> bool {
        if memory.pace == wanted && memory.pace_change == 0.0 {
            let t = memory.elapsed + PERIOD * memory.pace;
            let accepted = self.take(0, &memory.course.at(t));
            memory.elapsed = if accepted { t } else { memory.elapsed };
            return accepted;
        }
        let change = (PROMPT * (wanted - memory.pace)).clamp(-PACE.0, PACE.0);
        let step = (change - memory.pace_change).clamp(-PACE.1 * PERIOD, PACE.1 * PERIOD);
        TRIED.iter().any(|share| {
            let mut pace_change = memory.pace_change + share * step;
            let mut pace = memory.pace + PERIOD * pace_change;
            if (pace - wanted).abs() < 1e-4 || !(0.0..=1.0).contains(&pace) {
                (pace, pace_change) =
                    (if (pace - wanted).abs() < 1e-4 { wanted } else { pace.clamp(0.0, 1.0) }, 0.0);
            }
            let t = memory.elapsed + PERIOD * pace;
            let accepted = self.take(0, &memory.course.at(t));
            if accepted {
                (memory.elapsed, memory.pace, memory.pace_change) = (t, pace, pace_change);
            }
            accepted
        })
    }

    fn follow_fingers(&mut self, memory: &mut Memory) -> bool {
        let next = if memory.fingers_arrived() {
            memory.finger_target.map(MotionState::at_rest)
        } else {
            memory.finger_movement().at((memory.finger_elapsed + 1) as f64 * PERIOD)
        };
        let accepted = self.take(ARM_JOINTS, &next);
        memory.finger_elapsed = memory.finger_elapsed.saturating_add(u64::from(accepted));
        accepted
    }

    /// Takes these setpoints for the joints from `first` on; `false`, and nothing changed, when a limiter refuses one.
    fn take(&mut self, first: usize, next: &[MotionState]) -> bool {
        let mut joints = self.joints;
        for (offset, wish) in next.iter().enumerate() {
            let joint = first + offset;
            match joints[joint].accept(wish.position, &self.limits[joint], PERIOD) {
                Some(accepted) => joints[joint] = accepted,
                None => return false,
            }
        }
        self.joints = joints;
        true
    }

    fn brake(&mut self, joints: std::ops::Range<usize>) {
        for joint in joints {
            self.joints[joint] = self.joints[joint].brake(&self.limits[joint], PERIOD);
        }
    }

    fn finger_limits(&self) -> [JointLimits; FINGER_JOINTS] {
        std::array::from_fn(|joint| self.limits[ARM_JOINTS + joint])
    }
}
