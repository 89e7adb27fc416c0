use crate::spline::{Row, Spline};
use coact_recordings::{ArmRecording, ArmSample};
use glam::DVec3;

/// Where a recorded arm is, at every time: one recorded stretch after the other, then from the beginning again.
///
/// From the end of a stretch the arm goes to the beginning of the next one by itself: that was not recorded.
#[derive(Debug, Clone)]
pub(crate) struct ArmCourse {
    pieces: Vec<Piece>,
    /// Until it begins again, s.
    duration: f64,
}

/// A recorded stretch, and the way from its end to the beginning of the next one.
#[derive(Debug, Clone)]
struct Piece {
    begins: f64,
    recorded: Spline,
    joining: Joining,
}

/// A movement that joins two stretches: a quintic from the one's end with its velocity to the other's beginning with its
/// velocity. Both end without acceleration, as natural splines do, so that it is continuous throughout.
#[derive(Debug, Clone)]
struct Joining {
    from: (Row, Row),
    to: (Row, Row),
    duration: f64,
}

/// Mean speed of the way from one stretch to the next, m/s, and its shortest time, s. Chosen by hand: that of a hand that is
/// in no hurry, so that what was not recorded is no test.
const JOINING_SPEED: f64 = 0.3;
const SHORTEST_JOINING: f64 = 1.5;

impl ArmCourse {
    pub fn of(recording: &ArmRecording) -> Self {
        let row =
            |sample: &ArmSample| -> Row { std::array::from_fn(|axis| sample.joints[axis / 3][axis % 3]) };
        let splines = recording.stretches.iter();
        let splines: Vec<Spline> = splines
            .map(|stretch| Spline::through(stretch.iter().map(|sample| (sample.time, row(sample)))))
            .collect();
        let mut begins = 0.0;
        let pieces = splines.iter().enumerate().map(|(index, recorded)| {
            let next = &splines[(index + 1) % splines.len()];
            let joining = Joining::between(recorded.at(recorded.duration()), next.at(0.0));
            let piece = Piece { begins, recorded: recorded.clone(), joining };
            begins += piece.recorded.duration() + piece.joining.duration;
            piece
        });
        Self { pieces: pieces.collect(), duration: begins }
    }

    /// Shoulder, elbow and wrist after so many seconds.
    pub fn at(&self, elapsed: f64) -> [DVec3; 3] {
        let time = elapsed.rem_euclid(self.duration);
        let begun = self.pieces.partition_point(|piece| piece.begins <= time).max(1);
        let piece = &self.pieces[begun - 1];
        let (within, recorded) = (time - piece.begins, piece.recorded.duration());
        let row = if within <= recorded {
            piece.recorded.at(within).0
        } else {
            piece.joining.at(within - recorded)
        };
        std::array::from_fn(|joint| DVec3::from_slice(&row[3 * joint..3 * joint + 3]))
    }

    /// How long it lasts until it begins again, s.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// When its stretches begin and end, s.
    pub fn recorded(&self) -> impl Iterator<Item = (f64, f64)> {
        self.pieces.iter().map(|piece| (piece.begins, piece.begins + piece.recorded.duration()))
    }
}

impl Joining {
    fn between(from: (Row, Row), to: (Row, Row)) -> Self {
        let way = |joint: usize| {
            DVec3::from_slice(&from.0[3 * joint..]).distance(DVec3::from_slice(&to.0[3 * joint..]))
        };
        let longest = (0..3).map(way).fold(0.0, f64::max);
        Self { from, to, duration: (longest / JOINING_SPEED).max(SHORTEST_JOINING) }
    }

    fn at(&self, elapsed: f64) -> Row {
        let (along, span) = (elapsed / self.duration, self.duration);
        std::array::from_fn(|axis| {
            let (from, to) = (self.from.0[axis], self.to.0[axis]);
            let (leaves, arrives) = (self.from.1[axis] * span, self.to.1[axis] * span);
            let way = to - from;
            let cubic = 10.0 * way - 6.0 * leaves - 4.0 * arrives;
            let quartic = -15.0 * way + 8.0 * leaves + 7.0 * arrives;
            let quintic = 6.0 * way - 3.0 * (leaves + arrives);
            from + along * (leaves + along * along * (cubic + along * (quartic + along * quintic)))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two stretches far from each other, and moving at their ends.
    fn course() -> ArmCourse {
        let stretch = |begin: f64, place: f64| -> Vec<ArmSample> {
            let joint = |time: f64| [place + 0.1 * (2.0 * time).sin(), 0.1 * (1.5 * time).cos(), place];
            let times = (0..250).map(|index| begin + 0.01 * f64::from(index));
            times.map(|time| ArmSample { time, joints: [joint(time); 3] }).collect()
        };
        ArmCourse::of(&ArmRecording { stretches: vec![stretch(0.0, 0.0), stretch(4.0, 0.4)], duration: 6.5 })
    }

    #[test]
    fn stretches_are_joined_without_a_kick_and_begin_again() {
        let course = course();
        let [(_, end), (begin, _)] = [0, 1].map(|index| course.recorded().nth(index).unwrap_or_default());
        assert!(begin - end >= SHORTEST_JOINING);
        let at = |step: i32| course.at(0.001 * f64::from(step))[2];
        assert!(at(0).distance(course.at(course.duration())[2]) < 1e-9);
        let most = (1..(2e3 * course.duration()) as i32)
            .map(|step| 1e6 * (at(step + 1) - 2.0 * at(step) + at(step - 1)).length())
            .fold(0.0, f64::max);
        assert!(most < 3.0, "{most} m/s²");
    }
}
