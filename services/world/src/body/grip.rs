use super::articulation::Articulation;
use coact_messages::MAX_PARTS;
use rapier3d::prelude::*;

/// What the fingers squeeze, measured at their contacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Grip {
    /// The part that is squeezed most.
    pub part: Option<usize>,
    /// How hard, N: what of the fingers' forces on it opposes each other. A push from one side alone is no grip.
    pub force: f64,
    forces: [f64; MAX_PARTS],
}

impl Grip {
    pub const NONE: Self = Self { part: None, force: 0.0, forces: [0.0; MAX_PARTS] };

    /// Force on one part, N.
    pub fn force_on(&self, part: usize) -> f64 {
        self.forces[part]
    }

    /// Reads the last step's contacts between fingers and parts, whose colliders carry their index + 1 as user data.
    pub(super) fn measure(world: &PhysicsWorld, hand: &Articulation) -> Self {
        let mut pushes = [[Vector::ZERO; 3]; MAX_PARTS];
        for (pad, finger) in &hand.pads {
            for pair in world.contact_pairs_with(*pad) {
                let (other, sign) =
                    if pair.collider1 == *pad { (pair.collider2, 1.0) } else { (pair.collider1, -1.0) };
                let part = world.colliders.get(other).and_then(|other| other.user_data.checked_sub(1));
                if let Some(part) = part {
                    pushes[part as usize][*finger] += sign * pair.total_impulse();
                }
            }
        }
        let seconds = world.integration_parameters.dt;
        let forces = pushes.map(|fingers| {
            let all: f32 = fingers.iter().map(|push| push.length()).sum();
            let unopposed = fingers.iter().copied().sum::<Vector>().length();
            f64::from(0.5 * (all - unopposed) / seconds)
        });
        let most = (0..MAX_PARTS).max_by(|one, other| forces[*one].total_cmp(&forces[*other]));
        let part = most.filter(|&part| forces[part] > 0.0);
        Self { part, force: part.map_or(0.0, |part| forces[part]), forces }
    }
}
