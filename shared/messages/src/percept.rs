use crate::plausible::{ensure, fractions, index, orientations, places};
use crate::{
    ArmSide, Destinations, Flaw, Grips, Header, MAX_ACTS, MAX_KINDS, MAX_SUBGOALS, PersonArm, Plausible,
    WORKSPACES,
};
use bytemuck::{Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;

/// What perception makes of the sensor samples: evidence in [0, 1], never labels (1 kHz).
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
#[type_name("coact::Percept")]
pub struct Percept {
    /// Header.
    pub header: Header,
    /// Where each of the person's arms is, by [`ArmSide`](crate::ArmSide).
    pub arms: [PersonArm; 2],
    /// What the hand does with which the person acts.
    pub hand: HandPercept,
    /// Evidence for each observable act, in the order of `Task::acts`; of a grasp, that the hand holds such a part, whatever its grip: what drives the
    /// action observation layer, of a grasp as far as the grip field tells that grip.
    pub act: [f64; MAX_ACTS],
    /// Where the hand's movement may lead: what drives the destination field.
    pub destinations: Destinations,
    /// Which grips the hand may be in: what drives the grip field.
    pub grips: Grips,
    /// What lies in each workspace: [`ROBOT`](crate::ROBOT), [`PERSON`](crate::PERSON).
    pub workspace: [WorkspacePercept; WORKSPACES],
    /// Evidence that a subgoal's part is in its place, by subgoal index.
    pub achieved: [f64; MAX_SUBGOALS],
    /// Evidence that a subgoal's place is in view and empty. Neither achieved nor open = out of view.
    pub open: [f64; MAX_SUBGOALS],
    /// Evidence that the robot's hand holds a part of this kind (touch and sight together).
    pub robot_holds: [f64; MAX_KINDS],
    /// Evidence that the person's hand holds a part of this kind.
    pub person_holds: [f64; MAX_KINDS],
    /// Evidence that the robot has lost a part of this kind out of its hand (touch and sight together).
    pub lost: [f64; MAX_KINDS],
    /// Perception's state, as opaque words: what else it needs to go on. `services/perception` says what each holds; other
    /// readers ignore them.
    pub state: [f64; 1792],
}

/// What the person's acting hand does at this tick; the [`PersonArm`] of its side says where it is.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
pub struct HandPercept {
    /// Distance of thumb tip and index tip, m.
    pub aperture: f64,
    /// 1 while a reach is under way, else 0.
    pub reaching: u32,
    /// Which hand it is: [`ArmSide`](crate::ArmSide) as a number.
    pub side: u32,
    /// Cycles since the onset of the present reach; 0 when none is under way.
    pub since_onset: u64,
}

/// What lies in one workspace, by kind of part.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
pub struct WorkspacePercept {
    /// Evidence that at least one part of this kind lies here and is free (in nobody's hand, not mounted).
    pub seen: [f64; MAX_KINDS],
    /// Evidence that none lies here: its place is in view and empty. Neither seen nor gone = out of view.
    pub gone: [f64; MAX_KINDS],
    /// Where the one lies that is nearest to the workspace's owner, m; the last known place when out of view.
    pub position: [[f64; 3]; MAX_KINDS],
    /// Its orientation, quaternion x, y, z, w.
    pub orientation: [[f64; 4]; MAX_KINDS],
}

impl Percept {
    /// Tells the same as `other`; header and state stay.
    pub fn tell_as(&mut self, other: &Self) {
        let told = size_of::<Header>()..std::mem::offset_of!(Self, state);
        bytemuck::bytes_of_mut(self)[told.clone()].copy_from_slice(&bytemuck::bytes_of(other)[told]);
    }

    /// The arm of the hand with which the person acts.
    pub fn acting_arm(&self) -> &PersonArm {
        &self.arms[self.acting() as usize]
    }

    /// The other one.
    pub fn other_arm(&self) -> &PersonArm {
        &self.arms[self.acting().other() as usize]
    }

    fn acting(&self) -> ArmSide {
        if self.hand.side == ArmSide::Left as u32 { ArmSide::Left } else { ArmSide::Right }
    }
}

impl Plausible for Percept {
    fn check(&self) -> Result<(), Flaw> {
        self.arms.iter().try_for_each(PersonArm::check)?;
        self.hand.check()?;
        fractions("act", &self.act)?;
        self.destinations.check()?;
        self.grips.check()?;
        self.workspace.iter().try_for_each(WorkspacePercept::check)?;
        fractions("achieved", &self.achieved)?;
        fractions("open", &self.open)?;
        fractions("robot_holds", &self.robot_holds)?;
        fractions("person_holds", &self.person_holds)?;
        fractions("lost", &self.lost)
    }
}

impl HandPercept {
    fn check(&self) -> Result<(), Flaw> {
        let is_distance = (0.0..=1.0).contains(&self.aperture);
        ensure(is_distance, "hand.aperture", "a distance of two fingertips")?;
        index("hand.reaching", self.reaching, 2)?;
        index("hand.side", self.side, ArmSide::BOTH.len())
    }
}

impl WorkspacePercept {
    fn check(&self) -> Result<(), Flaw> {
        fractions("workspace.seen", &self.seen)?;
        fractions("workspace.gone", &self.gone)?;
        places("workspace.position", self.position.as_flattened())?;
        orientations("workspace.orientation", &self.orientation)
    }
}
