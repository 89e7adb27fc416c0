use crate::Agent;

/// One step of the plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Subgoal {
    /// Its name, as the robot says it.
    pub name: String,
    /// Index of the kind of part that it needs.
    pub kind: usize,
    /// Whose hands reach the place.
    pub side: Agent,
    /// Where the part's frame ends up: position, m.
    pub socket: [f64; 3],
    /// Where the part's own z axis points when it is in place; unit vector.
    pub axis: [f64; 3],
    /// Whether the other one steadies the base meanwhile.
    pub steadied: bool,
    /// Indices of the subgoals that must be achieved before.
    pub after: Vec<usize>,
    /// Indices of the choices that must be made before.
    pub after_choices: Vec<usize>,
}
