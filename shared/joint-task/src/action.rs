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
