//! The sigmoid of a field, written so that a compiler can do several sites at once.

/// Exponents beyond this are cut: 1/(1+e^40) is 4e-18, far below what one sum of outputs can resolve, and no
/// denormal number ever enters a field at rest.
const LARGEST_EXPONENT: f64 = 40.0;

/// f(u) = 1 / (1 + exp(-beta (u - u0))) (chapter, eq. 3).
#[inline(always)]
pub fn sigmoid(u: f64, slope: f64, threshold: f64) -> f64 {
    1.0 / (1.0 + exp((-slope * (u - threshold)).clamp(-LARGEST_EXPONENT, LARGEST_EXPONENT)))
}

/// e^x for |x| <= 40, to two units in the last place.
///
/// The standard library's `exp` is a call for each site; this is a dozen multiplications that vectorise, which
/// halves the step of a whole network. x = k ln 2 + r with |r| <= ln 2 / 2, e^r by its series, 2^k by its bits.
#[inline(always)]
fn exp(x: f64) -> f64 {
    // Adding 1.5 * 2^52 leaves the nearest integer in the low bits of the mantissa.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    // ln 2 in two parts: the first has zeros at its end, so that k * LN2_HIGH is exact.
    const LN2_HIGH: f64 = 6.931_471_803_691_238e-1;
    const LN2_LOW: f64 = 1.908_214_929_270_587_7e-10;
    let shifted = x * std::f64::consts::LOG2_E + ROUND;
    let k = shifted - ROUND;
    let r = (x - k * LN2_HIGH) - k * LN2_LOW;
    let mut series = 1.0 / 6_227_020_800.0;
    for factor in [
        1.0 / 479_001_600.0,
        1.0 / 39_916_800.0,
        1.0 / 3_628_800.0,
        1.0 / 362_880.0,
        1.0 / 40_320.0,
        1.0 / 5_040.0,
        1.0 / 720.0,
        1.0 / 120.0,
        1.0 / 24.0,
        1.0 / 6.0,
        0.5,
        1.0,
        1.0,
    ] {
        series = series * r + factor;
    }
    let power = f64::from_bits(shifted.to_bits().wrapping_add(1023) << 52);
    series * power
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponential_agrees_with_the_standard_library() {
        for step in -40_000..=40_000 {
            let x = f64::from(step) / 1000.0;
            let relative = (exp(x) - x.exp()).abs() / x.exp();
            assert!(relative < 5e-16, "exp({x}) is off by {relative:e}");
        }
    }

    #[test]
    fn sigmoid_is_half_at_threshold_and_bounded_everywhere() {
        assert_eq!(sigmoid(0.3, 5.0, 0.3), 0.5);
        for u in [f64::MIN, -1e3, 1e3, f64::MAX] {
            assert!((0.0..=1.0).contains(&sigmoid(u, 5.0, 0.0)), "f({u})");
        }
    }
}
