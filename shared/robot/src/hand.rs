use crate::Joint;
use nalgebra::{Isometry3, Point3, Vector2, Vector3};

/// A hand of three fingers: one spread angle, and a base and a coupled tip joint for each finger.
///
/// In the palm frame (z out of the palm, x the closing direction) finger 3 stands at -x, fingers 1 and 2 at +x when
/// the spread is zero. Angle 0 is a flat open hand; growing angles close. Tips follow their bases.
#[derive(Debug, Clone, PartialEq)]
pub struct Hand {
    /// Joints in message order: spread, three bases, three tips.
    pub joints: Vec<Joint>,
    /// Each finger: its chain from the palm frame to its end.
    pub fingers: [Finger; 3],
    /// Tip angle for each rad of base angle.
    pub coupling: f64,
    /// Spread of the fingers in every grasp, rad: how far fingers 1 and 2 stand apart from the closing axis.
    pub grasp_spread: f64,
    /// Half the width and half the thickness of a finger at its end, m.
    pub pad: [f64; 2],
    /// Distance of the grasp point from the palm frame's origin, along the palm's z axis, m.
    pub grasp_distance: f64,
    /// How far the palm reaches out of its frame's origin, along its z axis, m.
    pub palm_face: f64,
    /// Whether finger 3 fits between fingers 1 and 2 when all are closed.
    pub interlaces: bool,
    /// Half the hand's extent across approach and closing axis, m.
    pub half_breadth: f64,
}

/// How the hand stands around something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grasp {
    /// All hand joints in message order, rad.
    pub angles: [f64; HAND_JOINTS],
    /// How far from the palm frame's origin the fingers meet it, along the palm's z axis, m.
    pub depth: f64,
}

/// The chain of one finger, from the palm frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Finger {
    /// Spread joint (fingers 1 and 2 only), base joint, tip joint.
    pub joints: Vec<Joint>,
    /// Pose of the finger's end in the tip joint's frame.
    pub end: Isometry3<f64>,
}

/// Joints of a [`Hand`].
pub const HAND_JOINTS: usize = 7;
/// Halvings of a finger's range when the angle for a width is looked for: to the last bit of a range of some rad.
const HALVINGS: u32 = 60;

impl Hand {
    /// Angles of all hand joints (message order) with the spread of grasps and the bases at `base` rad.
    pub fn posture(&self, base: f64) -> [f64; HAND_JOINTS] {
        let tip = (base * self.coupling).min(self.joints[4].limits.upper);
        [self.grasp_spread, base, base, base, tip, tip, tip]
    }

    /// Place of each finger's end in the palm frame, m, for hand joint angles in message order.
    pub fn ends(&self, angles: &[f64; HAND_JOINTS]) -> [Point3<f64>; 3] {
        std::array::from_fn(|finger| self.end(finger, angles))
    }

    fn end(&self, finger: usize, angles: &[f64; HAND_JOINTS]) -> Point3<f64> {
        let Finger { joints, end } = &self.fingers[finger];
        let own = [angles[0], angles[1 + finger], angles[4 + finger]];
        let own = &own[3 - joints.len()..];
        let pose = joints.iter().zip(own).fold(Isometry3::identity(), |pose, (j, &a)| pose * j.transform(a));
        Point3::from((pose * end).translation.vector)
    }

    /// Base, tip joint and end of finger 3 at a base angle, rad: for each its distance from the palm's axis and that along
    /// it, m. Fingers 1 and 2 are alike on the other side.
    pub(crate) fn finger(&self, base: f64) -> [[f64; 2]; 3] {
        let Finger { joints, end } = &self.fingers[2];
        let knuckle = joints[0].transform(base);
        let middle = knuckle * joints[1].transform(self.posture(base)[6]);
        [knuckle, middle, middle * end].map(|pose| [-pose.translation.x, pose.translation.z])
    }

    /// How far fingers 1 and 2 reach from the palm's axis, across the closing axis, m.
    pub(crate) fn reach_aside(&self) -> f64 {
        self.fingers[0].joints[0].origin.translation.y.abs() + self.pad[0]
    }

    /// Clear width between fingers 1 and 2 with the spread of grasps, m.
    pub fn gap_aside(&self) -> f64 {
        let [knuckle, direction] = self.side_finger();
        2.0 * (direction.perp(&knuckle).abs() - self.pad[0])
    }

    /// Place of finger 1's knuckle in the palm's plane, m, and the direction in which the finger reaches from there in a grasp.
    fn side_finger(&self) -> [Vector2<f64>; 2] {
        let knuckle = self.fingers[0].joints[0].origin.translation.vector.xy();
        [knuckle, Vector2::new(self.grasp_spread.cos(), self.grasp_spread.sin())]
    }

    /// The hand around something round on the palm's axis, `width` m wide, with `gap` m between it and each finger. With a
    /// negative gap the fingers are commanded to close so far into it, which makes them press.
    ///
    /// Fingers 1 and 2 stand beside the palm's axis and meet a narrow part with their inner edges, so that their
    /// angles differ from finger 3's.
    pub fn grasp(&self, width: f64, gap: f64) -> Grasp {
        let [_, thickness] = self.pad;
        let radius = 0.5 * width + gap;
        let [knuckle, finger] = self.side_finger();
        let aside = (0.5 * self.gap_aside()).clamp(0.0, 0.5 * width);
        let across = (0.25 * width * width - aside * aside).sqrt() + gap;
        // A finger that leans over reaches less far inwards than it is thick.
        let base = |reach: f64| {
            let lean = ((1.0 + self.coupling) * self.base_for_width(2.0 * (reach + thickness))).sin();
            self.base_for_width(2.0 * (reach + thickness * lean.max(0.0)))
        };
        let (side, middle) = (base(across - finger.dot(&knuckle)), base(radius));
        let tip = |base: f64| (base * self.coupling).min(self.joints[4].limits.upper);
        let angles = [self.grasp_spread, side, side, middle, tip(side), tip(side), tip(middle)];
        let ends = self.ends(&angles);
        // A finger that leans inwards meets it with its inner edge, which is not as deep as the middle of its end.
        let met = |finger: usize| {
            ends[finger].z + thickness * (angles[1 + finger] + angles[4 + finger]).cos().min(0.0)
        };
        Grasp { angles, depth: 0.5 * (met(0) + met(2)) }
    }

    /// Clear width between the fingers, m: twice the distance of finger 3's end from the palm's axis. Fingers 1 and 2 are
    /// alike, so that it holds for every spread.
    pub fn width(&self, base: f64) -> f64 {
        -2.0 * self.end(2, &self.posture(base)).x
    }

    /// Base angle at which the fingers close on something `width` m wide. Bisection between flat open and fully
    /// closed; a width beyond the hand gives the nearest end.
    pub fn base_for_width(&self, width: f64) -> f64 {
        let limits = self.joints[1].limits;
        let (mut open, mut closed) = (limits.lower, limits.upper);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (open + closed);
            if self.width(middle) > width { open = middle } else { closed = middle }
        }
        0.5 * (open + closed)
    }

    /// The grasp point in the palm frame: where the finger ends meet what they close on.
    pub fn grasp_point(&self) -> Point3<f64> {
        Point3::new(0.0, 0.0, self.grasp_distance)
    }

    /// Palm pose that puts the grasp point at `point` with the palm's z axis along `approach` (unit) and its closing
    /// axis x turned by `roll` rad about it; at roll 0, x is as near to `closing_axis` as the approach allows.
    pub fn palm_at(
        &self,
        point: &Point3<f64>,
        approach: &Vector3<f64>,
        closing_axis: &Vector3<f64>,
        roll: f64,
    ) -> Isometry3<f64> {
        let grip = crate::grip_frame(point, approach, closing_axis, roll);
        grip * nalgebra::Translation3::new(0.0, 0.0, -self.grasp_distance)
    }
}
