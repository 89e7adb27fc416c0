use crate::plausible::{bounded, ensure, fractions, kind, not_after, orientations, places};
use crate::{DriveReport, Flaw, Header, Heard, JOINTS, MAX_PARTS, Plausible, Surface};
use bytemuck::{Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;

/// All that the robot's sensors say at one tick (1 kHz). Camera sections repeat until their next frame.
///
/// Lengths in m, angles in rad, world frame.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
#[type_name("coact::SensorSample")]
pub struct SensorSample {
    /// Header; `sensor_ns` is the instant of acquisition.
    pub header: Header,
    /// Joint encoders of arm and hand, every tick.
    pub joints: JointReading,
    /// What the side that drives the joints does with the commands, every tick.
    pub drive: DriveReport,
    /// The hand tracker's newest frame of each arm, by [`ArmSide`](crate::ArmSide).
    pub hands: [HandView; 2],
    /// The object recogniser's newest frame.
    pub scene: SceneView,
    /// What the person said last.
    pub heard: Heard,
}

/// Proprioception: joint encoders, fingertip touch and the force at the wrist.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
pub struct JointReading {
    /// Measured positions, rad; see [`JOINTS`](crate::JOINTS) for the order.
    pub position: [f64; JOINTS],
    /// Measured velocities, rad/s.
    pub velocity: [f64; JOINTS],
    /// Force that the fingers exert on what they hold, N, as the mean of the last 30 ms: contacts chatter from step to
    /// step, and a force sensor has no more than such a bandwidth. About 0 when they touch nothing.
    pub touch: f64,
    /// Force that something outside exerts on the hand and on what it holds, N, world frame, without the weight and the
    /// inertia of both: 0 while nobody pulls and nothing is in the way. NaN: not measured.
    ///
    /// The world with dynamics measures it at the contacts, along their normals and without friction, as a mean of 30 ms;
    /// the person's pull goes through there. Without dynamics, and where a part is pressed into the open hand, it is the
    /// force of the person's model.
    pub wrist_force: [f64; 3],
}

/// One frame of the hand tracker, of one arm.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
pub struct HandView {
    /// Frames delivered before this one; unchanged while no new frame came. A dropped frame delivers nothing.
    pub frame: u64,
    /// Cycle at which the frame was captured.
    pub captured_cycle: u64,
    /// Keypoints in the order of [`KeypointName`].
    pub keypoints: [Keypoint; 9],
}

/// One joint of a person's arm or hand.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, Pod, Zeroable, ZeroCopySend)]
pub struct Keypoint {
    /// Position, m, world frame.
    pub position: [f64; 3],
    /// The detector's confidence, 0..1; 0 = joint lost in this frame.
    pub confidence: f64,
}

/// Index of each keypoint in [`HandView::keypoints`]; the order of the recordings' columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(usize)]
#[allow(missing_docs, reason = "the names are the anatomical terms")]
pub enum KeypointName {
    Shoulder = 0,
    Elbow = 1,
    Wrist = 2,
    PalmBase = 3,
    ThumbTip = 4,
    IndexKnuckle = 5,
    IndexTip = 6,
    MiddleTip = 7,
    LittleKnuckle = 8,
}

/// One frame of the object recogniser.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
pub struct SceneView {
    /// Frames delivered before this one.
    pub frame: u64,
    /// Cycle at which the frame was captured.
    pub captured_cycle: u64,
    /// How many of `sightings` are valid.
    pub sightings: u32,
    /// How many of `obstacle` are valid.
    pub obstacles: u32,
    /// Recognised parts. A part that is occluded, or missed by the recogniser, is absent.
    pub sighting: [Sighting; MAX_PARTS],
    /// Boxes that stand on the table besides the parts, for the arm to keep clear of: centre and half extents, m.
    pub obstacle: [[f64; 6]; 4],
    /// What of all this is in view: the same frame's picture of depth.
    pub surface: Surface,
}

impl SceneView {
    /// The recognised parts, as many as are valid.
    pub fn sightings(&self) -> &[Sighting] {
        &self.sighting[..(self.sightings as usize).min(self.sighting.len())]
    }

    /// The obstacles that are valid: centre and half extents, m.
    pub fn obstacles(&self) -> &[[f64; 6]] {
        &self.obstacle[..(self.obstacles as usize).min(self.obstacle.len())]
    }
}

/// One recognised part. The recogniser names the kind, not the individual.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable, ZeroCopySend)]
pub struct Sighting {
    /// Kind of part: index into the task's part kinds.
    pub kind: u32,
    /// Reserved, zero.
    pub reserved: u32,
    /// The recogniser's confidence, 0..1.
    pub confidence: f64,
    /// Position of the part's grasp frame, m.
    pub position: [f64; 3],
    /// Orientation of that frame, quaternion x, y, z, w.
    pub orientation: [f64; 4],
}

/// No joint turns farther than this, rad, or faster, rad/s; no hand presses harder than this, N.
const MOST: [f64; 3] = [1e2, 1e3, 1e6];

impl Plausible for SensorSample {
    fn check(&self) -> Result<(), Flaw> {
        self.joints.check()?;
        not_after("hands.captured_cycle", &self.header, &self.hands.map(|hand| hand.captured_cycle))?;
        self.hands.iter().try_for_each(HandView::check)?;
        not_after("scene.captured_cycle", &self.header, &[self.scene.captured_cycle])?;
        self.scene.check()?;
        self.heard.check(&self.header)
    }
}

impl JointReading {
    fn check(&self) -> Result<(), Flaw> {
        bounded("joints.position", &self.position, MOST[0])?;
        bounded("joints.velocity", &self.velocity, MOST[1])?;
        bounded("joints.touch", &[self.touch], MOST[2])?;
        let force = |force: &f64| force.is_nan() || force.abs() <= MOST[2];
        ensure(self.wrist_force.iter().all(force), "joints.wrist_force", "a force, or NaN: not measured")
    }
}

impl HandView {
    /// Looks for a keypoint that is not what it can be: the world keeps frames in its own state, and judges them when it
    /// resumes.
    ///
    /// # Errors
    /// The first such field.
    pub fn check(&self) -> Result<(), Flaw> {
        self.keypoints.iter().try_for_each(Keypoint::check)
    }
}

impl Keypoint {
    fn check(&self) -> Result<(), Flaw> {
        fractions("hands.keypoints.confidence", &[self.confidence])?;
        // Where a joint that was lost would be means nothing.
        if self.confidence == 0.0 { Ok(()) } else { places("hands.keypoints.position", &self.position) }
    }
}

impl SceneView {
    /// Looks for a field that is not what it can be: the world keeps a scene in its own state, and judges it when it resumes.
    ///
    /// # Errors
    /// The first such field.
    pub fn check(&self) -> Result<(), Flaw> {
        let (sightings, obstacles) = (self.sightings as usize, self.obstacles as usize);
        ensure(sightings <= self.sighting.len(), "scene.sightings", "no more than there is room for")?;
        ensure(obstacles <= self.obstacle.len(), "scene.obstacles", "no more than there is room for")?;
        places("scene.obstacle", self.obstacle[..obstacles].as_flattened())?;
        self.surface.check()?;
        self.sighting[..sightings].iter().try_for_each(Sighting::check)
    }
}

impl Sighting {
    fn check(&self) -> Result<(), Flaw> {
        kind("scene.sighting.kind", self.kind)?;
        fractions("scene.sighting.confidence", &[self.confidence])?;
        places("scene.sighting.position", &self.position)?;
        orientations("scene.sighting.orientation", &[self.orientation])
    }
}
