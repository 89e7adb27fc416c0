//! What a task consists of.

/// One of the two who act: the index used for workspaces and sides throughout.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Agent {
    /// The robot: index 0.
    Robot,
    /// The person: index 1.
    Person,
}

impl Agent {
    /// 0 for the robot, 1 for the person, as in [`coact_messages::ROBOT`] and [`coact_messages::PERSON`].
    pub fn index(self) -> usize {
        self as usize
    }
}

/// A kind of part.
#[derive(Debug, Clone, PartialEq)]
pub struct Kind {
    /// Its name, as the robot says it.
    pub name: String,
    /// How far the fingers close on it, m.
    pub width: f64,
    /// Its shape.
    pub shape: Shape,
    /// Its mass, kg.
    pub mass: f64,
}

/// Shape of a part; its frame is at the centre of its underside, z up.
#[derive(Debug, Clone, Copy, PartialEq, serde::Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub enum Shape {
    /// Upright cylinder, m.
    Cylinder {
        /// Radius, m.
        radius: f64,
        /// Height, m.
        height: f64,
    },
    /// Box of full extents x, y, z, m.
    Box {
        /// Extents, m.
        size: [f64; 3],
    },
}

impl Shape {
    /// Extents of the box around it, m.
    pub fn extents(&self) -> [f64; 3] {
        match *self {
            Self::Cylinder { radius, height } => [2.0 * radius, 2.0 * radius, height],
            Self::Box { size } => size,
        }
    }

    /// Height above its frame, m.
    pub fn height(&self) -> f64 {
        self.extents()[2]
    }

    /// Radius of the round room that it needs when it stands upright, m.
    pub fn radius(&self) -> f64 {
        match *self {
            Self::Cylinder { radius, .. } => radius,
            Self::Box { size: [x, y, _] } => 0.5 * x.hypot(y),
        }
    }
}

/// One part and where it lies at the start.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Index of its kind.
    pub kind: usize,
    /// In whose workspace.
    pub workspace: Agent,
    /// Place on the table top, m.
    pub at: [f64; 2],
}

/// One step of the plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Subgoal {
    /// Its name, as the robot says it.
    pub name: String,
    /// Index of the kind of part that it needs.
    pub kind: usize,
    /// Whose hands reach the place.
    pub side: Agent,
    /// Where the part's frame ends up: position, m.
    pub socket: [f64; 3],
    /// Where the part's own z axis points when it is in place; unit vector.
    pub axis: [f64; 3],
    /// Whether the other one steadies the base meanwhile.
    pub steadied: bool,
    /// Indices of the subgoals that must be achieved before.
    pub after: Vec<usize>,
}

/// A way to grasp that tells what is meant.
#[derive(Debug, Clone, PartialEq)]
pub struct Grip {
    /// Its name.
    pub name: String,
    /// Direction from wrist to knuckles against the table plane, rad; -pi/2 is straight down.
    pub pitch: f64,
}

/// A gesture of the empty hand, held out over the middle of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct Gesture {
    /// Its name.
    pub name: String,
    /// Direction from wrist to knuckles against the table plane, rad.
    pub pitch: f64,
}

/// What perception can observe of the person's hand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Act {
    /// The hand lies at rest now.
    Rest,
    /// The hand has been at rest for long: evidence grows with the seconds.
    Idle,
    /// The hand is on its way to something.
    Reach,
    /// The hand has gone out of sight on its way: behind something, where its grip cannot be seen.
    Hidden,
    /// The person says what a chain is for ("give me the wheel"): index into `Task::chains`.
    Word(usize),
    /// The empty hand shows a gesture: index into `Task::gestures`.
    Gesture(usize),
    /// The hand preshapes for, grasps or holds a part of `kind` with `grip`.
    Grasp {
        /// Index into `Task::grips`.
        grip: usize,
        /// Index into `Task::kinds`.
        kind: usize,
    },
}

/// A chain of action primitives of the person, for one kind of part (e.g. reach - grasp from above - insert).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chain {
    /// Name of the rule, e.g. "insert".
    pub name: String,
    /// The act that shows it.
    pub act: Act,
    /// Index of the kind of part.
    pub kind: usize,
    /// In whose workspace the part lies.
    pub from: Agent,
    /// Whose subgoal it serves.
    pub side: Agent,
    /// Name of the robot's action that complements it, if one does: with the chain's subgoal it names an action.
    pub answer: Option<String>,
    /// Phrases by which the person says that this is meant, in lower case; none: it is not spoken of.
    pub says: Vec<String>,
}

/// Something that the robot can do.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Action {
    /// Its name with its object, e.g. "insert: wheel on the robot's side".
    pub name: String,
    /// Name of the rule that made it, e.g. "insert".
    pub rule: String,
    /// What it does.
    pub action_type: ActionType,
    /// Index of the kind of part that it handles.
    pub kind: Option<usize>,
    /// Index of the subgoal that it serves.
    pub subgoal: Option<usize>,
}

/// What an action does, as the task file names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ActionType {
    /// Pick a part from the robot's workspace (unless it is in the hand already) and insert it into its socket.
    Insert,
    /// Hold the open hand out at the handover place: "give me ...".
    Request,
    /// Go to the handover place and take over the part that the person gives.
    Receive,
    /// Pick a part from the robot's workspace and give it to the person at the handover place.
    Give,
    /// Steady the base while the person inserts a part.
    Steady,
    /// Point to a part.
    Point,
    /// Say what is wrong with what the person means; the arm rests.
    Speak,
    /// Say that a part is lost and cannot be replaced; the arm rests.
    Report,
}

/// The table, the base and the places on it; m, world frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Height of the table top.
    pub table_height: f64,
    /// Centre of the table top.
    pub table_centre: [f64; 2],
    /// Extents of the table top.
    pub table_size: [f64; 2],
    /// Centre of the round base's underside.
    pub platform: [f64; 3],
    /// Its radius.
    pub platform_radius: f64,
    /// Its height.
    pub platform_height: f64,
    /// Where the robot's hand steadies the base.
    pub steady: [f64; 3],
    /// Where parts change hands.
    pub handover: [f64; 3],
    /// Where the person's hand rests.
    pub person_rest: [f64; 3],
    /// The person's shoulder.
    pub person_shoulder: [f64; 3],
    /// Rectangle of each workspace on the table top, by [`Agent::index`]: min and max corner.
    pub workspace: [[[f64; 2]; 2]; 2],
    /// How exactly a part must be in its place to be mounted when it is let go.
    pub fit: Fit,
}

/// Tolerances of a socket.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// Largest distance of the part's frame from the socket, m.
    pub position: f64,
    /// Largest angle between the part's own axis and the socket's, rad.
    pub angle: f64,
}

/// Where the robot's eye is: behind the world's origin, where the robot stands, and so high above the table top, m.
const EYE: (f64, f64) = (0.10, 1.05);

impl Scene {
    /// Place of the camera that follows hand and parts: above and behind the robot's head, over the middle of the table.
    pub fn eye(&self) -> [f64; 3] {
        [EYE.0, self.table_centre[1], self.table_height + EYE.1]
    }
}
