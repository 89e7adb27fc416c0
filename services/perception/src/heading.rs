use nalgebra::Vector3;

/// Scatter of a reach's end point about the line of its present movement: at the target (m), and per metre of way left,
/// for people reach in an arc. Chosen by hand.
const SCATTER: (f64, f64) = (0.05, 0.30);
/// Speed below which a movement has no direction, m/s: the tracker's scatter alone makes some cm/s.
const DIRECTED: f64 = 0.10;

/// Where the hand is going, on the table plane.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Heading {
    /// Middle between thumb and index tip, m.
    pub centre: Vector3<f64>,
    /// Its velocity, m/s.
    pub velocity: Vector3<f64>,
}

impl Heading {
    /// How well the movement leads to `target`, in (0, 1]: the nearer the hand, the sharper; not at all when it leads away.
    pub fn leads_to(&self, target: Vector3<f64>) -> f64 {
        let way = (target - self.centre).xy();
        let velocity = self.velocity.xy();
        let distance = way.norm();
        let ahead = velocity.try_normalize(DIRECTED).map(|direction| way.dot(&direction));
        let (miss, left) = match ahead {
            Some(ahead) if ahead > 0.0 => ((distance * distance - ahead * ahead).max(0.0).sqrt(), distance),
            Some(_) => (distance, 0.0),
            None => (distance, distance),
        };
        let scatter = SCATTER.0 + SCATTER.1 * left;
        (-0.5 * (miss / scatter).powi(2)).exp()
    }
}
