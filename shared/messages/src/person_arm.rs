use crate::Flaw;
use crate::plausible::{ensure, index, places, velocities};
use bytemuck::{Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;

/// One of the person's arms, estimated at this tick from the tracker's frames. The only estimate there is: whoever keeps a
/// distance from the person reads it, and reads no keypoint.
///
/// A joint that the newest frame lacks stands where it was seen last, moved along with the wrist. Its deviation says how
/// far that may be from the truth, and grows for as long as it is not seen.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable, ZeroCopySend)]
pub struct PersonArm {
    /// Shoulder.
    pub shoulder: TrackedPoint,
    /// Elbow.
    pub elbow: TrackedPoint,
    /// Wrist.
    pub wrist: TrackedPoint,
    /// The hand's far end: tip of the middle finger.
    pub fingertip: TrackedPoint,
    /// Age of the newest usable frame, cycles; `u64::MAX` before the first.
    pub age: u64,
    /// 1 while that frame is young enough to tell where the arm is now; else 0, and the arm may be anywhere within what
    /// the deviations allow.
    pub tracked: u32,
    /// Reserved, zero.
    pub reserved: u32,
}

/// One joint of the person's arm, estimated at this tick.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable, ZeroCopySend)]
pub struct TrackedPoint {
    /// Position, m, world frame. Always finite: a joint that was never seen is put where the others suggest.
    pub position: [f64; 3],
    /// Velocity, m/s.
    pub velocity: [f64; 3],
    /// Standard deviation of the position, m: the tracker's scatter, and what the joint may have moved since it was seen.
    /// Infinite while it was never seen.
    pub deviation: f64,
    /// Cycles since a frame showed it; `u64::MAX` while it was never seen.
    pub age: u64,
    /// Cycles for which it has been seen within 10 mm of one place: what is still for long rests, however fast the tracker's scatter
    /// makes it seem.
    pub still: u64,
}

impl PersonArm {
    /// Whether the tracker's evidence is young enough to tell where the arm is now.
    pub fn is_tracked(&self) -> bool {
        self.tracked == 1
    }

    /// Shoulder, elbow, wrist and fingertip.
    pub fn points(&self) -> [&TrackedPoint; 4] {
        [&self.shoulder, &self.elbow, &self.wrist, &self.fingertip]
    }
}

impl PersonArm {
    pub(crate) fn check(&self) -> Result<(), Flaw> {
        index("arms.tracked", self.tracked, 2)?;
        self.points().into_iter().try_for_each(|point| {
            places("arms.position", &point.position)?;
            velocities("arms.velocity", &point.velocity)?;
            ensure(point.deviation >= 0.0, "arms.deviation", "a number that is not negative")
        })
    }
}
