use crate::evidence::beyond_chance;

/// How a person holds the hand in a grip: the hand's pitch against the table plane, and by how much it varies, rad.
#[derive(Debug, Clone, Copy)]
pub(crate) struct UsualGrip {
    pub pitch: f64,
    pub deviation: f64,
}

impl UsualGrip {
    /// Logarithm of how likely a hand with this pitch is in this grip, up to what is the same for all.
    fn likelihood(&self, pitch: f64) -> f64 {
        -0.5 * ((pitch - self.pitch) / self.deviation).powi(2) - self.deviation.ln()
    }
}

/// How much a hand with `pitch` looks like grip `index` rather than the others, in [0, 1]. `trust` in [0, 1] is how
/// much the pitch tells already: with none, nothing speaks for any grip. A task with one grip, or a hand whose pitch
/// cannot be seen, leaves nothing to tell apart.
pub(crate) fn grip_resemblance(grips: &[UsualGrip], index: usize, pitch: Option<f64>, trust: f64) -> f64 {
    let Some(pitch) = pitch.filter(|_| grips.len() > 1) else { return 1.0 };
    let likeliest = grips.iter().map(|grip| grip.likelihood(pitch)).fold(f64::NEG_INFINITY, f64::max);
    let likeness = |grip: &UsualGrip| (trust * (grip.likelihood(pitch) - likeliest)).exp();
    let sum: f64 = grips.iter().map(likeness).sum();
    beyond_chance(likeness(&grips[index]) / sum, grips.len())
}
