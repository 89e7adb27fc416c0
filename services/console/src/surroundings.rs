use crate::Seen;
use coact_joint_task::Task;
use coact_messages::SensorSample;
use glam::{DQuat, DVec3};

/// What the person at the pointer sees: the parts, and the places that are free for what she holds. A part that a hand covers is
/// remembered where it was seen last.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Surroundings {
    /// Parts that are seen, or were a moment ago.
    pub things: Vec<Thing>,
    /// Sockets that nothing is in yet.
    pub sockets: Vec<Socket>,
}

/// A part that is seen, or was a moment ago.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Thing {
    /// Kind of part.
    pub kind: usize,
    /// Its middle, m.
    pub centre: DVec3,
    /// How far the fingers close on it, m.
    pub width: f64,
    /// Cycle in which it was seen last.
    pub seen: u64,
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
/// For how long a part that is not seen is taken to be where it was, cycles. Chosen by hand: longer than a hand covers it.
const REMEMBERED: u64 = 3_000;

impl Surroundings {
    /// Takes in what the newest messages show.
    pub fn look(&mut self, task: &Task, seen: &Seen) {
        if let Some(sample) = seen.sample {
            self.look_at_parts(task, sample);
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

    fn look_at_parts(&mut self, task: &Task, sample: &SensorSample) {
        let now = sample.header.cycle;
        let mut missing = std::mem::take(&mut self.things);
        for part in sample.scene.sightings() {
            let Some(kind) = task.kinds.get(part.kind as usize) else { continue };
            let half = DQuat::from_array(part.orientation) * DVec3::Z * (0.5 * kind.shape.height());
            let centre = DVec3::from(part.position) + half;
            let thing = Thing { kind: part.kind as usize, centre, width: kind.width, seen: now };
            let same = missing.iter().enumerate().filter(|(_, then)| then.kind == thing.kind);
            let away = |then: &Thing| then.centre.distance(centre);
            let nearest = same.min_by(|one, other| away(one.1).total_cmp(&away(other.1)));
            if let Some((index, _)) = nearest {
                missing.swap_remove(index);
            }
            self.things.push(thing);
        }
        missing.retain(|then| now.saturating_sub(then.seen) < REMEMBERED);
        self.things.append(&mut missing);
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use coact_messages::Sighting;
    use std::path::Path;

    #[test]
    fn a_part_that_is_covered_is_remembered_for_a_while_and_one_that_moves_is_the_same() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
        let task = Task::load(&file).unwrap();
        let mut sample: Box<SensorSample> = bytemuck::zeroed_box();
        let mut around = Surroundings::default();
        let mut look = |cycle: u64, places: &[[f64; 3]]| {
            sample.header.cycle = cycle;
            sample.scene.sightings = places.len() as u32;
            for (sighting, place) in sample.scene.sighting.iter_mut().zip(places) {
                let orientation = [0.0, 0.0, 0.0, 1.0];
                *sighting = Sighting { position: *place, orientation, ..bytemuck::Zeroable::zeroed() };
            }
            around.look(&task, &Seen { sample: Some(&sample), ..Seen::default() });
            around.things.iter().map(|thing| (thing.centre.x * 100.0).round()).collect::<Vec<_>>()
        };
        assert_eq!(look(1, &[[-0.9, 0.0, 0.8], [-0.5, 0.0, 0.8]]), [-90.0, -50.0]);
        assert_eq!(look(20, &[[-0.7, 0.0, 0.9]]), [-70.0, -90.0]);
        assert_eq!(look(3_100, &[[-0.7, 0.0, 0.9]]), [-70.0]);
        assert_eq!(around.sockets.len(), task.subgoals.len());
    }
}
