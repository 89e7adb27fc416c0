/// A memory of where peaks have stood: it follows a field's output while there is some, and fades where there is none (G. Schöner, J.
/// Spencer, Dynamic Thinking, 2016, chapter 3).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MemoryTrace {
    /// Time in which it follows, in the unit of the step.
    pub build: f64,
    /// Time in which it fades.
    pub decay: f64,
}

impl MemoryTrace {
    /// Goes on by `dt`: dp/dt = f (f - p) / build - (1 - f) p / decay, exactly for an `output` f that stays the same meanwhile, whatever
    /// the length of the step.
    pub fn step(&self, dt: f64, output: &[f64], trace: &mut [f64]) {
        for (trace, &f) in trace.iter_mut().zip(output) {
            let rate = f / self.build + (1.0 - f) / self.decay;
            let end = f * f / self.build / rate;
            *trace = end + (*trace - end) * (-rate * dt).exp();
        }
    }
}
