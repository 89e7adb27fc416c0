use coact_joint_task::{Agent, Task};
use coact_messages::SensorSample;

/// Angle on the table between the part of `kind` that a reach from `hand` is for and the nearest part of another kind in the person's
/// workspace, as seen from there, degrees; none where no such part, or no other one, is seen. Of several parts of the kind, the one
/// nearest to others counts: which of them is meant makes no difference to the goal.
pub(crate) fn nearest_angle(task: &Task, sample: &SensorSample, kind: usize, hand: [f64; 3]) -> Option<f64> {
    let [low, high] = task.scene.workspace[Agent::Person.index()];
    let lies_there = |at: [f64; 3]| (0..2).all(|axis| (low[axis]..=high[axis]).contains(&at[axis]));
    let direction = |at: [f64; 3]| (at[1] - hand[1]).atan2(at[0] - hand[0]);
    let there = || sample.scene.sightings().iter().filter(|part| lies_there(part.position));
    let is_own = |part: &&coact_messages::Sighting| part.kind as usize == kind;
    let others = || there().filter(|part| !is_own(part)).map(|part| direction(part.position));
    let apart = |own: f64| others().map(move |other| between(own, other)).min_by(f64::total_cmp);
    let angles = there().filter(is_own).filter_map(|part| apart(direction(part.position)));
    angles.min_by(f64::total_cmp).map(f64::to_degrees)
}

/// Angle between two directions, rad, 0 to pi.
fn between(one: f64, other: f64) -> f64 {
    let turn = (one - other).rem_euclid(std::f64::consts::TAU);
    turn.min(std::f64::consts::TAU - turn)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_angle_between_directions_has_no_seam() {
        let degrees = |one: f64, other: f64| between(one.to_radians(), other.to_radians()).to_degrees();
        for (one, other, expected) in
            [(10.0, 30.0, 20.0), (-170.0, 170.0, 20.0), (0.0, 180.0, 180.0), (5.0, 5.0, 0.0)]
        {
            assert!((degrees(one, other) - expected).abs() < 1e-9, "{one} {other}");
        }
    }
}
