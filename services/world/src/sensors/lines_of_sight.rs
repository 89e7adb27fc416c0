use coact_messages::{box_before, limb_before};
use coact_motion::Capsule;

/// What stands between the robot's eye and what it looks at.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LinesOfSight<'a> {
    /// Where the eye is, m.
    pub eye: [f64; 3],
    /// What stands on the table beside the parts: centre and half extents, m.
    pub boxes: &'a [[f64; 6]],
    /// The robot's own links.
    pub robot: &'a [Capsule],
    /// The person's arm.
    pub person: &'a [Capsule],
}

impl LinesOfSight<'_> {
    /// Whether something stands before `place`.
    pub fn hide(&self, place: [f64; 3]) -> bool {
        let by_box = |own: &[f64; 6]| box_before(own, self.eye, place, 0.0).is_some();
        self.boxes.iter().any(by_box) || self.limbs().any(|limb| self.met(limb, place).is_some())
    }

    /// How far along the line of sight to `place` a limb is met, as a fraction of it.
    pub fn met(&self, limb: &Capsule, place: [f64; 3]) -> Option<f64> {
        limb_before([limb.start.into(), limb.end.into()], limb.radius, self.eye, place)
    }

    /// Arms: the robot's and the person's.
    pub fn limbs(&self) -> impl Iterator<Item = &Capsule> {
        self.robot.iter().chain(self.person)
    }
}
