use bytemuck::{Pod, Zeroable};
use coact_messages::{Flaw, Header, Percept, Plausible};
use iceoryx2::prelude::ZeroCopySend;

/// How fast the person's hand moves, smoothed (1 kHz).
///
/// A message is plain memory that begins with a [`Header`]: `repr(C)`, without pointers and padding. Its type name is
/// what programs in other languages state to read it.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Pod, Zeroable, ZeroCopySend)]
#[type_name("example::HandSpeed")]
pub struct HandSpeed {
    /// Header; the port that sends the message fills it.
    pub header: Header,
    /// Speed now, m/s.
    pub now: f64,
    /// Highest speed of the present reach, or of the last one, m/s.
    pub highest: f64,
    /// Reaches so far.
    pub reaches: u64,
    /// 1 while the person reaches, else 0.
    pub reaching: u64,
}

/// Fraction by which the smoothed speed follows in one cycle: a time constant of 20 cycles, shorter than a reach and longer
/// than the tracker's noise.
const FOLLOWS: f64 = 0.05;

/// No hand is faster, m/s: those of athletes who throw reach some 30.
const FASTEST: f64 = 100.0;

impl HandSpeed {
    /// Topic of the process `stage_as_process`.
    pub const TOPIC: &str = "example/hand-speed";

    /// The stage: one period, from the message of the period before into this one, which may hold anything.
    pub fn step(&mut self, percept: Option<&Percept>, previous: &Self) {
        let Some(percept) = percept.filter(|percept| percept.acting_arm().is_tracked()) else {
            // Nothing is seen of the hand: what is known of it stays.
            return *self = *previous;
        };
        let (arm, hand) = (percept.acting_arm(), percept.hand);
        let measured = arm.wrist.velocity.iter().map(|velocity| velocity * velocity).sum::<f64>().sqrt();
        let begins = hand.reaching == 1 && previous.reaching == 0;
        self.now = previous.now + FOLLOWS * (measured - previous.now);
        self.highest = if begins { self.now } else { previous.highest };
        if hand.reaching == 1 {
            self.highest = self.highest.max(self.now);
        }
        self.reaches = previous.reaches + u64::from(begins);
        self.reaching = u64::from(hand.reaching);
    }
}

impl Plausible for HandSpeed {
    /// Readers take in no message that holds what no hand does.
    fn check(&self) -> Result<(), Flaw> {
        let fast = |speed: f64| (0.0..FASTEST).contains(&speed);
        if fast(self.now) && fast(self.highest) {
            return Ok(());
        }
        Err(Flaw { field: "now, highest", expected: "speeds of a hand" })
    }
}

coact_realtime::message!(HandSpeed);
