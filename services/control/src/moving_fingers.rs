use coact_robot::HAND_JOINTS;

/// Fingers on their way to a shape.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MovingFingers {
    /// Where they are, and where they go, rad (message order).
    pub angles: [f64; HAND_JOINTS],
    pub target: [f64; HAND_JOINTS],
    /// Their greatest speed, rad/s, and the time in which they would stand if they braked, s.
    pub speed: f64,
    pub stops_in: f64,
}

/// Fingers that move are looked at so far ahead on their way at least, rad: of what hardly moves yet, no distance tells whether it
/// closes.
const FINGERS_STEP: f64 = 0.05;

impl MovingFingers {
    /// Where they would stand if they braked, rad: a little farther than they would.
    pub fn stopped(&self) -> [f64; HAND_JOINTS] {
        let way: [f64; HAND_JOINTS] = std::array::from_fn(|joint| self.target[joint] - self.angles[joint]);
        let longest = way.iter().fold(0.0, |longest: f64, way| longest.max(way.abs()));
        let travel = FINGERS_STEP.max(self.speed * self.stops_in);
        let fraction = if longest > travel { travel / longest } else { 1.0 };
        std::array::from_fn(|joint| self.angles[joint] + fraction * way[joint])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn they_stand_on_their_way_and_not_beyond_it() {
        let way = |target: f64, speed: f64| {
            let angles = [0.2; HAND_JOINTS];
            let fingers = MovingFingers { angles, target: [target; HAND_JOINTS], speed, stops_in: 0.1 };
            fingers.stopped()[0]
        };
        for (target, speed, stopped) in [(1.2, 2.0, 0.4), (1.2, 0.0, 0.25), (0.3, 2.0, 0.3), (-0.8, 2.0, 0.0)]
        {
            assert!((way(target, speed) - stopped).abs() < 1e-12, "{}", way(target, speed));
        }
    }
}
