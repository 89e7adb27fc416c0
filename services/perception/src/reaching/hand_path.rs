use crate::hand::{TrackedHand, ViewFrame};
use bytemuck::{Pod, Zeroable};
use coact_messages::KeypointName;
use coact_period::seconds;
use coact_stage_state::{Implausible, ensure};
use nalgebra::Vector2;

/// Frames that are kept: a second at 60 Hz, longer than a reach.
const FRAMES: usize = 60;
/// Weight of a new frame in the place where the hand lies still. Chosen by hand; not sensitive.
const SETTLING: f64 = 0.25;
/// How far off the middle between its neighbours a frame shows no hand, m: several times the 3 mm that a hand goes off it at 60 Hz with 20 m/s², and
/// the tracker's scatter. Chosen by hand.
const MISTAKEN: f32 = 0.015;
/// A place is no farther from where the hand lay, m: an arm's length and some.
const FARTHEST: f32 = 10.0;

/// The way of the hand on the table plane since it lay still.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct HandPath {
    /// Where the middle between thumb and index tip lay, m.
    start: [f64; 2],
    /// 1 where the thumb is to the left of the hand as seen from above, -1 where it is to the right.
    thumb_side: f64,
    /// Cycle of the first frame.
    begins: u64,
    /// Frames so far.
    frames: u64,
    frame: [PathFrame; FRAMES],
}

/// Where the hand was in one frame.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct PathFrame {
    /// Since the first frame, s.
    pub time: f32,
    /// From where the hand lay, m.
    pub moved: [f32; 2],
}

impl HandPath {
    /// Frames that are kept at most.
    pub const MOST: usize = FRAMES;

    /// Where the hand lay before it moved, m.
    pub fn start(&self) -> Vector2<f64> {
        self.start.into()
    }

    /// On which side the thumb is: 1 left, -1 right, as seen from above.
    pub fn thumb_side(&self) -> f64 {
        self.thumb_side
    }

    /// What was seen since.
    pub fn frames(&self) -> &[PathFrame] {
        &self.frame[..self.frames as usize]
    }

    /// Takes in a new frame of the hand; `onset`: a movement has begun with it.
    pub fn observe(&mut self, hand: &TrackedHand, onset: bool) {
        if onset {
            self.frames = 0;
            hand.recent().iter().for_each(|frame| self.add(frame));
        } else if hand.movement.is_moving() {
            hand.recent().last().into_iter().for_each(|frame| self.add(frame));
        } else {
            self.settle(hand);
        }
    }

    fn settle(&mut self, hand: &TrackedHand) {
        let now = hand.centre().xy();
        let settled = self.frames == 0 && self.thumb_side != 0.0;
        let before = if settled { self.start() } else { now };
        self.frames = 0;
        self.start = (before + (now - before) * SETTLING).into();
        self.thumb_side = thumb_side(hand);
    }

    fn add(&mut self, frame: &ViewFrame) {
        if self.frames as usize == FRAMES {
            return;
        }
        if self.frames == 0 {
            self.begins = frame.cycle.max(1);
        }
        let moved = frame.centre().xy() - self.start();
        let time = seconds(frame.cycle.saturating_sub(self.begins)) as f32;
        self.frame[self.frames as usize] = PathFrame { time, moved: [moved.x as f32, moved.y as f32] };
        self.frames += 1;
        self.correct();
    }

    /// A frame that lies farther off the middle between its neighbours than a hand can go is mistaken: the hand was there.
    fn correct(&mut self) {
        let Some([.., before, frame, after]) = self.frame.get_mut(..self.frames as usize) else { return };
        let middle: [f32; 2] = std::array::from_fn(|axis| 0.5 * (before.moved[axis] + after.moved[axis]));
        if (frame.moved[0] - middle[0]).hypot(frame.moved[1] - middle[1]) > MISTAKEN {
            frame.moved = middle;
        }
    }

    /// The path of a hand that lay at `start`, and was seen at these times (s) so far from there (m).
    #[cfg(test)]
    pub fn of(start: Vector2<f64>, seen: impl Iterator<Item = (f64, Vector2<f64>)>) -> Self {
        let mut path = Self { start: start.into(), thumb_side: 1.0, begins: 1, ..Self::zeroed() };
        for ((time, moved), frame) in seen.zip(&mut path.frame) {
            *frame = PathFrame { time: time as f32, moved: [moved.x as f32, moved.y as f32] };
            path.frames += 1;
        }
        path
    }

    /// When the hand had first come so far from where it lay, m; s since the first frame, between frames where it passed in between. As
    /// long as it has not, the newest frame's.
    pub fn time_at(&self, distance: f64) -> f64 {
        let mut before = (0.0, 0.0);
        for frame in self.frames() {
            let [x, y] = frame.moved.map(f64::from);
            let now = (f64::from(frame.time), x.hypot(y));
            if now.1 >= distance {
                let part = ((distance - before.1) / (now.1 - before.1)).clamp(0.0, 1.0);
                return before.0 + part * (now.0 - before.0);
            }
            before = now;
        }
        before.0
    }

    /// Refuses what is no path.
    pub fn check(&self) -> Result<(), Implausible> {
        ensure(self.frames as usize <= FRAMES, "path.frames", "no more frames than are kept")?;
        let sides = [-1.0, 0.0, 1.0];
        ensure(sides.contains(&self.thumb_side), "path.thumb_side", "-1, 0 or 1")?;
        let start = self.start.iter().all(|value| value.abs() <= f64::from(FARTHEST));
        let near = |frame: &PathFrame| {
            frame.time.is_finite() && frame.moved.iter().all(|value| value.abs() <= 2.0 * FARTHEST)
        };
        ensure(start && self.frame.iter().all(near), "path", "places near the robot")
    }
}

/// Where the thumb is against the direction from wrist to index knuckle, seen from above.
fn thumb_side(hand: &TrackedHand) -> f64 {
    let at = |name: KeypointName| hand.point(name).xy();
    let wrist = at(KeypointName::Wrist);
    let (ahead, thumb) = (at(KeypointName::LittleKnuckle) - wrist, at(KeypointName::ThumbTip) - wrist);
    if ahead.perp(&thumb) < 0.0 { -1.0 } else { 1.0 }
}
