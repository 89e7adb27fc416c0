use bytemuck::{Pod, Zeroable};
use coact_period::cycles;
use coact_stage_state::{Implausible, ensure};
use std::time::Duration;

/// Time in which a hand that hesitates comes to a stand, and in which it sets out again, cycles. Chosen by hand: a hand at 1 m/s then
/// brakes with at most 10 m/s², half of what a reach itself takes.
const BRAKING: u64 = cycles(Duration::from_millis(150));
/// No hand stands longer in mid-reach, cycles.
const LONGEST: u64 = cycles(Duration::from_secs(60));

/// How the hand stops in mid-reach and goes on, if it does: the movement's own time slows down, stands, and runs on.
#[repr(C)]
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Pod, Zeroable)]
pub struct Hesitation {
    /// Tick at which the hand began to brake; 0: it has not hesitated in the present reach.
    pub begun: u64,
    /// For how long it stands still, cycles.
    pub(crate) stands: u64,
}

impl Hesitation {
    /// How far the movement's own time still goes once the hand brakes, cycles.
    pub(crate) const STOPPING: u64 = BRAKING / 2;

    /// By how much later the movement ends, cycles.
    pub(crate) fn delay(&self) -> u64 {
        if self.begun > 0 { BRAKING + self.stands } else { 0 }
    }

    /// The own time of a movement that has been put off by [`delay`](Self::delay), cycles: at first ahead of `tick` by that, in the end the
    /// tick's own.
    pub(crate) fn time(&self, tick: u64) -> f64 {
        let (since, delay) = (tick as f64 - self.begun as f64, self.delay() as f64);
        tick as f64 + delay - (braked(since) - braked(since - delay))
    }

    /// Refuses what cannot be at tick `now`.
    pub(crate) fn check(&self, now: u64) -> Result<(), Implausible> {
        let can_be = self.begun <= now.max(1) && self.stands <= LONGEST;
        ensure(can_be, "person.hesitation", "a tick that has been, and a time in which a reach can stand")
    }
}

/// What a movement's own time has lost that began to brake `since` and then stands, cycles. Its rate falls as a smooth step, so that
/// velocity and acceleration have none.
fn braked(since: f64) -> f64 {
    let braking = BRAKING as f64;
    let along = (since / braking).clamp(0.0, 1.0);
    braking * along.powi(3) * (1.0 - 0.5 * along) + (since - braking).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn movement_goes_on_from_where_it_was_and_loses_just_the_delay() {
        let hesitation = Hesitation { begun: 1000, stands: 500 };
        assert_eq!(hesitation.time(1000), 1000.0 + hesitation.delay() as f64);
        let stood: Vec<f64> = (1150..=1650).map(|tick| hesitation.time(tick)).collect();
        assert!(stood.iter().all(|time| (time - stood[0]).abs() < 1e-9), "it stands");
        assert_eq!(stood[0], 1000.0 + (hesitation.delay() + Hesitation::STOPPING) as f64);
        for tick in 1800..1900 {
            assert_eq!(hesitation.time(tick), tick as f64);
        }
        let steps: Vec<f64> =
            (900..2000).map(|tick| hesitation.time(tick + 1) - hesitation.time(tick)).collect();
        assert!(steps.windows(2).all(|pair| (pair[1] - pair[0]).abs() < 0.011), "its rate has no step");
        assert!(steps.iter().all(|step| (-1e-9..1.0 + 1e-9).contains(step)), "it never goes back");
    }

    #[test]
    fn reach_without_one_has_the_time_of_the_run() {
        assert_eq!(Hesitation::default().time(1234), 1234.0);
    }
}
