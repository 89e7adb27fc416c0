use crate::plausible::{bounded, ensure, index, kind, orientations, places, subgoal, velocities};
use crate::{Flaw, Header, JOINTS, MAX_PARTS, Plausible};
use bytemuck::{Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;

/// The world's own state: what a restarted world resumes from. Read by the supervisor alone (1 kHz), which
/// keeps it as a checkpoint.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
#[type_name("coact::WorldState")]
pub struct WorldState {
    /// Header.
    pub header: Header,
    /// Fingerprint of the task; a state of another task is not resumed from.
    pub task: u64,
    /// Joint positions, rad.
    pub position: [f64; JOINTS],
    /// Joint velocities, rad/s.
    pub velocity: [f64; JOINTS],
    /// How many of `part` are valid.
    pub parts: u64,
    /// Every part of the scene.
    pub part: [PartState; MAX_PARTS],
    /// The simulation state in opaque words: partner, robot's hand and drive, sensors; `services/world` says what each holds.
    pub state: [f64; 2560],
}

/// Where one part is and who has it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, Pod, Zeroable, ZeroCopySend)]
pub struct PartState {
    /// Position, m.
    pub position: [f64; 3],
    /// Orientation, quaternion x, y, z, w.
    pub orientation: [f64; 4],
    /// Velocity, m/s.
    pub velocity: [f64; 3],
    /// Kind of part: index into the task's part kinds.
    pub kind: u32,
    /// 0 free, 1 in the robot's hand, 2 in the person's hand, 3 mounted.
    pub state: u32,
    /// Subgoal that it fulfils when mounted, or [`NONE`](crate::NONE).
    pub subgoal: u32,
    /// Reserved, zero.
    pub reserved: u32,
}

impl Plausible for WorldState {
    fn check(&self) -> Result<(), Flaw> {
        bounded("position", &self.position, 1e2)?;
        bounded("velocity", &self.velocity, 1e3)?;
        ensure(self.parts <= MAX_PARTS as u64, "parts", "no more than there is room for")?;
        self.part[..self.parts as usize].iter().try_for_each(PartState::check)
    }
}

impl PartState {
    fn check(&self) -> Result<(), Flaw> {
        places("part.position", &self.position)?;
        orientations("part.orientation", &[self.orientation])?;
        velocities("part.velocity", &self.velocity)?;
        kind("part.kind", self.kind)?;
        index("part.state", self.state, 4)?;
        subgoal("part.subgoal", self.subgoal)
    }
}
