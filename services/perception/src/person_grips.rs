use crate::evidence::beyond_chance;
use crate::habit::next_value;
use bytemuck::{Pod, Zeroable};
use coact_joint_task::PersonGrip;
use coact_messages::{Grips, MAX_GRIPS};
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
    /// Tells how well a hand with `pitch`, rad, fits each of `grips`; nothing where nothing tells them apart, for its pitch cannot be seen, or there is
    /// but one. `trust` in [0, 1] is how much the pitch tells already: with none, all fit alike.
    pub fn tell(&self, grips: &[PersonGrip], pitch: Option<f64>, trust: f64, out: &mut Grips) {
        out.count = 0;
        let Some(pitch) = pitch.filter(|_| grips.len() > 1) else { return };
        let count = grips.len().min(MAX_GRIPS);
        for index in 0..count {
            let usual = self.usual(grips, index);
            (out.pitch[index], out.fit[index]) = (usual.pitch, usual.likelihood(pitch));
        }
        let fit = &mut out.fit[..count];
        let likeliest = fit.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        fit.iter_mut().for_each(|fit| *fit = (trust * (*fit - likeliest)).exp());
        out.count = count as u32;
    }

    /// How this person's next grasp with one of `grips` will be: a mean that differs between people, about which one person varies.
    fn usual(&self, grips: &[PersonGrip], index: usize) -> UsualGrip {
        let (between, within) = (BETWEEN * BETWEEN, WITHIN * WITHIN);
        let (grasps, beyond) = (f64::from(self.grasps[index]), f64::from(self.beyond[index]));
        let (beyond, deviation) = next_value(grasps, beyond, between, within);
        UsualGrip { pitch: grips[index].pitch + beyond, deviation }
    }

    /// Learns from a grasp with this pitch, rad, if it is plain with which of `grips` it was.
    pub fn learn(&mut self, grips: &[PersonGrip], pitch: f64) {
        let mut told = Grips::zeroed();
        self.tell(grips, Some(pitch), 1.0, &mut told);
        let plain = told.iter().find(|(index, _, _)| resemblance(&told, *index) > PLAIN);
        // So many tell nothing new any more.
        if let Some((index, _, _)) = plain.filter(|(index, _, _)| self.grasps[*index] < u16::MAX) {
            self.grasps[index] += 1;
            self.beyond[index] += (pitch - grips[index].pitch) as f32;
        }
    }

    /// Refuses what is none.
    pub fn check(&self) -> Result<(), Implausible> {
        ensure(self.beyond.iter().all(|sum| sum.is_finite()), "grips.beyond", "finite numbers")
    }
}

/// By how much more than mere chance a hand looks like one of the grips, in [0, 1].
fn resemblance(told: &Grips, index: usize) -> f64 {
    let all: f64 = told.iter().map(|(_, _, fit)| fit).sum();
    beyond_chance(told.fit[index] / all, told.count as usize)
}

/// How a person holds the hand in a grip: the hand's pitch against the table plane, and by how much it varies, rad.
struct UsualGrip {
    pitch: f64,
    deviation: f64,
}

impl UsualGrip {
    /// Logarithm of how likely a hand with this pitch is in this grip, up to what is the same for all.
    fn likelihood(&self, pitch: f64) -> f64 {
        -0.5 * ((pitch - self.pitch) / self.deviation).powi(2) - self.deviation.ln()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grips() -> Vec<PersonGrip> {
        let grip = |name: &str, degrees: f64| PersonGrip { name: name.into(), pitch: degrees.to_radians() };
        vec![grip("above", -75.0), grip("side", -10.0)]
    }

    fn resemblances(person: &PersonGrips, degrees: f64) -> [f64; 2] {
        let mut told = Grips::zeroed();
        person.tell(&grips(), Some(degrees.to_radians()), 1.0, &mut told);
        [0, 1].map(|grip| resemblance(&told, grip))
    }

    #[test]
    fn a_person_who_holds_the_hand_otherwise_is_read_better_with_every_grasp() {
        let mut person = PersonGrips::zeroed();
        let [_, before] = resemblances(&person, -33.0);
        for _ in 0..10 {
            person.learn(&grips(), (-30.0_f64).to_radians());
            person.learn(&grips(), (-80.0_f64).to_radians());
        }
        let [above, after] = resemblances(&person, -33.0);
        assert!(before < 0.9 && after > 0.95 && above == 0.0, "{before} {after} {above}");
    }

    #[test]
    fn a_pitch_that_cannot_be_seen_and_a_single_grip_tell_nothing() {
        let mut told = Grips::zeroed();
        PersonGrips::zeroed().tell(&grips(), None, 1.0, &mut told);
        assert_eq!(told.count, 0);
        PersonGrips::zeroed().tell(&grips()[..1], Some(0.0), 1.0, &mut told);
        assert_eq!(told.count, 0);
        PersonGrips::zeroed().tell(&grips(), Some(0.0), 0.0, &mut told);
        assert_eq!((told.count, told.fit[..2].to_vec()), (2, vec![1.0, 1.0]));
    }

    #[test]
    fn a_grasp_that_may_be_either_teaches_nothing() {
        let mut person = PersonGrips::zeroed();
        person.learn(&grips(), (-42.0_f64).to_radians());
        person.learn(&grips()[..1], (-10.0_f64).to_radians());
        assert_eq!(bytemuck::bytes_of(&person), bytemuck::bytes_of(&PersonGrips::zeroed()));
    }
}
