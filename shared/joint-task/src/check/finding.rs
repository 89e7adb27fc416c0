/// Something that is wrong with a task, told to the person who writes it.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
pub struct Finding {
    /// What kind of thing is wrong.
    pub kind: FindingKind,
    /// File and line.
    pub place: String,
    /// What is wrong.
    pub what: String,
    /// Why it matters.
    pub why: String,
    /// What to do about it.
    pub advice: String,
}

/// The kinds of things that can be wrong.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FindingKind {
    /// The scene holds fewer parts than the plan needs.
    MissingParts,
    /// Neither of the two can bring a subgoal about with what lies where it lies.
    UnreachableSubgoal,
    /// One act shows two chains that may be meant at the same time.
    AmbiguousChain,
    /// One sentence stands for two chains.
    AmbiguousPhrase,
    /// In a decision layer the loser has too much input.
    SmallMargin,
    /// The simulated world refuses the scene.
    Scene,
    /// The robot cannot reach a place that it needs.
    OutOfReach,
}

impl FindingKind {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::MissingParts => "missing parts",
            Self::UnreachableSubgoal => "unreachable subgoal",
            Self::AmbiguousChain => "ambiguous chain",
            Self::AmbiguousPhrase => "ambiguous phrase",
            Self::SmallMargin => "small margin",
            Self::Scene => "scene",
            Self::OutOfReach => "out of reach",
        }
    }
}
