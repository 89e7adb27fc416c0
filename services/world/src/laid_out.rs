use crate::WorldError;
use coact_joint_task::Task;
use coact_pipeline::Layout;
use coact_random::{RandomStreams, Stream};
use glam::DVec2;
use rand::RngExt;

/// So often each part is tried, and so often all are tried anew. Chosen by hand: the shipped tasks need a few of each.
const TRIES: u32 = 100;
const ROUNDS: u64 = 1000;

/// The task with its parts where the layout has them. Sockets and the base stay where they are.
///
/// # Errors
/// [`WorldError::Scene`] when the workspaces have no room.
pub fn laid_out(task: &Task, layout: Layout) -> Result<Task, WorldError> {
    let Layout::Random(seed) = layout else { return Ok(task.clone()) };
    let random = RandomStreams::new(seed);
    let found = (0..ROUNDS).find_map(|round| places(task, random, round));
    let places = found.ok_or_else(|| WorldError::Scene {
        task: task.name.clone(),
        message: format!(
            "layout {layout}: found no room in the workspaces for all parts, with space around each; make [scene] \
             workspaces larger, or take --layout task"
        ),
    })?;
    let mut laid = task.clone();
    for (part, at) in laid.parts.iter_mut().zip(places) {
        part.at = at.to_array();
    }
    Ok(laid)
}

/// Places of all parts, one after another; none where one of them finds none.
fn places(task: &Task, random: RandomStreams, round: u64) -> Option<Vec<DVec2>> {
    let mut random = random.at(Stream::Layout, round);
    let mut places: Vec<DVec2> = Vec::new();
    for part in &task.parts {
        let radius = task.kinds[part.kind].shape.radius();
        let [low, high] = task.scene.workspace[part.workspace.index()].map(DVec2::from);
        let (low, room) = (low + radius, high - low - 2.0 * radius);
        let mut anywhere = || low + room * DVec2::new(random.random(), random.random());
        let place = (0..TRIES)
            .map(|_| anywhere())
            .find(|at| room.min_element() >= 0.0 && is_free(task, &places, *at))?;
        places.push(place);
    }
    Some(places)
}

/// Whether the next part fits there, beside those that have their places.
fn is_free(task: &Task, places: &[DVec2], at: DVec2) -> bool {
    let radius = |part: usize| task.kinds[task.parts[part].kind].shape.radius();
    let others = places.iter().enumerate().map(|(other, place)| (place.to_array(), radius(other)));
    task.has_room(at.to_array(), radius(places.len()), others)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use std::path::Path;

    #[test]
    fn parts_lie_apart_each_in_its_workspace_elsewhere_for_each_seed_and_sockets_stay() {
        for name in ["toy-vehicle", "electronics-box", "table-setting"] {
            let file =
                Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../rt-config/tasks/{name}.toml"));
            let task = Task::load(&file).unwrap();
            assert_eq!(laid_out(&task, Layout::Task).unwrap().parts, task.parts);
            let mut before = task.parts.clone();
            for seed in 0..50 {
                let laid = laid_out(&task, Layout::Random(seed)).unwrap();
                assert_eq!(laid_out(&task, Layout::Random(seed)).unwrap().parts, laid.parts);
                assert_eq!((&laid.subgoals, &laid.scene), (&task.subgoals, &task.scene));
                assert_ne!(laid.parts, std::mem::replace(&mut before, laid.parts.clone()));
                for (index, part) in laid.parts.iter().enumerate() {
                    let [low, high] = task.scene.workspace[part.workspace.index()];
                    let is_in = |axis: usize| (low[axis]..=high[axis]).contains(&part.at[axis]);
                    assert!(is_in(0) && is_in(1), "{name}, seed {seed}: {part:?}");
                    let radius = |part: usize| task.kinds[laid.parts[part].kind].shape.radius();
                    for other in 0..index {
                        let gap = DVec2::from(part.at).distance(laid.parts[other].at.into())
                            - radius(index)
                            - radius(other);
                        assert!(gap >= 0.06, "{name}, seed {seed}: {gap}");
                    }
                }
            }
        }
    }

    #[test]
    fn where_there_is_no_room_it_says_what_to_do() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
        let mut task = Task::load(&file).unwrap();
        task.scene.workspace[1][1] = task.scene.workspace[1][0].map(|low| low + 0.2);
        let refused = laid_out(&task, Layout::Random(1)).unwrap_err().to_string();
        assert!(refused.contains("no room") && refused.contains("--layout task"), "{refused}");
    }
}
