use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_messages::{ARM_JOINTS, ArmPath, Command};
use coact_period::PERIOD_S;
use coact_robot::{JointLimits, Knot, MotionState, PathProgress, state_at};
use coact_stage_state::{Flag, Implausible, ensure, finite};

/// The path of the command that was followed last, and how far the arm has come on it.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct FollowedPath {
    knots: [Knot; ArmPath::KNOTS],
    count: u64,
    pub progress: PathProgress,
    /// Whether the arm's setpoints lie on it.
    pub is_followed: Flag,
}

/// Setpoints lie on a path when they are this near to it, rad: rounding.
const EXACT: f64 = 1e-9;
/// No speed override changes faster, 1/s: in a cycle it would go from a standstill to the planned speed.
const MOST_RATE: f64 = 1e3;

impl FollowedPath {
    /// Takes over the path of a command. One that is no path, or that the command's setpoints do not lie on, is not followed.
    pub fn take(&mut self, command: &Command) {
        let path = &command.path;
        self.is_followed = Flag::Unset;
        if path.followed != 1 || !(1..=ArmPath::KNOTS as u64).contains(&path.count) {
            return;
        }
        let count = path.count as usize;
        self.knots[..count].copy_from_slice(bytemuck::cast_slice(&path.knots[..count]));
        self.count = path.count;
        self.progress = PathProgress {
            elapsed: path.elapsed,
            speed_override: path.speed_override,
            override_rate: path.override_rate,
        };
        let lies_on_it = || {
            let here = state_at(self.knots(), self.progress.elapsed);
            here.iter().zip(&command.position).all(|(here, there)| (here.position - there).abs() <= EXACT)
        };
        self.is_followed = Flag::from(self.check().is_ok() && lies_on_it());
    }

    /// State of the arm a cycle later if it goes on as it does, and the progress with that.
    pub fn next(&self) -> ([MotionState; ARM_JOINTS], PathProgress) {
        let PathProgress { elapsed, speed_override, override_rate } = self.progress;
        let speed_override = (speed_override + PERIOD_S * override_rate).clamp(0.0, 1.0);
        self.at(PathProgress { elapsed: elapsed + PERIOD_S * speed_override, speed_override, override_rate })
    }

    /// The same if it brakes with this fraction of what its joints can bear.
    pub fn braked(
        &self,
        limits: &[JointLimits; ARM_JOINTS],
        effort: f64,
    ) -> ([MotionState; ARM_JOINTS], PathProgress) {
        self.at(self.progress.towards(0.0, self.knots(), limits, effort, PERIOD_S))
    }

    fn at(&self, progress: PathProgress) -> ([MotionState; ARM_JOINTS], PathProgress) {
        (state_at(self.knots(), progress.elapsed), progress)
    }

    fn knots(&self) -> &[Knot] {
        &self.knots[..(self.count as usize).min(ArmPath::KNOTS)]
    }

    pub fn check(&self) -> Result<(), Implausible> {
        ensure(self.count <= ArmPath::KNOTS as u64, "drive.path", "as many knots as a path may have")?;
        finite("drive.path", bytemuck::cast_slice(self.knots()))?;
        let ascends = self.knots().windows(2).all(|pair| pair[0].t < pair[1].t);
        ensure(ascends, "drive.path", "knots in the order of their times")?;
        let PathProgress { elapsed, speed_override, override_rate } = self.progress;
        finite("drive.path.elapsed", &[elapsed])?;
        let is_fraction = (0.0..=1.0).contains(&speed_override);
        ensure(is_fraction, "drive.path.speed_override", "a fraction")?;
        ensure(override_rate.abs() <= MOST_RATE, "drive.path.override_rate", "a rate that it can have")
    }
}
