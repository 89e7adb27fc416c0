use crate::evidence::beyond_chance;
use coact_joint_task::PersonGrip;

/// Scatter of the hand's pitch about that of a grip, rad. Chosen by hand: a quarter of what lies between a grip from above
/// (-75 degrees) and one from the side (-10 degrees).
const SCATTER: f64 = 0.30;

/// How much a hand with `pitch` looks like grip `index` rather than the others, in [0, 1]. `trust` in [0, 1] is how
/// much the pitch tells already: with none, nothing speaks for any grip. A task with one grip, or a hand whose pitch
/// cannot be seen, leaves nothing to tell apart.
pub(crate) fn grip_resemblance(grips: &[PersonGrip], index: usize, pitch: Option<f64>, trust: f64) -> f64 {
    let Some(pitch) = pitch.filter(|_| grips.len() > 1) else { return 1.0 };
    let likeness = |grip: &PersonGrip| (-0.5 * trust * ((pitch - grip.pitch) / SCATTER).powi(2)).exp();
    let nearest = grips.iter().map(|grip| (pitch - grip.pitch).abs()).fold(f64::INFINITY, f64::min);
    let scale = (0.5 * trust * (nearest / SCATTER).powi(2)).exp();
    let sum: f64 = grips.iter().map(|grip| likeness(grip) * scale).sum();
    beyond_chance(likeness(&grips[index]) * scale / sum, grips.len())
}
