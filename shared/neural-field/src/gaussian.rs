/// One Gaussian of an interaction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gaussian<const D: usize> {
    /// Its amplitude; below 0 it inhibits.
    pub amplitude: f64,
    /// Its standard deviation along each axis, in the axis's unit. It is cut off at five of them.
    pub sigma: [f64; D],
}
