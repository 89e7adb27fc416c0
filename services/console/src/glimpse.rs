use crate::Picture;

/// One instant of a run: what is drawn of it, and what explains it.
#[derive(Debug, Clone, PartialEq)]
pub struct Glimpse {
    /// What is drawn.
    pub picture: Picture,
    /// Signals of all populations, and of the percept's channels behind them, as [`coact_fields::signals`] gives them. Kept in single
    /// precision: for the eye.
    pub signals: Vec<f32>,
    /// Cycle since which each population's peak stands; 0 without one.
    pub since: Vec<u64>,
}
