use coact_console::{Cadence, Pointer, PointerHand, Seen, Surroundings, Wish};
use coact_joint_task::Task;
use coact_messages::{HandPoints, Speech, topic};
use coact_pipeline::RunSettings;
use coact_realtime::{Output, PortError, Process, now};
use std::time::{Duration, Instant};

/// From one frame of the partner's hand to the next: a camera's 60 Hz.
const FRAME: Duration = Duration::from_nanos(16_666_667);
/// A page that has not told of its pointer for so long is gone, and nobody sees the hand any more.
const POINTED_WITHIN: Duration = Duration::from_millis(250);

/// The person at a page: a hand and a voice.
pub struct PagePartner {
    hand: PointerHand,
    around: Surroundings,
    pointed: Option<(Pointer, Instant)>,
    frame: Cadence,
    /// When the hand was shown last.
    shown: Instant,
    hands: Option<Output<HandPoints>>,
    speech: Output<Speech>,
}

impl PagePartner {
    pub fn new(process: &Process, task: &Task, settings: &RunSettings) -> Result<Self, PortError> {
        let bus = process.bus();
        let hands = (settings.partner == RunSettings::HAND).then(|| bus.output(topic::HAND)).transpose()?;
        let speech = bus.output(topic::HEARD)?;
        let (hand, around) = (PointerHand::new(task), Surroundings::default());
        Ok(Self {
            hand,
            around,
            pointed: None,
            frame: Cadence::new(FRAME),
            shown: Instant::now(),
            hands,
            speech,
        })
    }

    pub fn take(&mut self, wish: Wish, cycle: u64) -> Result<(), PortError> {
        match wish {
            Wish::Point(pointer) => self.pointed = Some((pointer, Instant::now())),
            Wish::Hide => self.pointed = None,
            Wish::Say(sentence) => {
                let mut message = self.speech.loan()?;
                message.write(&sentence);
                message.send(cycle, now())?;
            }
        }
        Ok(())
    }

    /// How long until the next frame of the hand is due; long, while there is none.
    pub fn frame_due_in(&self) -> Duration {
        if self.pointed.is_some() { self.frame.due_in() } else { POINTED_WITHIN }
    }

    /// Shows the hand to the tracker, when a frame is due and somebody points.
    pub fn show_hand(&mut self, task: &Task, seen: &Seen, cycle: u64) -> Result<(), PortError> {
        let Some(hands) = &mut self.hands else { return Ok(()) };
        let Some((pointer, _)) = self.pointed.filter(|(_, when)| when.elapsed() < POINTED_WITHIN) else {
            return Ok(());
        };
        if !self.frame.is_due() {
            return Ok(());
        }
        // A hand that was not shown for a while stood.
        let step = self.shown.elapsed().min(2 * FRAME).as_secs_f64();
        self.shown = Instant::now();
        self.around.look(task, seen);
        let points = self.hand.step(&pointer, &self.around, step);
        let mut message = hands.loan()?;
        message.position = points.map(|point| point.to_array());
        message.send(cycle, now())?;
        Ok(())
    }
}
