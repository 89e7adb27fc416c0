/// A kind of part.
#[derive(Debug, Clone, PartialEq)]
pub struct Kind {
    /// Its name, as the robot says it.
    pub name: String,
    /// How far the fingers close on it, m.
    pub width: f64,
    /// Its shape.
    pub shape: Shape,
    /// Its mass, kg.
    pub mass: f64,
}

/// Shape of a part; its frame is at the centre of its underside, z up.
#[derive(Debug, Clone, Copy, PartialEq, serde::Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub enum Shape {
    /// Upright cylinder, m.
    Cylinder {
        /// Radius, m.
        radius: f64,
        /// Height, m.
        height: f64,
    },
    /// Box of full extents x, y, z, m.
    Box {
        /// Extents, m.
        size: [f64; 3],
    },
}

impl Shape {
    /// Extents of the box around it, m.
    pub fn extents(&self) -> [f64; 3] {
        match *self {
            Self::Cylinder { radius, height } => [2.0 * radius, 2.0 * radius, height],
            Self::Box { size } => size,
        }
    }

    /// The same shape, as high, but so much wider on every side, m.
    pub fn widened(self, by: f64) -> Self {
        match self {
            Self::Cylinder { radius, height } => Self::Cylinder { radius: radius + by, height },
            Self::Box { size: [x, y, z] } => Self::Box { size: [x + 2.0 * by, y + 2.0 * by, z] },
        }
    }

    /// Height above its frame, m.
    pub fn height(&self) -> f64 {
        self.extents()[2]
    }

    /// Radius of the round room that it needs when it stands upright, m.
    pub fn radius(&self) -> f64 {
        match *self {
            Self::Cylinder { radius, .. } => radius,
            Self::Box { size: [x, y, _] } => 0.5 * x.hypot(y),
        }
    }
}
