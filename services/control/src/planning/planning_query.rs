use super::Surroundings;
use crate::person::PersonCapsules;
use crate::state::Skill;
use coact_robot::{HAND_JOINTS, MotionState, NextUse};
use nalgebra::{Isometry3, Vector3};
use std::hash::{DefaultHasher, Hash, Hasher};

/// What is asked of the planner: all that it needs to know, of fixed size, so that it passes a lock-free slot.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PlanningQuery {
    /// What the hand does, and the kind of part that this concerns.
    pub skill: Skill,
    pub kind: Option<usize>,
    /// Frame of the place: of the part to pick, of the socket that the robot fills, or for which it steadies the base, of the place
    /// on the table, of the handover.
    pub place: Isometry3<f64>,
    /// What is done next with a part that is picked, and the frame to which it is brought, if that is known.
    pub next_use: NextUse,
    pub next_place: Option<Isometry3<f64>>,
    /// Whether the hand stops before the place, to wait for the person.
    pub stops_before: bool,
    /// Whether the hand only gets ready for a preshaped action.
    pub prepares: bool,
    /// Whether a part may be put down lying or leaning.
    pub loosely: bool,
    /// State of the arm in which the movement shall begin.
    pub start: [MotionState; 7],
    /// Angles of the hand's joints now, as measured, for what it holds keeps them from closing farther; and to which they are on their
    /// way, rad.
    pub fingers: [f64; HAND_JOINTS],
    pub finger_target: [f64; HAND_JOINTS],
    /// First out of a narrow place: direction and distance, m.
    pub leave: Option<(Vector3<f64>, f64)>,
    /// Kind of the held part, and its frame in the palm's; and in which grip it is held.
    pub held: Option<(usize, Isometry3<f64>)>,
    pub held_in: Option<usize>,
    pub surroundings: Surroundings,
    /// The person, where she was seen last.
    pub person: Option<PersonCapsules>,
}

impl PlanningQuery {
    /// Whether the hand goes to where the person will bring something, and keeps clear of that.
    pub fn awaits_person(&self) -> bool {
        self.skill == Skill::Request || (self.skill == Skill::Receive && self.stops_before)
    }

    /// Whether the hand grasps what the person gives.
    pub fn receives(&self) -> bool {
        self.skill == Skill::Receive && !self.stops_before
    }

    /// Tells it from queries for another movement: of what the hand does, where, and from which state of the arm. Two instances that
    /// ask for the same movement in the same cycle may see what surrounds it a sample apart.
    pub fn fingerprint(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        (self.skill as u64, self.kind, self.stops_before, self.prepares, self.loosely, self.held_in)
            .hash(&mut hasher);
        let place = self.place.to_homogeneous();
        let starts = self.start.iter().flat_map(|joint| [joint.position, joint.velocity, joint.acceleration]);
        place.iter().copied().chain(starts).for_each(|number| number.to_bits().hash(&mut hasher));
        hasher.finish()
    }

    /// Whether the arm moves when the movement begins.
    pub fn is_in_motion(&self) -> bool {
        self.start.iter().any(|state| !state.is_at_rest())
    }
}
