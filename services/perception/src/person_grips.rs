use crate::grip_resemblance::{UsualGrip, grip_resemblance};
use crate::habit::next_value;
use bytemuck::{Pod, Zeroable};
use coact_joint_task::PersonGrip;
use coact_messages::MAX_GRIPS;
use coact_stage_state::{Implausible, ensure};

/// How much people differ from each other in how they hold the hand in a grip, and one person from grasp to grasp, rad: standard
/// deviations. Chosen by hand, alike: together a quarter of what lies between a grip from above (-75 degrees) and one from the side (-10 degrees).
const BETWEEN: f64 = 0.2125;
const WITHIN: f64 = 0.2125;
/// Resemblance from which on a grasp counts as one of that grip. Chosen by hand: what may be either teaches nothing.
const PLAIN: f64 = 0.8;

/// How this person holds the hand in each grip, as the grasps so far have told.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct PersonGrips {
    /// How many grasps, by grip.
    grasps: [u16; MAX_GRIPS],
    /// Sum of their pitches beyond what the task says of the grip, rad.
    beyond: [f32; MAX_GRIPS],
}

impl PersonGrips {
    /// How this person's next grasp with each of `grips` will be: a mean that differs between people, about which one person varies. What
    /// is none of them is never looked at.
    pub fn usual(&self, grips: &[PersonGrip]) -> [UsualGrip; MAX_GRIPS] {
        let (between, within) = (BETWEEN * BETWEEN, WITHIN * WITHIN);
        std::array::from_fn(|index| {
            let Some(grip) = grips.get(index) else { return UsualGrip { pitch: 0.0, deviation: 1.0 } };
            let (grasps, beyond) = (f64::from(self.grasps[index]), f64::from(self.beyond[index]));
            let (beyond, deviation) = next_value(grasps, beyond, between, within);
            UsualGrip { pitch: grip.pitch + beyond, deviation }
        })
    }

    /// Learns from a grasp with this pitch, rad, if it is plain with which of `grips` it was.
    pub fn learn(&mut self, grips: &[PersonGrip], pitch: f64) {
        let usual = &self.usual(grips)[..grips.len().min(MAX_GRIPS)];
        let plain = (0..usual.len())
            .filter(|_| usual.len() > 1)
            .find(|index| grip_resemblance(usual, *index, Some(pitch), 1.0) > PLAIN);
        // So many tell nothing new any more.
        if let Some(index) = plain.filter(|index| self.grasps[*index] < u16::MAX) {
            self.grasps[index] += 1;
            self.beyond[index] += (pitch - grips[index].pitch) as f32;
        }
    }

    /// Refuses what is none.
    pub fn check(&self) -> Result<(), Implausible> {
        ensure(self.beyond.iter().all(|sum| sum.is_finite()), "grips.beyond", "finite numbers")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grips() -> Vec<PersonGrip> {
        let grip = |name: &str, degrees: f64| PersonGrip { name: name.into(), pitch: degrees.to_radians() };
        vec![grip("above", -75.0), grip("side", -10.0)]
    }

    fn resemblance(person: &PersonGrips, degrees: f64) -> [f64; 2] {
        let usual = person.usual(&grips());
        [0, 1].map(|grip| grip_resemblance(&usual[..2], grip, Some(degrees.to_radians()), 1.0))
    }

    #[test]
    fn a_person_who_holds_the_hand_otherwise_is_read_better_with_every_grasp() {
        let mut person = PersonGrips::zeroed();
        let [_, before] = resemblance(&person, -33.0);
        for _ in 0..10 {
            person.learn(&grips(), (-30.0_f64).to_radians());
            person.learn(&grips(), (-80.0_f64).to_radians());
        }
        let [above, after] = resemblance(&person, -33.0);
        assert!(before < 0.9 && after > 0.95 && above == 0.0, "{before} {after} {above}");
    }

    #[test]
    fn a_grasp_that_may_be_either_teaches_nothing() {
        let mut person = PersonGrips::zeroed();
        person.learn(&grips(), (-42.0_f64).to_radians());
        person.learn(&grips()[..1], (-10.0_f64).to_radians());
        assert_eq!(bytemuck::bytes_of(&person), bytemuck::bytes_of(&PersonGrips::zeroed()));
    }
}
