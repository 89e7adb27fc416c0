use crate::hand_phase::HandPhase;
use crate::keyframes::Keyframes;
use coact_recordings::WayKind;
use std::ops::Range;
use std::path::Path;

/// For so many frames before it is shown, what is given is held out, 1.5 s: before, the person walks up with it.
const SHOWING: usize = 150;

/// What was done in a recording, as its folder is called: so it is known what its keyframes divide.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RecordedTask {
    /// Two build a stack in turn: the person comes, puts down the first part with one hand, waits, puts the third one on top
    /// with the other hand, waits, and leaves.
    CollaborativeStacking,
    /// The person comes, holds something out until it is taken, and leaves.
    HumanRobotHandover,
    /// The person comes, holds the hand out until something is in it, and leaves with it.
    RobotHumanHandover,
}

impl RecordedTask {
    /// That of a recording; none of a folder whose hands carry nothing that the recorders tell of.
    pub fn of(recording: &Path) -> Option<Self> {
        match recording.parent()?.file_name()?.to_str()? {
            "CollaborativeStacking" => Some(Self::CollaborativeStacking),
            "HumanRobotHandover" => Some(Self::HumanRobotHandover),
            "RobotHumanHandover" => Some(Self::RobotHumanHandover),
            _ => None,
        }
    }

    /// What hands do when, in a recording of so many frames.
    pub(crate) fn phases(self, keyframes: &Keyframes, frames: usize) -> Result<Vec<HandPhase>, String> {
        let hand = keyframes
            .hand()
            .ok_or("expected first_placing_hand or object_holding_hand, left or right; found none")?;
        let phase = |hand, kind, frames: Range<usize>| HandPhase { hand, kind, frames };
        match (self, keyframes.frames.as_slice()) {
            (Self::CollaborativeStacking, &[_, first, second, third, _]) => {
                let other = hand.other();
                Ok(vec![
                    phase(hand, WayKind::Carry, 0..first),
                    phase(hand, WayKind::Withdraw, first..second),
                    phase(other, WayKind::Carry, second..third),
                    phase(hand, WayKind::Withdraw, third..frames),
                    phase(other, WayKind::Withdraw, third..frames),
                ])
            }
            (Self::HumanRobotHandover, &[shown, taken]) => Ok(vec![
                phase(hand, WayKind::Give, shown.saturating_sub(SHOWING)..shown),
                phase(hand, WayKind::Withdraw, taken..frames),
            ]),
            (Self::RobotHumanHandover, &[_, taken]) => Ok(vec![phase(hand, WayKind::Carry, taken..frames)]),
            (task, found) => {
                let expected = if task == Self::CollaborativeStacking { 5 } else { 2 };
                Err(format!("keyframes: expected {expected} frames, found {}", found.len()))
            }
        }
    }
}
