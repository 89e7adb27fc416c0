use crate::Seen;
use coact_joint_task::Task;
use coact_messages::Sighting;
use coact_seen_parts::SeenParts;
use glam::{DQuat, DVec3};

/// What the person at the pointer sees: the parts, and the places that are free for what she holds. A part that something covers is
/// remembered where it was seen last.
#[derive(Debug, Clone, PartialEq)]
pub struct Surroundings {
    /// What the camera has shown of them.
    pub(crate) parts: SeenParts,
    /// Parts that are seen, or were and may still be there.
    pub things: Vec<Thing>,
    /// Sockets that nothing is in yet.
    pub sockets: Vec<Socket>,
}

/// A part that is seen, or was and may still be there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thing {
    /// Kind of part.
    pub kind: usize,
    /// Its middle, m.
    pub centre: DVec3,
    /// How far the fingers close on it, m.
    pub width: f64,
}

/// A place that is free for a part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Socket {
    /// Kind of part.
    pub kind: usize,
    /// Where the part's middle will be, m.
    pub centre: DVec3,
}

/// Above this, a subgoal counts as achieved.
const ACHIEVED: f64 = 0.5;

impl Surroundings {
    /// None: nothing has been seen yet.
    pub fn none() -> Self {
        Self { parts: SeenParts::none(), things: Vec::new(), sockets: Vec::new() }
    }

    /// Takes in what the newest messages show.
    pub fn look(&mut self, task: &Task, seen: &Seen) {
        if let Some(sample) = seen.sample {
            self.parts.see(&sample.scene, task);
            self.things.clear();
            self.things.extend(self.parts.all().iter().filter_map(|part| thing(task, part)));
        }
        let open = |subgoal: &usize| {
            let achieved = |percept: &coact_messages::Percept| percept.achieved.get(*subgoal).copied();
            seen.percept.and_then(achieved).is_none_or(|sign| sign < ACHIEVED)
        };
        let sockets = (0..task.subgoals.len()).filter(open).map(|subgoal| {
            let subgoal = &task.subgoals[subgoal];
            let half = 0.5 * task.kinds[subgoal.kind].shape.height();
            let centre = DVec3::from(subgoal.socket) + half * DVec3::from(subgoal.axis);
            Socket { kind: subgoal.kind, centre }
        });
        self.sockets.clear();
        self.sockets.extend(sockets);
    }
}

/// `None` where its kind is none of the task's.
fn thing(task: &Task, part: &Sighting) -> Option<Thing> {
    let kind = task.kinds.get(part.kind as usize)?;
    let half = DQuat::from_array(part.orientation) * DVec3::Z * (0.5 * kind.shape.height());
    Some(Thing { kind: part.kind as usize, centre: DVec3::from(part.position) + half, width: kind.width })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use coact_messages::SensorSample;
    use std::path::Path;

    #[test]
    fn a_part_that_is_covered_is_remembered_and_places_are_free_until_something_is_in_them() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
        let task = Task::load(&file).unwrap();
        let mut sample: Box<SensorSample> = bytemuck::zeroed_box();
        let mut around = Surroundings::none();
        let mut look = |cycle: u64, places: &[[f64; 3]]| {
            sample.scene.captured_cycle = cycle;
            sample.scene.sightings = places.len() as u32;
            for (sighting, place) in sample.scene.sighting.iter_mut().zip(places) {
                let orientation = [0.0, 0.0, 0.0, 1.0];
                *sighting = Sighting { position: *place, orientation, ..bytemuck::Zeroable::zeroed() };
            }
            around.look(&task, &Seen { sample: Some(&sample), ..Seen::default() });
            around.things.iter().map(|thing| (thing.centre.x * 100.0).round()).collect::<Vec<_>>()
        };
        assert_eq!(look(1, &[[-0.9, 0.0, 0.8], [-0.5, 0.0, 0.8]]), [-90.0, -50.0]);
        assert_eq!(look(34, &[[-0.5, 0.05, 0.8]]), [-50.0, -90.0]);
        assert_eq!(around.sockets.len(), task.subgoals.len());
    }
}
