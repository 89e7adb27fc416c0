use crate::errand::Errand;
use crate::person::PersonArm;
use coact_messages::{MAX_PARTS, Sighting};
use coact_robot::{HAND_JOINTS, MotionState, NextUse};
use nalgebra::{Isometry3, Vector3};

/// What the planner is asked: all that it needs to know, of fixed size, so that it passes a lock-free slot.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Request {
    /// Counts the questions.
    pub id: u64,
    /// What the hand is about, and the kind of part that this concerns.
    pub errand: Errand,
    pub kind: Option<usize>,
    /// Frame of the place: of the part to take, of the socket, of the place on the table, of the handover.
    pub frame: Isometry3<f64>,
    /// What is done next with a part that is taken, and where, if that is known.
    pub purpose: NextUse,
    pub next: Option<Isometry3<f64>>,
    /// Whether the hand stops before the place.
    pub before: bool,
    /// Whether a part may be put down lying or leaning.
    pub loosely: bool,
    /// State of the arm in which the movement shall begin.
    pub start: [MotionState; 7],
    /// Angles of the hand's joints now, and to which they are on their way, rad.
    pub fingers: [f64; HAND_JOINTS],
    pub heading: [f64; HAND_JOINTS],
    /// First out of a narrow place: direction and distance, m.
    pub leave: Option<(Vector3<f64>, f64)>,
    /// Kind of the part in the hand, and its frame in that of the palm; and which of the holds it is in.
    pub held: Option<(usize, Isometry3<f64>)>,
    pub hold: Option<usize>,
    /// Parts in sight, the first `seen` of them.
    pub parts: [Sighting; MAX_PARTS],
    pub seen: usize,
    /// Screens: centre and half extents, m, the first `screened` of them.
    pub screens: [[f64; 6]; 4],
    pub screened: usize,
    /// The person's arm, when it is tracked.
    pub person: Option<PersonArm>,
}

impl Request {
    /// Whether the hand goes to where the person will bring something, and keeps clear of that.
    pub fn awaits(&self) -> bool {
        self.errand == Errand::Ask || (self.errand == Errand::Receive && self.before)
    }

    /// Whether the arm moves when the movement begins.
    pub fn is_in_motion(&self) -> bool {
        self.start.iter().any(|state| !state.is_at_rest())
    }
}
