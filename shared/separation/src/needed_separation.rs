/// Time from what a camera sees to the joints' answer, s: a frame of 60 Hz is one frame time old when it comes, and the newest one
/// for one more; two cycles of the pipeline.
const REACTION: f64 = 0.035;
/// Deceleration of the hand, m/s²: it stands 0.1 s after 1 m/s, as the shipped arm does (`most_acceleration` in its robot file).
const DECELERATION: f64 = 10.0;
/// What the tracker's scatter and the arm's servos are given, m: half of the shipped protective separation.
const UNCERTAINTY: f64 = 0.02;

/// Distance that ISO/TS 15066 asks for (5.5.4, S_p) between a link that closes on a limb by its own motion, and a limb that comes nearer
/// by its own, m/s: the way of both until the robot has reacted and stands, and the uncertainty.
pub(crate) fn needed_separation(closing: f64, coming: f64) -> f64 {
    let stops_in = closing / DECELERATION;
    coming * (REACTION + stops_in) + closing * (REACTION + 0.5 * stops_in) + UNCERTAINTY
}

#[cfg(test)]
mod tests {
    use super::needed_separation;

    #[test]
    fn it_is_the_way_of_both_until_the_robot_stands() {
        for (closing, coming, needed) in [
            (0.0, 0.0, 0.02),
            (1.0, 0.0, 0.02 + 0.035 + 0.05),
            (0.5, 0.0, 0.02 + 0.0175 + 0.0125),
            (0.5, 1.6, 0.02 + 0.0175 + 0.0125 + 1.6 * 0.085),
        ] {
            assert!((needed_separation(closing, coming) - needed).abs() < 1e-12, "{closing} {coming}");
        }
    }
}
