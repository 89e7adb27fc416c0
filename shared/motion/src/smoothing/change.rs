use coact_robot::Posture;
use nalgebra::DVector;

/// A change of a movement, for all joints.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Change {
    /// Of the reach's bounce, rad.
    pub bounce: Posture,
    /// Of position, velocity and acceleration at each waypoint, as for a movement of 1 s. Without waypoints that may
    /// change, none.
    pub passed: Vec<[Posture; 3]>,
}

impl Change {
    /// From seven values for each shape: the bounce, then position, velocity and acceleration at each waypoint.
    pub(super) fn of(values: &DVector<f64>) -> Self {
        let of = |shape: usize| std::array::from_fn(|joint| values[7 * shape + joint]);
        let waypoints = values.len() / 7 / 3;
        let passed = (0..waypoints).map(|waypoint| [0, 1, 2].map(|order| of(1 + 3 * waypoint + order)));
        Self { bounce: of(0), passed: passed.collect() }
    }
}
