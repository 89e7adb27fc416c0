//! Where on a part the hand takes it, and how the palm stands then.

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

/// Height above a part's underside at which it is gripped, m, for a part `height` m high: half-way up, but never
/// more than 35 mm below its top, so that the palm stays clear of a tall part, and higher on a low one, so that the
/// fingers stay clear of what it stands on.
///
/// Not so high, though, that they press near its upper edge: a nut of 20 mm slips when it is held at 15.
pub fn grip_height(height: f64) -> f64 {
    let clear_of_the_ground = (0.6 * height).clamp(0.012, 0.015).min(0.75 * height);
    (0.5 * height).max(height - 0.035).max(clear_of_the_ground)
}

/// Frame at `point` with z along `approach` and x as near to `closing_axis` as the approach allows, turned by `roll` rad
/// about z. A `closing_axis` along the approach is replaced by another direction across it.
pub fn frame(
    point: &Point3<f64>,
    approach: &Vector3<f64>,
    closing_axis: &Vector3<f64>,
    roll: f64,
) -> Isometry3<f64> {
    let z = approach.normalize();
    let across = |direction: &Vector3<f64>| (direction - z * direction.dot(&z)).try_normalize(1e-6);
    let least = if z.x.abs() < 0.7 { Vector3::x() } else { Vector3::y() };
    let x = across(closing_axis).or_else(|| across(&least)).unwrap_or_else(Vector3::x);
    let basis = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[x, z.cross(&x), z]));
    let turned = basis * Rotation3::from_axis_angle(&Vector3::z_axis(), roll);
    Isometry3::from_parts(Translation3::from(point.coords), UnitQuaternion::from_rotation_matrix(&turned))
}
