/// Evidence from which a part counts as held by the person: the middle.
pub(crate) const HELD: f64 = 0.5;

/// Moves `value` one cycle towards 1 or 0, as `holds` says, at the rate that takes `cycles` from end to end.
pub(crate) fn approach(value: &mut f64, holds: bool, cycles: f64) {
    follow(value, if holds { 1.0 } else { 0.0 }, cycles);
}

/// Moves `value` one cycle towards `target`, at most at the rate that takes `cycles` from 0 to 1.
pub(crate) fn follow(value: &mut f64, target: f64, cycles: f64) {
    let step = 1.0 / cycles.max(1.0);
    *value += (target - *value).clamp(-step, step);
}

/// 0 at `low`, 1 at `high`, smooth in between; `low` may lie above `high`.
pub(crate) fn smooth_step(value: f64, low: f64, high: f64) -> f64 {
    let x = ((value - low) / (high - low)).clamp(0.0, 1.0);
    x * x * (3.0 - 2.0 * x)
}

/// By how much one of `possible` alternatives, which has this `fraction` of all probability, is more than mere chance, in
/// [0, 1]: 0 when nothing speaks for it.
pub(crate) fn beyond_chance(fraction: f64, possible: usize) -> f64 {
    if possible < 2 {
        return fraction;
    }
    let chance = 1.0 / possible as f64;
    ((fraction - chance) / (1.0 - chance)).max(0.0)
}
