use coact_joint_task::Task;

/// What is arranged in the scene beside what the person does: where parts are at the start, what hides them, when sensors
/// fail, and what the robot's fingers lose.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Staging {
    /// Subgoals whose parts are in their sockets at the start.
    pub achieved: Vec<usize>,
    /// Parts that lie elsewhere than the task lays them: index and place on the table top, m.
    pub moved: Vec<(usize, [f64; 2])>,
    pub occluders: Vec<Occluder>,
    pub blinds: Vec<Blind>,
    pub slips: Vec<Slip>,
}

/// Ticks of the run during which something is so: from the first one, up to the second.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct During(pub u64, pub u64);

/// A box that hides what is behind it from the sensors.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Occluder {
    /// Centre and half extents, m.
    pub block: [f64; 6],
    pub during: During,
}

/// A time in which sensors deliver nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Blind {
    pub what: Sense,
    pub during: During,
}

/// What a blind sensor should have seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Sense {
    Hand,
    Objects,
    All,
}

/// Once, the robot's fingers lose a part that they carry.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Slip {
    pub kind: usize,
    /// Cycles of carrying.
    pub after: u64,
    /// Where on the table it rolls to, m; none: it stays where it falls.
    pub to: Option<[f64; 2]>,
}

impl During {
    pub fn contains(self, tick: u64) -> bool {
        (self.0..self.1).contains(&tick)
    }
}

/// Occluders that a frame of the recogniser can name.
pub(crate) const MOST_OCCLUDERS: usize = 4;
/// Slips that a world can remember.
pub(crate) const MOST_SLIPS: usize = 64;

impl Staging {
    /// Lays the parts of `task` where this scene has them.
    pub fn lay(&self, task: &mut Task) {
        for &(part, at) in &self.moved {
            task.parts[part].at = at;
        }
    }

    /// The part in the socket of each subgoal that is achieved at the start: one that was not moved, where there is one.
    pub fn mounted(&self, task: &Task) -> Vec<(usize, usize)> {
        let mut mounted: Vec<(usize, usize)> = Vec::new();
        for &subgoal in &self.achieved {
            let free = |part: &usize| {
                task.parts[*part].kind == task.subgoals[subgoal].kind
                    && mounted.iter().all(|(_, taken)| taken != part)
            };
            let is_moved = |part: &usize| self.moved.iter().any(|(moved, _)| moved == part);
            let part = (0..task.parts.len()).filter(free).min_by_key(is_moved);
            mounted.extend(part.map(|part| (subgoal, part)));
        }
        mounted
    }

    /// The boxes that stand in the scene at `tick`, and how many they are; `own`, where there is one, is the person's.
    pub fn occluders(&self, tick: u64, own: Option<[f64; 6]>) -> ([[f64; 6]; MOST_OCCLUDERS], usize) {
        let (mut blocks, mut count) = ([[0.0; 6]; MOST_OCCLUDERS], 0);
        let staged = self.occluders.iter().filter(|occluder| occluder.during.contains(tick));
        for block in staged.map(|occluder| occluder.block).chain(own).take(MOST_OCCLUDERS) {
            blocks[count] = block;
            count += 1;
        }
        (blocks, count)
    }

    /// Whether the sensors of `what` deliver nothing at `tick`.
    pub fn is_blind(&self, what: Sense, tick: u64) -> bool {
        let concerns = |blind: &&Blind| blind.what == what || blind.what == Sense::All;
        self.blinds.iter().filter(concerns).any(|blind| blind.during.contains(tick))
    }

    /// The slip that is due when a part of `kind` has been carried for so many ticks; bits of `done` tell what happened
    /// already.
    pub fn slip(&self, kind: usize, carried: u64, done: u64) -> Option<(usize, Slip)> {
        let due = |(index, slip): &(usize, Slip)| {
            slip.kind == kind && carried > slip.after && done & (1 << index) == 0
        };
        self.slips.iter().copied().enumerate().find(due)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_persons_own_box_stands_beside_those_of_the_scenario_as_far_as_a_frame_can_name_them() {
        let (block, own) = ([1.0; 6], [2.0; 6]);
        let staging = |count| {
            let occluders = vec![Occluder { block, during: During(0, 10) }; count];
            Staging { occluders, ..Staging::default() }
        };
        let (blocks, count) = staging(1).occluders(5, Some(own));
        assert_eq!(blocks[..count], [block, own]);
        assert_eq!(staging(1).occluders(10, Some(own)), ([own, [0.0; 6], [0.0; 6], [0.0; 6]], 1));
        assert_eq!(
            staging(MOST_OCCLUDERS).occluders(5, Some(own)),
            ([block; MOST_OCCLUDERS], MOST_OCCLUDERS)
        );
    }
}
