use coact_joint_task::Task;
use coact_messages::{HandView, Keypoint, SceneView, Sighting};
use coact_recordings::{Frame, ImagePoint, Reach};

/// Scale that the recordings' pixels are given: it makes the median forearm 0.26 m long. One figure for all people:
/// what is left of their differences, perception has to cope with.
pub const METRES_PER_PIXEL: f64 = 0.008;
/// Cycles from one frame of the object recogniser to the next.
const SCENE_PERIOD: u64 = 33;

/// Shows one recorded reach as the robot's sensors would: the image lies flat in space, and the hand begins where the
/// task has it rest.
pub(crate) struct Camera<'a> {
    task: &'a Task,
    /// Pixel position that the resting wrist is laid upon.
    origin: [f64; 2],
    /// Where the object lies, from the resting wrist, pixels.
    object: [f64; 2],
}

/// Where a person's object lay, from the resting wrist, pixels. The recordings do not tell, though any camera would
/// see it: so it is taken from where the hand is at the grasp, the median of all sizes. It was one place for all.
pub(crate) fn object_place(person: &[&Reach]) -> [f64; 2] {
    let mut places = [Vec::new(), Vec::new()];
    for reach in person {
        let Some(rest) = first_wrist(reach) else { continue };
        let grasp =
            reach.frames.iter().find(|frame| frame.time >= reach.movement_time && is_hand_found(frame));
        let Some([thumb, index]) = grasp.map(|frame| [4, 6].map(|joint| frame.joints[joint])) else {
            continue;
        };
        places[0].push(0.5 * (thumb.x + index.x) - rest.x);
        places[1].push(0.5 * (thumb.y + index.y) - rest.y);
    }
    places.map(|mut values| {
        values.sort_unstable_by(f64::total_cmp);
        values.get(values.len() / 2).copied().unwrap_or(0.0)
    })
}

fn is_hand_found(frame: &Frame) -> bool {
    [2, 4, 6].iter().all(|joint| frame.joints[*joint].confidence > 0.0)
}

fn first_wrist(reach: &Reach) -> Option<ImagePoint> {
    reach.frames.iter().find(|frame| is_hand_found(frame)).map(|frame| frame.joints[2])
}

impl<'a> Camera<'a> {
    /// For one reach, whose first frame tells where the hand rests, to an object at `object` (see [`object_place`]).
    pub fn new(task: &'a Task, reach: &Reach, object: [f64; 2]) -> Self {
        let wrist = first_wrist(reach).unwrap_or_default();
        Self { task, origin: [wrist.x, wrist.y], object }
    }

    /// Delivers one frame of the hand tracker.
    pub fn show_hand(&self, frame: &Frame, cycle: u64, view: &mut HandView) {
        let [x, y, z] = self.task.scene.person_rest;
        view.frame += 1;
        view.captured_cycle = cycle;
        view.keypoints = frame.joints.map(|joint| Keypoint {
            position: [
                x + (joint.x - self.origin[0]) * METRES_PER_PIXEL,
                y + (joint.y - self.origin[1]) * METRES_PER_PIXEL,
                z,
            ],
            confidence: joint.confidence.min(1.0),
        });
    }

    /// Delivers a frame of the object recogniser when one is due: every part that the task lays out, in the one place
    /// where the person's objects lay. Only the hand's shape tells which is meant.
    pub fn show_parts(&self, cycle: u64, view: &mut SceneView) {
        if !cycle.is_multiple_of(SCENE_PERIOD) {
            return;
        }
        view.frame += 1;
        view.captured_cycle = cycle;
        let [x, y, _] = self.task.scene.person_rest;
        let [right, down] = self.object.map(|pixels| pixels * METRES_PER_PIXEL);
        view.sightings = self.task.parts.len() as u32;
        for (slot, part) in view.sighting.iter_mut().zip(&self.task.parts) {
            *slot = Sighting {
                kind: part.kind as u32,
                reserved: 0,
                confidence: 0.95,
                position: [x + right, y + down, self.task.scene.table_height],
                orientation: [0.0, 0.0, 0.0, 1.0],
            };
        }
    }
}
