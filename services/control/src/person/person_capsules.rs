use super::{ArmCapsules, BodyPart};
use coact_messages::Percept;
use coact_motion::Capsule;
use coact_safety::{PersonLimits, StaleLimits};

/// The person as the robot keeps clear of her: both arms, of which one acts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PersonCapsules {
    /// The arm that acts, and may take and give.
    acting: ArmCapsules,
    other: ArmCapsules,
}

impl PersonCapsules {
    /// Around both arms, as perception estimated them `since` cycles ago; none when one of them was never seen, or its numbers are not
    /// finite: then she may be anywhere.
    pub fn of(percept: &Percept, since: u64, limits: &PersonLimits, stale: &StaleLimits) -> Option<Self> {
        let arm = |arm| ArmCapsules::of(arm, since, limits, stale);
        Some(Self { acting: arm(percept.acting_arm())?, other: arm(percept.other_arm())?.keeping_apart() })
    }

    /// The same with whichever of these parts is nearest to the acting hand in it; see [`ArmCapsules::holding`].
    pub fn holding(self, seen: impl Iterator<Item = (usize, Capsule, f64)>, within: f64) -> Self {
        Self { acting: self.acting.holding(seen, within), ..self }
    }

    /// Index, among the parts that were seen, of what is in the hand.
    pub fn held(&self) -> Option<usize> {
        self.acting.held()
    }

    /// Upper arm, forearm and hand of the acting arm, and what it holds, `ahead` s from now.
    pub fn acting_after(&self, ahead: f64) -> impl Iterator<Item = Capsule> + use<> {
        self.acting.after(ahead)
    }

    /// The same of the other arm.
    pub fn other_after(&self, ahead: f64) -> impl Iterator<Item = Capsule> + use<> {
        self.other.after(ahead)
    }

    /// All that is known of her body.
    pub fn parts(&self) -> impl Iterator<Item = &BodyPart> {
        self.acting.parts().chain(self.other.parts())
    }
}
