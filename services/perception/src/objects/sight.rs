use coact_messages::{SceneView, is_blocked_by_limb};

/// What would be seen this near to the edge of an occluder may be hidden, m: the scatter of sightings, and of where the
/// occluder is.
pub(super) const EDGE: f64 = 0.02;
/// How far from the line between its joints an arm may hide something, m: half of a strong arm's width, and what its joints are misplaced by.
const ARM: f64 = 0.07;

/// Upper arm and forearm, each from joint to joint, m.
pub(crate) type Limbs = [[[f64; 3]; 2]; 2];

/// What the robot's eye can see of the table: what stands on it, and the person's arm, hide what is behind them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sight<'a> {
    /// The recogniser's newest frame.
    pub view: &'a SceneView,
    /// Where the eye is, m.
    pub eye: [f64; 3],
    /// The person's arm when the frame was taken, if it was followed.
    pub arm: Option<Limbs>,
}

impl Sight<'_> {
    /// Whether the eye may not see what is at `place`.
    pub fn hides(&self, place: [f64; 3]) -> bool {
        let by_arm = || {
            let mut limbs = self.arm.iter().flatten();
            limbs.any(|limb| is_blocked_by_limb(*limb, ARM, self.eye, place))
        };
        self.view.hides(self.eye, place, EDGE) || by_arm()
    }
}
