use crate::Memory;
use coact_messages::{Command, JOINTS};
use coact_robot::{JointLimits, Limiter, MotionState, Movement};

/// Length of a cycle, s.
pub(crate) const PERIOD: f64 = 1e-3;

/// Turns the movement in memory into setpoints, one cycle after the other, through the limiters.
#[derive(Debug, Clone)]
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

    /// Starts a movement to `target` from wherever the present one is. When no movement from there keeps the limits,
    /// the robot brakes first.
    pub fn launch(&self, memory: &mut Memory, target: [f64; JOINTS], slowness: f64) {
        memory.slowness = slowness;
        if memory.halted == 1 {
            memory.target = target;
            return;
        }
        let start = if arrived(memory) {
            memory.target.map(MotionState::at_rest)
        } else {
            memory.movement().at(memory.elapsed as f64 * PERIOD)
        };
        match Movement::plan(start, target, &self.limits) {
            Some(movement) => memory.set_movement(&movement.slower(slowness)),
            None => {
                memory.target = target;
                memory.halted = 1;
            }
        }
    }

    /// One cycle. With `go` false, or when the movement cannot be followed, all joints brake; when all stand and
    /// `go` is true, the movement starts anew.
    pub fn advance(&mut self, memory: &mut Memory, go: bool) {
        if !go {
            memory.halted = 1;
        }
        if memory.halted == 1 && go && self.joints.iter().all(Limiter::is_at_rest) {
            let start = self.joints.map(|joint| MotionState::at_rest(joint.position));
            if let Some(movement) = Movement::plan(start, memory.target, &self.limits) {
                memory.set_movement(&movement.slower(memory.slowness));
                memory.halted = 0;
            }
        }
        if memory.halted == 0 && self.follow(memory) {
            return;
        }
        memory.halted = 1;
        for (joint, limits) in self.joints.iter_mut().zip(&self.limits) {
            *joint = joint.brake(limits, PERIOD);
        }
    }

    /// Takes the next point of the movement; `false`, and nothing changed, when a limiter refuses it.
    fn follow(&mut self, memory: &mut Memory) -> bool {
        let next = if arrived(memory) {
            memory.target.map(MotionState::at_rest)
        } else {
            memory.movement().at((memory.elapsed + 1) as f64 * PERIOD)
        };
        let mut joints = self.joints;
        for (joint, (wish, limits)) in joints.iter_mut().zip(next.iter().zip(&self.limits)) {
            match joint.accept(wish.position, limits, PERIOD) {
                Some(accepted) => *joint = accepted,
                None => return false,
            }
        }
        self.joints = joints;
        memory.elapsed = memory.elapsed.saturating_add(1);
        true
    }
}

/// Whether the movement has come to its end.
pub(crate) fn arrived(memory: &Memory) -> bool {
    progress(memory) >= 1.0
}

/// Share of its time that the movement has taken so far; 0 while braking.
pub(crate) fn progress(memory: &Memory) -> f64 {
    if memory.halted == 1 { 0.0 } else { memory.elapsed as f64 * PERIOD / memory.duration }
}
