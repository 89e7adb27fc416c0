use serde::Serialize;

/// One thing that was looked at.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Finding {
    /// What.
    pub subject: &'static str,
    /// How well it suits a period of 1 ms.
    pub level: Level,
    /// What it is.
    pub found: String,
    /// What it should be.
    pub expected: &'static str,
    /// What to do, unless all is well.
    pub remedy: Option<&'static str>,
}

/// How well something suits a period of 1 ms.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Level {
    /// As it should be.
    Green,
    /// Cycles will be late now and then.
    Yellow,
    /// The period will not be held.
    Red,
}

impl Finding {
    pub(crate) fn new(
        subject: &'static str,
        level: Level,
        found: impl Into<String>,
        expected: &'static str,
        remedy: &'static str,
    ) -> Self {
        let remedy = (level != Level::Green).then_some(remedy);
        Self { subject, level, found: found.into(), expected, remedy }
    }
}
