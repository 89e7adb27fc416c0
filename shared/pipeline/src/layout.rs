use serde::{Deserialize, Serialize};
use std::fmt;
use std::str::FromStr;

/// Where the parts lie when an assembly begins: only the world is told; all others see it.
///
/// ```
/// use coact_pipeline::Layout;
///
/// assert_eq!("random:7".parse(), Ok(Layout::Random(7)));
/// assert_eq!(Layout::parse("random", 3), Ok(Layout::Random(3)));
/// assert_eq!(Layout::Random(7).to_string(), "random:7");
/// assert!("random:".parse::<Layout>().is_err());
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Layout {
    /// As the task has them.
    #[default]
    Task,
    /// Anywhere in the workspace in which the task has each of them; the same seed gives the same places.
    Random(u64),
}

impl Layout {
    /// Reads `task`, `random:SEED`, or `random`, which takes this seed.
    ///
    /// # Errors
    /// What was expected.
    pub fn parse(text: &str, seed: u64) -> Result<Self, String> {
        match text.split_once(':') {
            None if text == "task" => Ok(Self::Task),
            None if text == "random" => Ok(Self::Random(seed)),
            Some(("random", own)) => own.parse().map(Self::Random).map_err(|_| unknown(text)),
            _ => Err(unknown(text)),
        }
    }
}

fn unknown(text: &str) -> String {
    format!(
        "layout \"{text}\" is unknown; expected task, random or random:SEED with a whole number from 0 on"
    )
}

impl FromStr for Layout {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "random" => Err(unknown(text)),
            _ => Self::parse(text, 0),
        }
    }
}

impl TryFrom<String> for Layout {
    type Error = String;

    fn try_from(text: String) -> Result<Self, Self::Error> {
        text.parse()
    }
}

impl From<Layout> for String {
    fn from(layout: Layout) -> Self {
        layout.to_string()
    }
}

impl fmt::Display for Layout {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Task => out.write_str("task"),
            Self::Random(seed) => write!(out, "random:{seed}"),
        }
    }
}
