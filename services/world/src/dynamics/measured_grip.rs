use super::contacts::Contacts;
use coact_messages::MAX_PARTS;
use rapier3d::prelude::*;

/// Friction coefficient between finger pads and parts: the mean of theirs, as the engine combines them.
const FRICTION: f64 = 0.85;

/// What fingers and palm hold, as their force sensors tell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MeasuredGrip {
    /// The part on which they press most.
    pub part: Option<usize>,
    /// How hard, N: what of their forces on it opposes each other. Without fingers on both sides it is no grip.
    pub force: f64,
    forces: [f64; MAX_PARTS],
}

impl MeasuredGrip {
    pub const NONE: Self = Self { part: None, force: 0.0, forces: [0.0; MAX_PARTS] };

    /// Force on one part, N.
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
            let unopposed = pushes.iter().copied().sum::<Vector>().length();
            let [one, two, three, _palm] = pushes.map(Vector::length);
            let both_sides = one.max(two) > 0.0 && three > 0.0;
            if both_sides { 0.5 * (all - unopposed) } else { 0.0 }
        });
        let most = (0..MAX_PARTS).max_by(|one, other| forces[*one].total_cmp(&forces[*other]));
        let part = most.filter(|&part| forces[part] > 0.0);
        Self { part, force: part.map_or(0.0, |part| forces[part]), forces }
    }
}
