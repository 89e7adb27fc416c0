use serde::Serialize;

/// A step of the plan, as task files have it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Subgoal {
    pub(crate) name: String,
    pub(crate) kind: String,
    pub(crate) side: &'static str,
    pub(crate) socket: Socket,
    pub(crate) after: Vec<String>,
}

/// Where its part goes, m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct Socket {
    pub(crate) at: [f64; 3],
}
