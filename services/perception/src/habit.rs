/// Mean and standard deviation of a person's next value, after so many with this sum: a Gaussian mean that varies `between` people, about which
/// each value varies `within` one; both are variances.
pub(crate) fn next_value(values: f64, sum: f64, between: f64, within: f64) -> (f64, f64) {
    let known = values * between + within;
    (sum * between / known, (within + between * within / known).sqrt())
}
