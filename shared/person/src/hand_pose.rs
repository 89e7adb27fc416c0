use bytemuck::{Pod, Zeroable};
use glam::DVec3;

/// Where the person's right hand is and how it is shaped.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable)]
pub struct HandPose {
    /// Wrist, m, world frame.
    pub wrist: [f64; 3],
    /// Direction of the hand on the table plane, rad, against the direction in which the person faces.
    pub heading: f64,
    /// Direction from wrist to knuckles against the table plane, rad; -pi/2 is straight down.
    pub pitch: f64,
    /// Distance of thumb tip and index tip, m.
    pub aperture: f64,
    /// Distance from the wrist to the middle between the finger tips, m: the less, the more the fingers are bent.
    pub extension: f64,
    /// How far that middle is off the line from wrist to knuckles, towards the thumb's side, m.
    pub aside: f64,
}

impl HandPose {
    /// Where the wrist is, m.
    pub fn wrist(&self) -> DVec3 {
        self.wrist.into()
    }

    /// This pose with what a second movement, which began at `from` and is at `now`, adds to it in each of its parts.
    pub(crate) fn moved_by(&self, from: &Self, now: &Self) -> Self {
        Self {
            wrist: std::array::from_fn(|axis| self.wrist[axis] + (now.wrist[axis] - from.wrist[axis])),
            heading: self.heading + (now.heading - from.heading),
            pitch: self.pitch + (now.pitch - from.pitch),
            aperture: self.aperture + (now.aperture - from.aperture),
            extension: self.extension + (now.extension - from.extension),
            aside: self.aside + (now.aside - from.aside),
        }
    }

    /// The pose at fraction `along` of the way from `self` to `end`.
    pub(crate) fn towards(&self, end: &Self, along: f64) -> Self {
        let mix = |from: f64, to: f64| from + (to - from) * along;
        Self {
            wrist: std::array::from_fn(|axis| mix(self.wrist[axis], end.wrist[axis])),
            heading: mix(self.heading, end.heading),
            pitch: mix(self.pitch, end.pitch),
            aperture: mix(self.aperture, end.aperture),
            extension: mix(self.extension, end.extension),
            aside: mix(self.aside, end.aside),
        }
    }
}
