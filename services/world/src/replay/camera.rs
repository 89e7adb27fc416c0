use coact_joint_task::Task;
use coact_messages::{HandView, Keypoint, SceneView, Sighting};
use coact_person::FOREARM;
use coact_recordings::{Frame, ImagePoint, Reach, forearm};

/// Scale where nobody saw it, metres per pixel: that of the median person of the shipped recordings.
const USUAL_SCALE: f64 = 0.008;

/// Shows one person's reaches as the robot's sensors would: the image lies flat in space, and the hand begins where
/// the task has it rest.
pub(crate) struct Camera {
    /// Where the hand rests, m.
    rest: [f64; 3],
    /// Scale of the image, which has none of its own: the one that makes the person's forearm as long as the simulated person's.
    metres_per_pixel: f64,
    /// Every part that the task lays out, in the one place where the person's objects lay. Only the hand's shape tells
    /// which is meant.
    parts: Vec<Sighting>,
}

impl Camera {
    /// For the reaches of one person.
    pub fn new(task: &Task, person: &[&Reach]) -> Self {
        let rest = task.scene.person_rest;
        let metres_per_pixel = forearm(person).map_or(USUAL_SCALE, |length| FOREARM / length);
        let [right, down] = object_place(person).map(|pixels| pixels * metres_per_pixel);
        let seen = |kind: usize| Sighting {
            kind: kind as u32,
            reserved: 0,
            confidence: 0.95,
            position: [rest[0] + right, rest[1] + down, task.scene.table_height],
            orientation: [0.0, 0.0, 0.0, 1.0],
        };
        Self { rest, metres_per_pixel, parts: task.parts.iter().map(|part| seen(part.kind)).collect() }
    }

    /// What the hand tracker makes of one frame, of a reach that begins with the wrist at `origin`, pixels.
    pub fn show_hand(&self, frame: &Frame, origin: [f64; 2], view: &mut HandView) {
        let [x, y, z] = self.rest;
        view.keypoints = frame.joints.map(|joint| Keypoint {
            position: [
                x + (joint.x - origin[0]) * self.metres_per_pixel,
                y + (joint.y - origin[1]) * self.metres_per_pixel,
                z,
            ],
            confidence: joint.confidence.min(1.0),
        });
    }

    /// What the object recogniser makes of the scene.
    pub fn show_parts(&self, view: &mut SceneView) {
        view.sightings = self.parts.len() as u32;
        view.sighting[..self.parts.len()].copy_from_slice(&self.parts);
    }
}

/// Where the wrist rests before a reach, pixels.
pub(crate) fn origin(reach: &Reach) -> [f64; 2] {
    let wrist = first_wrist(reach).unwrap_or_default();
    [wrist.x, wrist.y]
}

/// Where a person's object lay, from the resting wrist, pixels. The recordings do not tell, though any camera would
/// see it: so it is taken from where the hand is at the grasp, the median of all sizes. It was one place for all.
fn object_place(person: &[&Reach]) -> [f64; 2] {
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
