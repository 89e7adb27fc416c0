use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_person::RobotHandView;
use coact_stage_state::{Flag, Implausible, Slot, ensure, finite};
use glam::DQuat;

/// What the robot's hand has, and since when it has stood where the person pays attention to it (ticks of the run; 0: it
/// does not).
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
pub(crate) struct RobotHandState {
    /// The part that it holds.
    pub held: Slot,
    /// Position of the held part in the palm frame, m.
    pub offset: [f64; 3],
    /// Its orientation there.
    pub turn: [f64; 4],
    /// Finger closure at the last step, rad.
    pub finger_closure: f64,
    /// Open and empty at the place where parts change hands.
    pub requesting_since: u64,
    /// With a part that was brought to that place.
    pub giving_since: u64,
    /// At the place where the base is steadied.
    pub steadying_since: u64,
    /// Set once the held part has been away from the place where parts change hands: not received there just now.
    pub brought: Flag,
    /// Where the palm was when it took the held part.
    pub taken_at: [f64; 3],
    /// Cycles for which it has been carried, away from there.
    pub carried: u64,
    /// Cycles for which the measured grip has said that a part is grasped, or that the held one is lost.
    pub changing: u64,
    /// The part that has slipped out of fingers that are still closed.
    pub slipped: Slot,
    /// The part in the person's hand that is between the open fingers.
    pub receiving: Slot,
    /// Finger closure that the drive's setpoints have, rad.
    pub commanded_closure: f64,
    /// The largest one commanded since the fingers have held a part, rad.
    pub tightest: f64,
}

impl RobotHandState {
    /// Refuses what no hand can have come to among `parts` parts up to tick `now`.
    pub fn check(&self, parts: usize, now: u64) -> Result<(), Implausible> {
        let own = [self.held, self.slipped, self.receiving];
        ensure(own.iter().all(|part| part.is_below(parts)), "robot: part", "one that there is")?;
        let since = [self.requesting_since, self.giving_since, self.steadying_since];
        ensure(since.iter().all(|tick| *tick <= now.max(1)), "robot: tick", "one that has been")?;
        let counts = [self.carried, self.changing];
        ensure(
            counts.iter().all(|count| *count <= now.saturating_add(1)),
            "robot: count",
            "no more than the ticks so far",
        )?;
        finite("robot: grip", &[self.offset, self.taken_at].concat())?;
        let turn = DQuat::from_array(self.turn);
        let is_turn = turn.is_finite() && (turn.is_normalized() || self.held == Slot::EMPTY);
        ensure(is_turn, "robot.turn", "a unit quaternion")?;
        finite("robot: fingers", &[self.finger_closure, self.commanded_closure, self.tightest])
    }

    /// What the person sees and feels of the hand.
    pub fn view(&self) -> RobotHandView {
        RobotHandView {
            held: self.held.get(),
            requesting_since: self.requesting_since,
            giving_since: self.giving_since,
            steadying_since: self.steadying_since,
            receiving: self.receiving.get(),
        }
    }
}
