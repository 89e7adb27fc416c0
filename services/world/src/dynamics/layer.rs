use rapier3d::prelude::*;

/// What touches what.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Layer {
    /// Table, base and mounted parts.
    Fixture,
    /// Parts: touch everything but the person's hand, whose grasps follow rules.
    Part,
    /// A part that enters its socket: fits into what it is mounted in.
    Entering,
    /// A part that slips out of closed fingers.
    Slipping,
    /// A part in the person's hand, who puts it past table, base and mounted parts, and into its socket.
    Carried,
    /// The robot's arm.
    Arm,
    /// Palm and fingers: touch what the arm does, but not the person's hand, with which they meet on a part.
    Hand,
    /// The person's hand.
    Person,
}

impl Layer {
    pub fn groups(self) -> InteractionGroups {
        let group = |layer: Self| Group::from_bits_truncate(1 << layer as u32);
        let any = |layers: &[Self]| layers.iter().fold(Group::NONE, |groups, layer| groups | group(*layer));
        let others = match self {
            Self::Fixture => any(&[Self::Part, Self::Slipping, Self::Arm, Self::Hand]),
            Self::Part => any(&[
                Self::Fixture,
                Self::Part,
                Self::Entering,
                Self::Slipping,
                Self::Carried,
                Self::Arm,
                Self::Hand,
            ]),
            Self::Slipping => any(&[Self::Fixture, Self::Part, Self::Carried]),
            Self::Entering => any(&[Self::Part, Self::Carried, Self::Arm, Self::Hand]),
            Self::Carried => any(&[Self::Part, Self::Slipping, Self::Entering, Self::Arm, Self::Hand]),
            Self::Arm => any(&[Self::Fixture, Self::Part, Self::Entering, Self::Carried, Self::Person]),
            Self::Hand => any(&[Self::Fixture, Self::Part, Self::Entering, Self::Carried]),
            Self::Person => any(&[Self::Arm]),
        };
        InteractionGroups::new(group(self), others, InteractionTestMode::And)
    }
}
