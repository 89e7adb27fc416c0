use coact_messages::ArmPath;
use serde::Serialize;

/// How long a movement took that the arm made to its end.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MovementTime {
    /// When it began, ms.
    pub from_ms: u64,
    /// How long it took, s: longer than planned where the arm was held back.
    pub taken_s: f64,
    /// How long it was to take, s.
    pub planned_s: f64,
    /// The shortest time in which its path could be followed under the limits of speed and acceleration, whatever the jerk, s.
    pub shortest_s: f64,
}

/// Follows the paths that the arm is commanded along; those that another one replaced on the way are left out.
#[derive(Debug, Clone, Default)]
pub(crate) struct MovementTimes {
    open: Option<MovementTime>,
    /// How far the arm had come on its path, s.
    elapsed: f64,
    done: Vec<MovementTime>,
}

impl MovementTimes {
    /// The path that the arm follows in cycle `at_ms`.
    pub fn tick(&mut self, path: &ArmPath, at_ms: u64) {
        let knots = &path.knots[..(path.count as usize).min(ArmPath::KNOTS)];
        let planned_s = knots.last().map_or(0.0, |knot| knot.t);
        let goes_on = |open: &MovementTime| open.planned_s == planned_s && open.shortest_s == path.shortest;
        if path.elapsed < self.elapsed || !self.open.as_ref().is_some_and(goes_on) {
            let begun = MovementTime { from_ms: at_ms, taken_s: 0.0, planned_s, shortest_s: path.shortest };
            self.open = Some(begun).filter(|_| path.shortest > 0.0 && path.elapsed < planned_s);
        }
        self.elapsed = path.elapsed;
        if path.elapsed >= planned_s
            && let Some(open) = self.open.take()
        {
            self.done.push(MovementTime { taken_s: (at_ms - open.from_ms) as f64 / 1e3, ..open });
        }
    }

    /// Those that are over.
    pub fn finish(self) -> Vec<MovementTime> {
        self.done
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bytemuck::Zeroable;

    /// A path of this duration, and how far the arm has come on it.
    fn path(planned_s: f64, elapsed: f64) -> ArmPath {
        let mut path = ArmPath { count: 2, elapsed, shortest: 0.5, ..ArmPath::zeroed() };
        path.knots[1].t = planned_s;
        path
    }

    #[test]
    fn movements_that_arrive_count_and_those_that_are_replaced_do_not() {
        let mut times = MovementTimes::default();
        for (at_ms, (planned_s, elapsed)) in
            [(0.6, 0.0), (0.6, 0.3), (0.7, 0.0), (0.7, 0.4), (0.7, 0.5), (0.7, 0.7), (0.7, 0.7)]
                .into_iter()
                .enumerate()
        {
            times.tick(&path(planned_s, elapsed), at_ms as u64);
        }
        let expected = MovementTime { from_ms: 2, taken_s: 0.003, planned_s: 0.7, shortest_s: 0.5 };
        assert_eq!(times.finish(), [expected]);
    }
}
