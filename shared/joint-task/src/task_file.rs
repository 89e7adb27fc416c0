//! The task file as it is written: names where [`Task`](crate::Task) has indices, degrees where it has radians.

use crate::{ActionType, Agent, Shape};
use serde::Deserialize;
use toml::Spanned;

/// A name with its place in the file, for errors that point at it.
pub(crate) type Name = Spanned<String>;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TaskFile {
    pub name: String,
    pub network: Name,
    pub learned: Option<Name>,
    pub kind: Vec<KindEntry>,
    pub part: Vec<PartEntry>,
    pub subgoal: Vec<SubgoalEntry>,
    #[serde(default)]
    pub choice: Vec<ChoiceEntry>,
    pub grip: Vec<GripEntry>,
    #[serde(default)]
    pub gesture: Vec<GestureEntry>,
    pub chain: Vec<ChainEntry>,
    pub action: Vec<ActionEntry>,
    pub scene: SceneEntry,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct KindEntry {
    pub name: Name,
    pub width: f64,
    pub shape: Shape,
    pub mass: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PartEntry {
    pub kind: Name,
    pub workspace: Agent,
    pub at: Spanned<[f64; 2]>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SubgoalEntry {
    pub name: Name,
    pub kind: Name,
    pub side: Agent,
    pub socket: SocketEntry,
    #[serde(default)]
    pub steadied: bool,
    #[serde(default)]
    pub after: Vec<Name>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ChoiceEntry {
    pub name: Name,
    pub of: Vec<Name>,
    pub count: Spanned<usize>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SocketEntry {
    pub at: Spanned<[f64; 3]>,
    #[serde(default = "upright")]
    pub axis: [f64; 3],
}

fn upright() -> [f64; 3] {
    [0.0, 0.0, 1.0]
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct GripEntry {
    pub name: Name,
    pub pitch: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct GestureEntry {
    pub name: Name,
    pub pitch: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ChainEntry {
    pub name: Name,
    pub grip: Option<Name>,
    pub gesture: Option<Name>,
    pub from: Agent,
    pub side: Agent,
    pub answer: Option<Name>,
    #[serde(default)]
    pub pointing: bool,
    #[serde(default)]
    pub says: Vec<Name>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ActionEntry {
    pub name: Name,
    #[serde(rename = "type")]
    pub action_type: ActionType,
    #[serde(rename = "for")]
    pub each: Each,
    pub side: Option<Agent>,
}

/// For what a rule of the file makes one entry each.
#[derive(Deserialize, Clone, Copy, PartialEq, Eq)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Each {
    Once,
    Kind,
    Subgoal,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SceneEntry {
    pub table: TableEntry,
    pub platform: PlatformEntry,
    pub steady: Places,
    pub handover: [f64; 3],
    pub person_rest: [f64; 3],
    pub person_shoulder: [f64; 3],
    pub robot_workspace: RectangleEntry,
    pub person_workspace: RectangleEntry,
    #[serde(default)]
    pub fit: FitEntry,
}

/// At least one place, m.
#[derive(Deserialize)]
#[serde(try_from = "PlacesEntry")]
pub(crate) struct Places(pub Vec<[f64; 3]>);

#[derive(Deserialize)]
#[serde(untagged, expecting = "expected a place, [x, y, z], or a list of places, [[x, y, z], ...]")]
pub(crate) enum PlacesEntry {
    One([f64; 3]),
    Several(Vec<[f64; 3]>),
}

impl TryFrom<PlacesEntry> for Places {
    type Error = &'static str;

    fn try_from(entry: PlacesEntry) -> Result<Self, Self::Error> {
        match entry {
            PlacesEntry::One(place) => Ok(Self(vec![place])),
            PlacesEntry::Several(places) if places.is_empty() => {
                Err("no place; expected at least one, [x, y, z]")
            }
            PlacesEntry::Several(places) => Ok(Self(places)),
        }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct FitEntry {
    pub position: f64,
    pub angle: f64,
}

/// Tolerances of a task that gives none: those of the shipped tasks, chosen by hand.
impl Default for FitEntry {
    fn default() -> Self {
        Self { position: 0.008, angle: 8.0 }
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TableEntry {
    pub height: f64,
    pub centre: [f64; 2],
    pub size: [f64; 2],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PlatformEntry {
    pub at: [f64; 3],
    pub radius: f64,
    pub height: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RectangleEntry {
    pub min: [f64; 2],
    pub max: [f64; 2],
}
