use crate::state::Skill;

/// What the fingers do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum FingerShape {
    /// Resting, half open.
    Relaxed,
    /// Open around a kind of part, in whichever grip it is picked.
    Around(usize),
    /// Closed on a part in this grip.
    Closed(usize),
    /// Open around it in this grip.
    Open(usize),
    /// Together, to press on something or to point.
    Slender,
}

impl FingerShape {
    /// On the way to a skill's goal. `held_in`: the grip in which a part is held. `received_in`: the one in which a part of
    /// this kind is received.
    pub fn on_the_way(
        skill: Skill,
        kind: Option<usize>,
        held_in: Option<usize>,
        received_in: impl Fn(usize) -> usize,
    ) -> Self {
        match (skill, held_in, kind) {
            (_, Some(grip), _) => Self::Closed(grip),
            (Skill::Pick, _, Some(kind)) => Self::Around(kind),
            (Skill::Request | Skill::Receive, _, Some(kind)) => Self::Open(received_in(kind)),
            (Skill::Steady | Skill::Point, ..) => Self::Slender,
            _ => Self::Relaxed,
        }
    }
}
