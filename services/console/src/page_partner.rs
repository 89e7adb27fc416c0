use coact_console::{Pointer, PointerHand, Seen, Surroundings, Wish};
use coact_joint_task::Task;
use coact_messages::{HandPoints, Speech, topic};
use coact_pipeline::RunSettings;
use coact_realtime::{Output, PortError, Process, now};
use std::time::{Duration, Instant};

/// The hand goes on in steps of so long, and at once when the page has told of its pointer: a camera that looks between two of its
/// events, 16 ms apart, would see the hand of the last one.
const STEP: Duration = Duration::from_millis(3);
/// A hand that was not shown for longer has stood meanwhile.
const MOVES: Duration = Duration::from_millis(33);
/// A page that has not told of its pointer for so long is gone, and nobody sees the hand any more.
const POINTED_WITHIN: Duration = Duration::from_millis(250);

/// The person at a page: a hand and a voice.
pub struct PagePartner {
    hand: PointerHand,
    around: Surroundings,
    pointed: Option<(Pointer, Instant)>,
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
        let (hand, around) = (PointerHand::new(task), Surroundings::none());
        Ok(Self { hand, around, pointed: None, shown: Instant::now(), hands, speech })
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

    /// How long until the hand is to be shown; long, while nobody points.
    pub fn hand_due_in(&self) -> Duration {
        match self.pointed() {
            Some((_, told)) if told > self.shown => Duration::ZERO,
            Some(_) => STEP.saturating_sub(self.shown.elapsed()),
            None => POINTED_WITHIN,
        }
    }

    /// Where the page points, and when it told so, unless it is gone.
    fn pointed(&self) -> Option<(Pointer, Instant)> {
        self.pointed.filter(|(_, told)| told.elapsed() < POINTED_WITHIN)
    }

    /// Shows the hand to the tracker, when that is due and somebody points.
    pub fn show_hand(&mut self, task: &Task, seen: &Seen, cycle: u64) -> Result<(), PortError> {
        let pointed = self.pointed().filter(|_| self.hand_due_in().is_zero());
        let (Some(hands), Some((pointer, _))) = (&mut self.hands, pointed) else { return Ok(()) };
        let step = self.shown.elapsed().min(MOVES).as_secs_f64();
        self.shown = Instant::now();
        self.around.look(task, seen);
        let points = self.hand.step(&pointer, &self.around, step);
        let mut message = hands.loan()?;
        message.position = points.map(|point| point.to_array());
        message.send(cycle, now())?;
        Ok(())
    }
}
