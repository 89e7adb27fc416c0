//! Where on the table another part can lie.

use crate::Task;

/// Least distance between the rims of two parts, and of a part from the base, m.
const APART: f64 = 0.06;
/// Least distance between the middles of two parts, m: the robot's fingers come down between them.
const FINGERS: f64 = 0.10;
/// How far the person's resting right hand takes up the table from her wrist, m: who sat there would not lay it onto a part. A hand that goes
/// back to rest over one looks like one that goes for it.
const RESTING_HAND: f64 = 0.20;

impl Task {
    /// Whether a part of this radius (m) can lie at `at` on the table, beside the base, the person's resting right hand, and other parts that
    /// lie there: middle and radius of each, m.
    pub fn has_room(
        &self,
        at: [f64; 2],
        radius: f64,
        mut others: impl Iterator<Item = ([f64; 2], f64)>,
    ) -> bool {
        let away = |[x, y]: [f64; 2]| (at[0] - x).hypot(at[1] - y);
        let scene = &self.scene;
        let [base, wrist] = [scene.platform, scene.person_rest].map(|[x, y, _]| [x, y]);
        away(wrist) >= RESTING_HAND
            && away(base) >= scene.platform_radius + radius + APART
            && others.all(|(place, other)| away(place) >= FINGERS.max(radius + other + APART))
    }
}
