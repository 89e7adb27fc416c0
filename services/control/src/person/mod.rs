//! The person as the guard and the planner reckon with her: capsules that move, and grow for as long as they are not seen.

mod arm_bound;
mod arm_capsules;
mod body_part;
mod growth;
mod person_capsules;

pub(crate) use arm_capsules::ArmCapsules;
pub(crate) use body_part::BodyPart;
pub(crate) use person_capsules::PersonCapsules;
