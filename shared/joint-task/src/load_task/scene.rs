use crate::task_file::SceneEntry;
use crate::{Agent, Fit, Scene};

/// The workspace of an agent: its least and its greatest corner, m.
pub(super) fn corners(scene: &SceneEntry, agent: Agent) -> [[f64; 2]; 2] {
    let rectangle = match agent {
        Agent::Robot => &scene.robot_workspace,
        Agent::Person => &scene.person_workspace,
    };
    [rectangle.min, rectangle.max]
}

pub(super) fn scene(entry: &SceneEntry) -> Scene {
    Scene {
        table_height: entry.table.height,
        table_centre: entry.table.centre,
        table_size: entry.table.size,
        platform: entry.platform.at,
        platform_radius: entry.platform.radius,
        platform_height: entry.platform.height,
        steady: entry.steady.0.clone(),
        handover: entry.handover,
        person_rest: entry.person_rest,
        person_shoulder: entry.person_shoulder,
        workspace: [corners(entry, Agent::Robot), corners(entry, Agent::Person)],
        fit: Fit { position: entry.fit.position, angle: entry.fit.angle.to_radians() },
    }
}
