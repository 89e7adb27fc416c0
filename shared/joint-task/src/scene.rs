use coact_messages::ArmSide;

/// The table, the base and the places on it; m, world frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Height of the table top.
    pub table_height: f64,
    /// Centre of the table top.
    pub table_centre: [f64; 2],
    /// Extents of the table top.
    pub table_size: [f64; 2],
    /// Centre of the round base's underside.
    pub platform: [f64; 3],
    /// Its radius.
    pub platform_radius: f64,
    /// Its height.
    pub platform_height: f64,
    /// Where the robot's hand may steady the base: at least one place.
    pub steady: Vec<[f64; 3]>,
    /// Where parts change hands.
    pub handover: [f64; 3],
    /// Where the person's right hand rests.
    pub person_rest: [f64; 3],
    /// The person's right shoulder.
    pub person_shoulder: [f64; 3],
    /// Rectangle of each workspace on the table top, by [`Agent::index`](crate::Agent::index): min and max corner.
    pub workspace: [[[f64; 2]; 2]; 2],
    /// How exactly a part must be in its place to be mounted when it is let go.
    pub fit: Fit,
}

/// Tolerances of a socket.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// Largest distance of the part's frame from the socket, m.
    pub position: f64,
    /// Largest angle between the part's own axis and the socket's, rad.
    pub angle: f64,
}

/// Where the robot's eye is: so far behind the world's origin, where the robot stands, and so high above the table top, m.
/// Chosen by hand: it sees both workspaces over the robot's own arm.
const EYE: (f64, f64) = (0.10, 1.05);

/// How far a shoulder is from the middle of the body, m. Chosen by hand, for an adult.
const SHOULDER: f64 = 0.18;

/// Where the second camera is: on a stand beside the table, across from the robot's arm; so far before the world's origin, to the left of
/// the middle of the table, and above the table top, m. Chosen by hand, of six places: from there the arm hides least.
const EYE_BESIDE: [f64; 3] = [-0.62, 0.60, 1.20];

impl Scene {
    /// Place of the camera that sees parts alone, past the robot's own arm. It looks towards the robot.
    pub fn eye_beside(&self) -> [f64; 3] {
        [EYE_BESIDE[0], self.table_centre[1] + EYE_BESIDE[1], self.table_height + EYE_BESIDE[2]]
    }

    /// Whether a place is in the picture of that camera: on the robot's side of it.
    pub fn is_before_eye_beside(&self, [x, _, _]: [f64; 3]) -> bool {
        x > EYE_BESIDE[0]
    }

    /// Where the hand of this arm rests. What the task says of the right one is mirrored for the left one.
    pub fn rest(&self, side: ArmSide) -> [f64; 3] {
        self.on_side(side, self.person_rest)
    }

    /// Where the shoulder of this arm is.
    pub fn shoulder(&self, side: ArmSide) -> [f64; 3] {
        self.on_side(side, self.person_shoulder)
    }

    /// A place of the right arm, mirrored for the left one at the plane through the middle of the body in which the person faces.
    fn on_side(&self, side: ArmSide, [x, y, z]: [f64; 3]) -> [f64; 3] {
        if side == ArmSide::Right {
            return [x, y, z];
        }
        let [ahead_x, ahead_y] = self.faces();
        let [left_x, left_y] = [-ahead_y, ahead_x];
        let [shoulder_x, shoulder_y, _] = self.person_shoulder;
        let middle = SHOULDER + (shoulder_x - x) * left_x + (shoulder_y - y) * left_y;
        [x + 2.0 * middle * left_x, y + 2.0 * middle * left_y, z]
    }

    /// Unit vector on the table plane in which the person faces: from the resting hand to where parts change hands.
    pub fn faces(&self) -> [f64; 2] {
        let ([x, y, _], [to_x, to_y, _]) = (self.person_rest, self.handover);
        let (x, y) = (to_x - x, to_y - y);
        let length = x.hypot(y);
        if length > 0.0 { [x / length, y / length] } else { [1.0, 0.0] }
    }

    /// Place of the camera that sees depth, hands and parts: above and behind the robot's head, over the middle of the table.
    pub fn eye(&self) -> [f64; 3] {
        [EYE.0, self.table_centre[1], self.table_height + EYE.1]
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use crate::Task;
    use std::path::Path;

    #[test]
    fn the_left_arm_is_the_mirror_image_of_the_right_one() {
        let tasks = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks");
        let Scene { person_rest, person_shoulder, .. } =
            Task::load(&tasks.join("toy-vehicle.toml")).unwrap().scene;
        let mut scene = Task::load(&tasks.join("toy-vehicle.toml")).unwrap().scene;
        // Turned about the world's origin, the picture is the same.
        for turns in 0..8 {
            let (sin, cos) = (0.7 * f64::from(turns)).sin_cos();
            let turned = |[x, y, z]: [f64; 3]| [x * cos - y * sin, x * sin + y * cos, z];
            let handover = [-0.60, 0.15, 1.00];
            (scene.person_rest, scene.person_shoulder) = (turned(person_rest), turned(person_shoulder));
            scene.handover = turned(handover);
            let ahead = scene.faces();
            let across = |of: fn(&Scene, ArmSide) -> [f64; 3]| {
                let [right, left] = ArmSide::BOTH.map(|side| of(&scene, side));
                assert_eq!(right[2], left[2]);
                let [x, y] = [0, 1].map(|axis| left[axis] - right[axis]);
                assert!((x * ahead[0] + y * ahead[1]).abs() < 1e-12, "across the way that the person faces");
                ahead[0] * y - ahead[1] * x
            };
            let (shoulders, hands) = (across(Scene::shoulder), across(Scene::rest));
            assert!((shoulders - 2.0 * SHOULDER).abs() < 1e-12, "{shoulders}");
            assert!((0.05..shoulders).contains(&hands), "the hands rest before the body: {hands}");
        }
    }
}
