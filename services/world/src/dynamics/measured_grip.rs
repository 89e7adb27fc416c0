use super::contacts::Contacts;
use coact_messages::MAX_PARTS;
use rapier3d::prelude::*;

/// Friction coefficient between finger pads and parts: the mean of theirs, as the engine combines them.
const FRICTION: f64 = 0.85;

/// What fingers and palm hold, as their force sensors tell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MeasuredGrip {
    /// The part on which they press most, from both sides: without that it is no grip.
    pub part: Option<usize>,
    /// How hard, N.
    pub force: f64,
    /// Of each part, how hard it is squeezed, N: what of the forces on it opposes each other. One that only two neighbouring fingers
    /// still pinch has not been let go.
    forces: [f64; MAX_PARTS],
}

impl MeasuredGrip {
    pub const NONE: Self = Self { part: None, force: 0.0, forces: [0.0; MAX_PARTS] };

    /// How hard one part is squeezed, N.
    pub fn force_on(&self, part: usize) -> f64 {
        self.forces[part]
    }

    /// What friction can hold a part against, N: two sides press with the force of the grip, and each has friction.
    pub(super) fn carries(&self, part: usize) -> f64 {
        2.0 * FRICTION * self.force_on(part)
    }

    /// The grip that these forces make.
    pub(super) fn of(contacts: &Contacts) -> Self {
        let forces = contacts.pushes.map(|pushes| {
            let all: f64 = pushes.iter().map(|push| push.length()).sum();
            0.5 * (all - pushes.iter().copied().sum::<Vector>().length())
        });
        let both_sides = |part: &usize| {
            let [one, two, three, _palm] = contacts.pushes[*part].map(Vector::length);
            forces[*part] > 0.0 && one.max(two) > 0.0 && three > 0.0
        };
        let part =
            (0..MAX_PARTS).filter(both_sides).max_by(|one, other| forces[*one].total_cmp(&forces[*other]));
        Self { part, force: part.map_or(0.0, |part| forces[part]), forces }
    }
}
