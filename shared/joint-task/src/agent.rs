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
