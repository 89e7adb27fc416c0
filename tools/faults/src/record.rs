use crate::{Cell, Trouble};
use coact_run_records::MotionReport;
use std::collections::BTreeMap;

/// What happened in one cell.
#[derive(Debug, Clone)]
pub(crate) struct Record {
    pub(crate) cell: Cell,
    /// From just before the fault until the set had time to come over it, ns of `CLOCK_MONOTONIC`.
    pub(crate) from_ns: u64,
    pub(crate) until_ns: u64,
    /// Whether each replacement went on from its predecessor's state, by its own report.
    pub(crate) resumed: BTreeMap<&'static str, bool>,
    /// How the joints moved, from before the moment came, as a viewer saw it.
    pub(crate) motion: MotionReport,
    /// Why the fault was not done, or not seen.
    pub(crate) trouble: Option<Trouble>,
}

impl Record {
    /// Nothing has happened yet.
    pub(crate) fn of(cell: &Cell, trouble: Option<Trouble>) -> Self {
        Self {
            cell: cell.clone(),
            from_ns: 0,
            until_ns: u64::MAX,
            resumed: BTreeMap::new(),
            motion: MotionReport::default(),
            trouble,
        }
    }
}
