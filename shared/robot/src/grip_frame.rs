use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

/// Largest distance of the grip below a part's top, m: in a grip from above the palm stays clear of a tall part.
/// Chosen by hand for fingers of this length.
const BELOW_TOP: f64 = 0.035;
/// Height of the grip on low parts, m: the fingers stay clear of what the part stands on. From 12 mm, because a nut of
/// 20 mm that was held at 15 mm slipped out of four of twenty grasps in the physics world; up to 15 mm.
const LOW_GRIP: [f64; 2] = [0.012, 0.015];
/// Fraction of a low part's height at which it is gripped within [`LOW_GRIP`], and the largest on very low ones: the fingers
/// do not press near the upper edge. Chosen by hand.
const LOW_FRACTION: f64 = 0.6;
const LARGEST_FRACTION: f64 = 0.75;
/// Length below which a direction across the approach is not computed from another one.
const PARALLEL: f64 = 1e-6;

/// Height above a part's underside at which it is gripped, m, for a part `height` m high: half-way up, but not too far
/// below the top of a tall part, and higher on a low one.
pub fn grip_height(height: f64) -> f64 {
    let [lowest, highest] = LOW_GRIP;
    let clear_of_the_ground = (LOW_FRACTION * height).clamp(lowest, highest).min(LARGEST_FRACTION * height);
    (0.5 * height).max(height - BELOW_TOP).max(clear_of_the_ground)
}

/// Frame at `point` with z along `approach` and x as near to `closing_axis` as the approach allows, turned by `roll` rad
/// about z. A `closing_axis` along the approach is replaced by another direction across it.
pub fn grip_frame(
    point: &Point3<f64>,
    approach: &Vector3<f64>,
    closing_axis: &Vector3<f64>,
    roll: f64,
) -> Isometry3<f64> {
    let z = approach.normalize();
    let across = |direction: &Vector3<f64>| (direction - z * direction.dot(&z)).try_normalize(PARALLEL);
    let least = if z.x.abs() < 0.7 { Vector3::x() } else { Vector3::y() };
    let x = across(closing_axis).or_else(|| across(&least)).unwrap_or_else(Vector3::x);
    let basis = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, z.cross(&x), z]));
    let turned = basis * Rotation3::from_axis_angle(&Vector3::z_axis(), roll);
    Isometry3::from_parts(Translation3::from(point.coords), UnitQuaternion::from_rotation_matrix(&turned))
}
