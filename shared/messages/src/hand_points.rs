use crate::plausible::{bounded, ensure};
use crate::{Flaw, Header, KeypointName, Plausible};
use bytemuck::{Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;
use std::time::Duration;

/// Where a person's arm and hand are, told by a program outside the set at about 60 Hz. Nothing but this is told: neither part nor
/// grip nor intention.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
#[type_name("coact::HandPoints")]
pub struct HandPoints {
    /// Header; `cycle` is the one in which the hand was there.
    pub header: Header,
    /// Positions in the order of [`KeypointName`], m, world frame.
    pub position: [[f64; 3]; 9],
}

impl HandPoints {
    /// For how long the hand counts as being where it was told to be last. Chosen by hand, a trade-off: six frames of a camera of 60 Hz,
    /// three of 30 Hz, so that who is held up for some frames is bridged; and for no longer is a hand taken to stand still of which
    /// nobody tells any more.
    pub const LIFETIME: Duration = Duration::from_millis(100);
    /// How often it may be told, Hz: as often as a hand that follows a pointer goes on, and some. What comes faster is ignored. Chosen by
    /// hand.
    pub const FASTEST: u64 = 500;
}

/// Nothing in reach of the table is farther from the world's origin, m. Chosen by hand.
const FARTHEST: f64 = 5.0;

/// Two keypoints, and between what lengths their distance can be, m.
type Link = (KeypointName, KeypointName, f64, f64);
/// The links of arms and hands. Chosen by hand, from a child's to well beyond a tall adult's (Winter 2009: upper arm 0.31, forearm
/// 0.26, wrist to finger tips 0.19 for 1.70 m), for what a camera tells is some centimetres off; a tip may be bent to the palm.
const LINKS: [Link; 8] = [
    (KeypointName::Shoulder, KeypointName::Elbow, 0.12, 0.50),
    (KeypointName::Elbow, KeypointName::Wrist, 0.12, 0.50),
    (KeypointName::Wrist, KeypointName::PalmBase, 0.002, 0.12),
    (KeypointName::Wrist, KeypointName::IndexKnuckle, 0.03, 0.20),
    (KeypointName::Wrist, KeypointName::LittleKnuckle, 0.03, 0.20),
    (KeypointName::Wrist, KeypointName::ThumbTip, 0.02, 0.25),
    (KeypointName::Wrist, KeypointName::IndexTip, 0.02, 0.30),
    (KeypointName::Wrist, KeypointName::MiddleTip, 0.02, 0.30),
];

impl Plausible for HandPoints {
    fn check(&self) -> Result<(), Flaw> {
        bounded("position", self.position.as_flattened(), FARTHEST)?;
        let length = |one: KeypointName, other: KeypointName| {
            let (one, other) = (self.position[one as usize], self.position[other as usize]);
            (0..3).map(|axis| (one[axis] - other[axis]).powi(2)).sum::<f64>().sqrt()
        };
        let are = LINKS.iter().all(|&(one, other, least, most)| (least..=most).contains(&length(one, other)));
        ensure(are, "position", "an arm and a hand: links as long as a person's, in m")
    }
}
