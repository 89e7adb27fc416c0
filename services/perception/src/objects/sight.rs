use coact_messages::SceneView;
use nalgebra::Vector3;

/// How much higher than a hand what is seen in its direction must be to hide it, m: its own back is as high above its middle.
const BACK: f64 = 0.05;

/// What the robot's eye sees of the table, in the recogniser's newest frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sight<'a> {
    /// The frame.
    pub view: &'a SceneView,
    /// Where the eye is, m.
    pub eye: [f64; 3],
}

impl Sight<'_> {
    /// Whether the eye may not see a part whose upper face is there, m: something higher is seen in its direction, or the picture does not tell.
    pub fn hides(&self, face: Vector3<f64>) -> bool {
        self.view.surface.hides(self.eye, face.into())
    }

    /// Whether something is seen before a hand at `place`.
    pub fn hides_hand(&self, place: [f64; 3]) -> bool {
        self.view.surface.above(self.eye, place).is_some_and(|above| above > BACK)
    }
}
