use coact_joint_task::{Agent, Task};
use coact_messages::PartState;
use glam::{DQuat, DVec3};

/// Who has a part: the values of [`PartState::state`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u32)]
pub enum Holder {
    /// It lies somewhere, or falls.
    Nobody = 0,
    /// It is in the robot's hand.
    Robot = 1,
    /// It is in the person's hand.
    Person = 2,
    /// It is mounted.
    Socket = 3,
}

/// Where all parts of the scene are, and who has them.
#[derive(Debug, Clone, Copy)]
pub struct PartsView<'a> {
    states: &'a [PartState],
}

impl<'a> PartsView<'a> {
    /// Looks at the parts of a scene.
    pub fn new(states: &'a [PartState]) -> Self {
        Self { states }
    }

    /// Kind of a part: index into [`Task::kinds`].
    pub fn kind(self, part: usize) -> usize {
        self.states[part].kind as usize
    }

    /// Whether a part is with `holder`.
    pub fn is(self, part: usize, holder: Holder) -> bool {
        self.states[part].state == holder as u32
    }

    /// Where the centre of a part's underside is, m.
    pub fn position(self, part: usize) -> DVec3 {
        self.states[part].position.into()
    }

    /// How a part is turned; its own axis is z.
    pub fn orientation(self, part: usize) -> DQuat {
        DQuat::from_array(self.states[part].orientation)
    }

    /// Centre of the part's body, m: where the person's fingers close.
    pub fn centre(self, part: usize, task: &Task) -> DVec3 {
        self.position(part)
            + self.orientation(part) * (0.5 * task.kinds[self.kind(part)].shape.height() * DVec3::Z)
    }

    /// Distance of `point` from the part's own axis, between its underside and its top, m.
    pub fn distance_to_axis(self, part: usize, point: DVec3, task: &Task) -> f64 {
        let foot = self.position(part);
        let axis = self.orientation(part) * (task.kinds[self.kind(part)].shape.height() * DVec3::Z);
        let along = ((point - foot).dot(axis) / axis.length_squared().max(1e-12)).clamp(0.0, 1.0);
        point.distance(foot + along * axis)
    }

    /// Bit i is set when subgoal i's part is in its place.
    pub fn achieved(self) -> u64 {
        let mounted = self.states.iter().filter(|part| part.state == Holder::Socket as u32);
        mounted.fold(0, |mask, part| mask | (1 << part.subgoal))
    }

    /// The subgoal in whose socket a part is mounted.
    pub fn mounted_for(self, part: usize) -> Option<usize> {
        self.is(part, Holder::Socket).then(|| self.states[part].subgoal as usize)
    }

    /// Whether a subgoal's turn has come: see [`Task::is_available`].
    pub fn is_available(self, subgoal: usize, task: &Task) -> bool {
        task.is_available(subgoal, self.achieved())
    }

    /// The free part of `kind` in the workspace of `owner` that lies nearest to `point`.
    pub fn nearest_free(self, kind: usize, owner: Agent, point: DVec3, task: &Task) -> Option<usize> {
        let [low, high] = task.scene.workspace[owner.index()];
        let lies_there = |part: &usize| {
            let at = self.states[*part].position;
            let inside = (0..2).all(|axis| at[axis] >= low[axis] && at[axis] <= high[axis]);
            inside && self.kind(*part) == kind && self.is(*part, Holder::Nobody)
        };
        let distance = |part: &usize| self.position(*part).distance_squared(point);
        (0..self.states.len())
            .filter(lies_there)
            .min_by(|one, other| distance(one).total_cmp(&distance(other)))
    }
}
