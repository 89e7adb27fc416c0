use super::articulation::Articulation;
use coact_messages::MAX_PARTS;
use rapier3d::prelude::*;

/// What the robot's hand touched in one step. Forces are those along the contacts' normals, N, world frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Contacts {
    /// Force of each finger, and last of the palm, on each part.
    pub pushes: [[Vector; 4]; MAX_PARTS],
    /// Force of all else on the hand and on the part that it holds.
    pub outside: Vector,
}

/// Place of the palm among the fingers.
const PALM: usize = 3;

impl Contacts {
    pub const NONE: Self = Self { pushes: [[Vector::ZERO; 4]; MAX_PARTS], outside: Vector::ZERO };

    /// Reads the last step's contacts. Colliders of parts carry their index + 1 as user data; `own` tells the parts whose
    /// contact with the hand is not of the outside.
    pub fn measure(
        world: &PhysicsWorld,
        hand: &Articulation,
        held: Option<RigidBodyHandle>,
        own: impl Fn(usize) -> bool,
    ) -> Self {
        let mut contacts = Self::NONE;
        for &(collider, finger) in &hand.shapes {
            for (other, push) in pushes(world, collider) {
                let part = world.colliders.get(other).and_then(|other| other.user_data.checked_sub(1));
                let part = part.map(|part| part as usize);
                if let Some(part) = part {
                    contacts.pushes[part][finger.unwrap_or(PALM)] += push;
                }
                if !part.is_some_and(&own) {
                    contacts.outside -= push;
                }
            }
        }
        let Some(held) = held.and_then(|held| world.bodies.get(held)) else { return contacts };
        contacts.outside += held.user_force();
        for &collider in held.colliders() {
            let of_hand = |other: ColliderHandle| hand.shapes.iter().any(|(shape, _)| *shape == other);
            let others = pushes(world, collider).filter(|(other, _)| !of_hand(*other));
            contacts.outside -= others.map(|(_, push)| push).sum::<Vector>();
        }
        contacts
    }
}

/// What a collider touches, and the force with which it pushes at that, N.
pub(super) fn pushes(
    world: &PhysicsWorld,
    collider: ColliderHandle,
) -> impl Iterator<Item = (ColliderHandle, Vector)> {
    let seconds = world.integration_parameters.dt;
    world.contact_pairs_with(collider).map(move |pair| {
        let (other, sign) =
            if pair.collider1 == collider { (pair.collider2, 1.0) } else { (pair.collider1, -1.0) };
        (other, sign * pair.total_impulse() / seconds)
    })
}
