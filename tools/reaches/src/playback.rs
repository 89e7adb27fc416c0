use crate::camera::{Camera, object_place};
use coact_joint_task::Task;
use coact_messages::{Percept, SensorSample};
use coact_perception::Perception;
use coact_recordings::Reach;

/// How long the hand lies still as in the first frame, before the recording begins, cycles: time for the fields to
/// take up what lies where.
const SETTLING: u64 = 700;
/// Cycles between two frames while it lies still.
const PERIOD: u64 = 17;
/// Cycles without frames after each reach: the tracker loses the hand, and finds it where the next reach begins.
const GAP: u64 = 600;

/// Plays one person's recorded reaches to one perception, one after the other, at 1 kHz.
pub(crate) struct Playback<'a> {
    task: &'a Task,
    /// Where this person's objects lay, see [`object_place`].
    object: [f64; 2],
    perception: Perception,
    sample: Box<SensorSample>,
    percept: Box<Percept>,
    tick: u64,
}

impl<'a> Playback<'a> {
    /// For the reaches of one person.
    pub fn new(task: &'a Task, perception: Perception, person: &[&Reach]) -> Self {
        Self {
            task,
            object: object_place(person),
            perception,
            sample: bytemuck::zeroed_box(),
            percept: bytemuck::zeroed_box(),
            tick: 1,
        }
    }

    pub fn perception(&self) -> &Perception {
        &self.perception
    }

    /// Plays one reach; `each` is called after each cycle with its number and the percept. Gives the cycle of the
    /// recording's time 0.
    pub fn play(&mut self, reach: &Reach, mut each: impl FnMut(u64, &Percept)) -> u64 {
        let camera = Camera::new(self.task, reach, self.object);
        let first = reach.frames.first().map_or(0.0, |frame| frame.time);
        let start = self.tick + SETTLING;
        let cycle_of = |time: f64| start + ((time - first) * 1000.0).round() as u64;
        let mut next = 0;
        let end = reach.frames.last().map_or(start, |frame| cycle_of(frame.time)) + GAP;
        while self.tick < end {
            if self.tick < start && (start - self.tick).is_multiple_of(PERIOD) {
                if let Some(still) = reach.frames.first() {
                    camera.show_hand(still, self.tick, &mut self.sample.hand);
                }
            } else if let Some(frame) =
                reach.frames.get(next).filter(|frame| cycle_of(frame.time) <= self.tick)
            {
                camera.show_hand(frame, self.tick, &mut self.sample.hand);
                next += 1;
            }
            camera.show_parts(self.tick, &mut self.sample.scene);
            self.sample.header.cycle = self.tick;
            self.perception.step(self.tick, Some(&self.sample), &mut self.percept);
            self.percept.header.cycle = self.tick;
            each(self.tick, &self.percept);
            self.tick += 1;
        }
        cycle_of(0.0)
    }
}
