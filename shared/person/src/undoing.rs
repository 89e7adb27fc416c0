//! A step that is undone: a mounted part is taken out of its socket again, and laid down.

use crate::{Activity, Intention, Person, Surroundings, Variation};
use coact_joint_task::Agent;
use coact_random::Stream;
use glam::{DVec2, DVec3};
use rand::{Rng, RngExt};

/// So often a place to lay a part down is tried. Chosen by hand: the shipped tasks need a few.
const TRIES: u32 = 100;

impl Person {
    /// Where a part goes that is neither mounted nor given: back to where it is, or, if it is taken out of its socket, to a place that is
    /// free now.
    pub(crate) fn home_of(&self, part: usize, activity: Activity, around: &Surroundings) -> DVec3 {
        let own = around.parts.position(part);
        if activity != Activity::Undo {
            return own;
        }
        let mut rng = self.random.at(Stream::FreePlace, around.tick);
        around.free_place(part, &mut rng).unwrap_or(own)
    }
}

/// To undo the step of the person's own side for which a part was taken by `chain`, as long as the assembly is not completed, and nothing
/// that is achieved needs the step.
pub(crate) fn undoing(around: &Surroundings, chain: usize) -> Option<Intention> {
    let part = (0..around.task.parts.len()).find(|part| {
        let goal = around.parts.mounted_for(*part).filter(|goal| around.can_be_undone(*goal));
        goal.is_some() && around.mounting_chain(around.parts.kind(*part)) == Some(chain)
    })?;
    let variation = Variation::default();
    Some(Intention { activity: Activity::Undo, chain, subgoal: None, part: Some(part), variation })
}

impl Surroundings<'_> {
    fn can_be_undone(&self, goal: usize) -> bool {
        let (task, achieved) = (self.task, self.parts.achieved());
        let without = achieved & !(1 << goal);
        let is_needed = (0..task.subgoals.len())
            .any(|other| without & (1 << other) != 0 && !task.is_prepared(other, without));
        task.subgoals[goal].side == Agent::Person && !is_needed && !task.is_complete(achieved)
    }

    /// A place in the person's workspace where `part` has room, by chance.
    fn free_place<R: Rng>(&self, part: usize, rng: &mut R) -> Option<DVec3> {
        let scene = &self.task.scene;
        let radius = |part: usize| self.task.kinds[self.parts.kind(part)].shape.radius();
        let own = radius(part);
        let [low, high] = scene.workspace[Agent::Person.index()].map(DVec2::from);
        let (low, room) = (low + own, high - low - 2.0 * own);
        let is_free = |at: &DVec2| {
            let others = (0..self.task.parts.len()).filter(|other| *other != part);
            let lying = others.map(|other| (self.parts.position(other).truncate().to_array(), radius(other)));
            room.min_element() >= 0.0 && self.task.has_room(at.to_array(), own, lying)
        };
        let mut tried = (0..TRIES).map(|_| low + room * DVec2::new(rng.random(), rng.random()));
        tried.find(is_free).map(|at| at.extend(scene.table_height))
    }
}
