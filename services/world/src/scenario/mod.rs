//! A scenario file: what the person does, and what is arranged in the scene meanwhile.

mod scenario_file;
mod scenario_source;
mod staging;
mod staging_file;

pub(crate) use staging::{Sense, Staging};

use coact_person::Script;

/// What happens in a run: the person's actions, and the scene in which they take place.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Scenario {
    pub(crate) script: Script,
    pub(crate) staging: Staging,
}
