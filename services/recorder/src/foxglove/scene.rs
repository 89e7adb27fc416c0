use super::schemas;
use super::values::{UPRIGHT, WORLD, colour, place, point, pose, time};
use coact_joint_task::Task;
use coact_messages::{HandView, KeypointName, SceneView, SensorSample, Sighting};
use coact_robot::Robot;
use coact_run_recording::JsonSchema;
use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion};
use serde_json::{Map, Value, json};

/// Robot, person and parts as shapes, as `foxglove.SceneUpdate`: what the sensors see of them.
pub(crate) struct Scene {
    robot: Robot,
    /// Name of each kind of part, and the box around it, m.
    kinds: Vec<(String, [f64; 3])>,
    pub schema: JsonSchema,
}

/// Colours, and how thick lines are, m. For the eye only.
const ROBOT: ([f64; 4], f64) = ([0.47, 0.55, 0.65, 1.0], 0.08);
const PERSON: ([f64; 4], f64) = ([0.85, 0.6, 0.45, 1.0], 0.06);
const PART: [f64; 4] = [0.75, 0.6, 0.35, 1.0];
const OCCLUDER: [f64; 4] = [0.5, 0.5, 0.5, 0.5];
const WORDS: [f64; 4] = [0.1, 0.1, 0.1, 1.0];
/// Height of a part's name, m.
const FONT_SIZE: f64 = 0.02;
/// The person's arm as a line.
const ARM: [KeypointName; 4] =
    [KeypointName::Shoulder, KeypointName::Elbow, KeypointName::Wrist, KeypointName::IndexTip];

impl Scene {
    pub const TOPIC: &str = "/scene";

    pub fn new(robot: Robot, task: &Task) -> Self {
        let kinds = task.kinds.iter().map(|kind| (kind.name.clone(), kind.shape.extents())).collect();
        Self { robot, kinds, schema: schemas::scene_update() }
    }

    /// At `ns` since 1970.
    pub fn of(&self, sample: &SensorSample, ns: u64) -> Value {
        let seen = sample.scene.sightings();
        let parts: Vec<_> = seen.iter().filter_map(|part| self.part(part)).collect();
        let names: Vec<_> = seen.iter().filter_map(|part| self.name(part)).collect();
        let entities = [
            entity("robot", ns, "lines", vec![line(&self.links(sample), ROBOT)]),
            entity(
                "person",
                ns,
                "lines",
                sample.hands.iter().map(|hand| line(&limbs(hand), PERSON)).collect(),
            ),
            entity("parts", ns, "cubes", parts),
            entity("names", ns, "texts", names),
            entity("obstacles", ns, "cubes", obstacles(&sample.scene)),
        ];
        json!({ "deletions": [], "entities": entities })
    }

    /// The robot's joints, from the base to the palm and the point between its fingers.
    fn links(&self, sample: &SensorSample) -> Vec<[f64; 3]> {
        let (arm, posture) = (self.robot.arm(), &sample.joints.position);
        let joints = (0..arm.joints.len()).map(|index| arm.frame(posture, index).translation.vector.into());
        joints.chain([place(&self.robot.grasp_point(posture))]).collect()
    }

    fn part(&self, part: &Sighting) -> Option<Value> {
        let (_, size) = self.kinds.get(part.kind as usize)?;
        let [x, y, z, w] = part.orientation;
        let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        let frame = Isometry3::from_parts(Translation3::from(part.position), turn);
        // A part's frame is at its underside, a cube's in its middle.
        let middle = place(&(frame * Point3::new(0.0, 0.0, 0.5 * size[2])));
        Some(cube(pose(&middle, &part.orientation), size, PART))
    }

    fn name(&self, part: &Sighting) -> Option<Value> {
        let (name, size) = self.kinds.get(part.kind as usize)?;
        let [x, y, z] = part.position;
        Some(json!({
            "pose": pose(&[x, y, z + size[2] + 2.0 * FONT_SIZE], &UPRIGHT),
            "billboard": true,
            "font_size": FONT_SIZE,
            "scale_invariant": false,
            "color": colour(WORDS),
            "text": name,
        }))
    }
}

/// One of the person's arms, as far as it is seen.
fn limbs(hand: &HandView) -> Vec<[f64; 3]> {
    let keypoints = ARM.map(|name| hand.keypoints[name as usize]);
    keypoints.iter().filter(|keypoint| keypoint.confidence > 0.0).map(|keypoint| keypoint.position).collect()
}

fn obstacles(scene: &SceneView) -> Vec<Value> {
    let shown = |[x, y, z, half_x, half_y, half_z]: [f64; 6]| {
        cube(pose(&[x, y, z], &UPRIGHT), &[2.0 * half_x, 2.0 * half_y, 2.0 * half_z], OCCLUDER)
    };
    scene.obstacles().iter().copied().map(shown).collect()
}

fn cube(pose: Value, size: &[f64; 3], of: [f64; 4]) -> Value {
    json!({ "pose": pose, "size": point(size), "color": colour(of) })
}

fn line(points: &[[f64; 3]], (of, thickness): ([f64; 4], f64)) -> Value {
    json!({
        "type": 0,
        "pose": pose(&[0.0; 3], &UPRIGHT),
        "thickness": thickness,
        "scale_invariant": false,
        "points": points.iter().map(point).collect::<Vec<_>>(),
        "color": colour(of),
        "colors": [],
        "indices": [],
    })
}

/// Shapes of one sort; what has the same id replaces them.
fn entity(id: &str, ns: u64, sort: &str, shapes: Vec<Value>) -> Value {
    let mut entity = Map::new();
    for empty in
        ["metadata", "arrows", "cubes", "spheres", "cylinders", "lines", "triangles", "texts", "models"]
    {
        entity.insert(empty.to_owned(), json!([]));
    }
    entity.insert("timestamp".to_owned(), time(ns));
    entity.insert("frame_id".to_owned(), WORLD.into());
    entity.insert("id".to_owned(), id.into());
    entity.insert("lifetime".to_owned(), time(0));
    entity.insert("frame_locked".to_owned(), false.into());
    entity.insert(sort.to_owned(), shapes.into());
    Value::Object(entity)
}
