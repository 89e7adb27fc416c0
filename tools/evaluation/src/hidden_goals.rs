use coact_joint_task::{Act, Agent, NetworkPlan, Task};
use coact_messages::{SceneView, Truth};
use coact_seen_parts::{SeenParts, hides};

/// How many goals plan and memory leave to a hand that is out of sight: of each chain that takes a part of the person's, those subgoals whose
/// turn has come, where such a part was seen last in the person's workspace and may not be seen now.
pub(crate) fn hidden_goals(
    task: &Task,
    plan: &NetworkPlan,
    truth: &Truth,
    parts: &SeenParts,
    scene: &SceneView,
) -> usize {
    let [low, high] = task.scene.workspace[Agent::Person.index()];
    let lies_there = |at: [f64; 3]| (0..2).all(|axis| (low[axis]..=high[axis]).contains(&at[axis]));
    let is_hidden = |kind: usize| {
        let mut own =
            parts.all().iter().filter(|part| part.kind as usize == kind && lies_there(part.position));
        own.any(|part| hides(scene, task, part))
    };
    let takes = |chain: &usize| {
        let chain = &task.chains[*chain];
        matches!(chain.act, Act::Grasp { .. }) && chain.from == Agent::Person && is_hidden(chain.kind)
    };
    let chains = (0..task.chains.len()).filter(takes);
    let due = |subgoal: &usize| task.is_available(*subgoal, truth.achieved);
    let goals =
        |chain: usize| (0..task.subgoals.len()).filter(due).filter_map(move |own| plan.goal(chain, own));
    chains.flat_map(goals).count()
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use bytemuck::Zeroable;
    use coact_messages::{Sighting, SiteGrid};
    use std::path::Path;

    #[test]
    fn what_is_seen_and_what_is_not_due_is_no_goal_of_a_hidden_hand() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
        let (task, plan) = NetworkPlan::load(&file).unwrap();
        let [low, high] = task.scene.workspace[Agent::Person.index()];
        let [x, y] = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
        let kind = |name: &str| task.kinds.iter().position(|kind| kind.name == name).unwrap();
        let part = |name: &str, y: f64| Sighting {
            kind: kind(name) as u32,
            position: [x, y, task.scene.table_height],
            orientation: [0.0, 0.0, 0.0, 1.0],
            ..Sighting::default()
        };
        let goals = |parts: &[Sighting], achieved: u64, before_them: u8| {
            let mut scene: Box<SceneView> = bytemuck::zeroed_box();
            scene.surface.grid = SiteGrid { first: [x - 0.8, y - 0.8], spacing: [0.04; 2], sites: [40, 40] };
            scene.surface.level = task.scene.table_height;
            scene.surface.height.fill(before_them);
            (scene.captured_cycle, scene.sightings) = (33, parts.len() as u32);
            scene.sighting[..parts.len()].copy_from_slice(parts);
            let mut seen = SeenParts::none();
            seen.see(&scene, &task);
            hidden_goals(&task, &plan, &Truth { achieved, ..Truth::zeroed() }, &seen, &scene)
        };
        let (wheel, column) = (part("wheel", y), part("column 2", y + 0.15));
        assert_eq!(goals(&[wheel, column], 0, 40), 2, "a wheel for either side, and no column is due");
        let own = task.subgoals.iter().position(|goal| goal.kind == kind("wheel")).unwrap();
        assert_eq!(goals(&[wheel, column], 1 << own, 40), 1, "one is done");
        assert_eq!(goals(&[column], 0, 40), 0, "nothing that is due is hidden");
        assert_eq!(goals(&[wheel, column], 0, 0), 0, "all is in view");
    }
}
