//! Every message that crosses a process boundary, and nothing else.
//!
//! One cycle of the pipeline is a chain of four messages, each 1 kHz, each descending from the one before it:
//!
//! ```text
//! world --SensorSample--> perception --Percept--> fields --FieldFrame--> control --Command--> world
//! ```
//!
//! Beside the chain stand [`Pulse`] (each process, each cycle: what the deadline accounting knows),
//! [`Truth`] (world to monitor alone), [`WorldState`] (what a restarted world resumes from), [`Speech`], and [`StopState`]
//! (whether an operator has stopped the robot), and [`HandPoints`] (a person's hand, told from outside).
//!
//! All messages are `repr(C)`, hold no pointer, accept any bit pattern, and begin with a [`Header`]. Their layout
//! is versioned by [`LAYOUT`]: whoever changes a field raises it.
//!
//! For iceoryx2 each message has a type name of its own, `coact::` and the name of the struct: programs in other
//! languages state it together with size and alignment, and are refused when they differ
//! (`tools/watch-layer.py` is an example).
//!
//! A message also holds its producer's state: a stage keeps nothing that its own last message does not hold, so that a
//! restarted process resumes from the newest one of its predecessor, its checkpoint.
//!
//! A reader takes the bytes as they are, and looks at the header first:
//!
//! ```
//! use coact_messages::{Decision, FieldFrame, Header, LAYOUT, LayerKind};
//!
//! // What a network of one layer with three populations writes, the second of which has decided in cycle 12 ...
//! let mut frame: Box<FieldFrame> = bytemuck::zeroed_box();
//! frame.header = Header { layout: LAYOUT, cycle: 17, ..Header::default() };
//! frame.layers.count = 1;
//! frame.layers.kind[0] = LayerKind::ActionExecution as u32;
//! frame.layers.populations[0] = 3;
//! frame.since[1] = 12;
//! frame.decision = Decision { action: 1, reserved: 0, since: 12 };
//!
//! // ... and what its reader makes of it.
//! let received: &FieldFrame = bytemuck::from_bytes(bytemuck::bytes_of(&*frame));
//! assert_eq!(received.header.layout, LAYOUT, "a message of another layout is refused");
//! let peaks = received.populations(LayerKind::ActionExecution).filter(|&index| received.since[index] > 0);
//! assert_eq!(peaks.collect::<Vec<_>>(), [1]);
//! assert_eq!(received.decision.action, 1);
//! ```

mod arm_path;
mod arm_side;
mod command;
mod description;
mod destinations;
mod drive_report;
mod field_frame;
mod grips;
mod hand_points;
mod header;
mod heard;
mod message_text;
mod percept;
mod person_arm;
mod person_wait;
mod plausible;
mod pulse;
mod refusal;
mod sensor_sample;
mod site_grid;
mod speech;
mod stop_state;
mod surface;
pub mod topic;
mod topic_entry;
mod truth;
mod world_state;

pub use arm_path::{ArmPath, PathKnot};
pub use arm_side::ArmSide;
pub use command::{Command, MotionPhase};
pub use description::{Described, Description};
pub use destinations::Destinations;
pub use drive_report::{CommandRefusal, DriveMode, DriveReport, HoldReason};
pub use field_frame::{Decision, FieldFrame, LayerKind, LayerTable};
pub use grips::Grips;
pub use hand_points::HandPoints;
pub use header::{Header, LAYOUT};
pub use heard::Heard;
pub use percept::{HandPercept, Percept, WorkspacePercept};
pub use person_arm::{PersonArm, TrackedPoint};
pub use person_wait::PersonWait;
pub use plausible::{Flaw, Plausible};
pub use pulse::Pulse;
pub use refusal::Refusal;
pub use sensor_sample::{HandView, JointReading, Keypoint, KeypointName, SceneView, SensorSample, Sighting};
pub use site_grid::SiteGrid;
pub use speech::Speech;
pub use stop_state::StopState;
pub use surface::{Surface, UNMEASURED};
pub use topic_entry::TopicEntry;
pub use truth::{PartnerError, PartnerPhase, Truth};
pub use world_state::{PartState, WorldState};

/// Joints of arm (7) and hand (8: spread, three finger bases, three finger tips, one reserved), in that order.
pub const JOINTS: usize = 15;

/// Mean angle of the three finger bases in a row of [`JOINTS`], rad; growing angles close the hand.
pub fn finger_closure(position: &[f64; JOINTS]) -> f64 {
    position[8..11].iter().sum::<f64>() / 3.0
}

/// Arm joints: the first seven of [`JOINTS`].
pub const ARM_JOINTS: usize = 7;
// The limits below leave room for tasks of 50 subgoals, which the network computes in a period.

/// Observable acts that a task may name (populations of the action observation layer).
pub const MAX_ACTS: usize = 192;
/// Grips that a task may name.
pub const MAX_GRIPS: usize = 16;
/// Kinds of part that a task may name.
pub const MAX_KINDS: usize = 64;
/// Single parts that a scene may hold.
pub const MAX_PARTS: usize = 64;
/// Places that the person's hand may go to: all parts, where it is shown empty, and where it rests.
pub const MAX_DESTINATIONS: usize = MAX_PARTS + 2;
/// Subgoals that a plan may name.
pub const MAX_SUBGOALS: usize = 64;
/// Layers of the field network.
pub const MAX_LAYERS: usize = 16;
/// Populations of the whole field network.
pub const MAX_POPULATIONS: usize = 1216;
/// Samples (field sites) of the whole field network.
pub const MAX_SITES: usize = 12_160;
/// Sites of the field over the table.
pub const MAX_PLACES: usize = 4096;
/// Sites of the field over the grips.
pub const MAX_GRIP_SITES: usize = 1024;
/// Workspaces: index 0 is the robot's, index 1 is the person's.
pub const WORKSPACES: usize = 2;
/// The robot's workspace or side.
pub const ROBOT: usize = 0;
/// The person's workspace or side.
pub const PERSON: usize = 1;
/// "No such index": an absent population, part, kind or subgoal.
pub const NONE: u32 = u32::MAX;
