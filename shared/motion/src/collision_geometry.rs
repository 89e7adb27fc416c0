//! The collision geometry of a URDF as links of a collision model.

use crate::Link;
use crate::{Capsule, Mechanism, Meshes, Solid, mesh_file};
use coact_robot::{HAND_JOINTS, Joint, RobotError, Urdf, isometry};
use nalgebra::{Isometry3, Point3, Vector3};
use std::path::{Path, PathBuf};

/// Largest turn of a finger joint from one shape of the hand that is checked to the next, rad. A trade-off with the time
/// of planning: the finger tip moves a few centimetres, of which the finger itself fills one or two.
const FINGER_STEP: f64 = 0.4;
/// Radius of a capsule that stands in for a finger's mesh, as a fraction of that for an arm link. Chosen by hand.
const FINGER_RADIUS: f64 = 1.0 / 6.0;
/// Fingers shorter than this are none, m.
const SHORTEST_FINGERS: f64 = 1e-3;

/// Distance of the farthest link of the fingers from the palm, with all as straight as they go, m.
pub(crate) fn finger_length(urdf: &Urdf, palm: &str, arm_joints: usize) -> Result<f64, RobotError> {
    let (_, tool) = urdf.chain(None, palm)?;
    let mut longest = 0.0f64;
    for link in urdf.links() {
        let (joints, tail) = urdf.chain(None, &link.name)?;
        if joints.len() > arm_joints {
            let straight = |joint: &Joint| 0.0f64.clamp(joint.limits.lower, joint.limits.upper);
            let chain = joints[arm_joints..].iter();
            let pose =
                chain.fold(tool.inverse(), |pose, joint| pose * joint.transform(straight(joint))) * tail;
            longest = longest.max(pose.translation.vector.norm());
        }
    }
    if longest < SHORTEST_FINGERS {
        return Err(urdf.fault(palm, "has no fingers of any length below it; expected a hand"));
    }
    Ok(longest)
}

/// The links that the arm's joints alone carry.
pub(crate) fn arm_links(mechanism: &Mechanism) -> Result<Vec<Link>, RobotError> {
    let mut links = Vec::new();
    for link in mechanism.urdf.links() {
        let (joints, tail) = mechanism.urdf.chain(None, &link.name)?;
        if joints.len() <= mechanism.joints() && is_along(mechanism, &joints) {
            push(mechanism, link, joints.len(), &tail, false, &mut links)?;
        }
    }
    Ok(links)
}

/// The links below the palm, with the fingers at these angles.
pub(crate) fn hand_links(
    mechanism: &Mechanism,
    angle: &dyn Fn(&str) -> f64,
) -> Result<Vec<Link>, RobotError> {
    let arm = mechanism.joints();
    let mut links = Vec::new();
    for link in mechanism.urdf.links() {
        let (joints, tail) = mechanism.urdf.chain(None, &link.name)?;
        if joints.len() > arm && is_along(mechanism, &joints[..arm]) {
            let turned = |joint: &Joint| {
                let angle = match mechanism.urdf.mimicked(&joint.name) {
                    Some((other, factor, offset)) => factor * angle(&other) + offset,
                    None => angle(&joint.name),
                };
                angle.clamp(joint.limits.lower, joint.limits.upper)
            };
            let chain = joints[arm..].iter();
            let place =
                chain.fold(Isometry3::identity(), |pose, joint| pose * joint.transform(turned(joint)));
            push(mechanism, link, arm, &(place * tail), true, &mut links)?;
        }
    }
    Ok(links)
}

/// A link below the palm: the joints from the palm to it, and its forms in the frame of the last of them.
pub(crate) struct FingerChain {
    pub joints: Vec<Joint>,
    pub links: Vec<Link>,
}

/// All links below the palm.
pub(crate) fn finger_chains(mechanism: &Mechanism) -> Result<Vec<FingerChain>, RobotError> {
    let arm = mechanism.joints();
    let mut chains = Vec::new();
    for link in mechanism.urdf.links() {
        let (joints, tail) = mechanism.urdf.chain(None, &link.name)?;
        if joints.len() > arm && is_along(mechanism, &joints[..arm]) {
            let mut links = Vec::new();
            push(mechanism, link, arm, &tail, true, &mut links)?;
            chains.push(FingerChain { joints: joints[arm..].to_vec(), links });
        }
    }
    Ok(chains)
}

/// These shapes of a hand, and those between them: so many that no joint turns by more than [`FINGER_STEP`] from one to the
/// next.
pub(crate) fn passed(shapes: &[[f64; HAND_JOINTS]]) -> Vec<[f64; HAND_JOINTS]> {
    let mut passed: Vec<_> = shapes.first().copied().into_iter().collect();
    for pair in shapes.windows(2) {
        let turn = |joint: usize| pair[1][joint] - pair[0][joint];
        let most = (0..HAND_JOINTS).map(|joint| turn(joint).abs()).fold(0.0, f64::max);
        let steps = (most / FINGER_STEP).ceil();
        passed.extend((1..=steps as u32).map(|step| -> [f64; HAND_JOINTS] {
            std::array::from_fn(|joint| pair[0][joint] + turn(joint) * f64::from(step) / steps)
        }));
    }
    passed
}

/// Whether these are the arm's own first joints.
fn is_along(mechanism: &Mechanism, joints: &[Joint]) -> bool {
    joints.iter().zip(&mechanism.arm.joints).all(|(one, own)| one.name == own.name)
}

fn push(
    mechanism: &Mechanism,
    link: &urdf_rs::Link,
    carriers: usize,
    place: &Isometry3<f64>,
    finger: bool,
    links: &mut Vec<Link>,
) -> Result<(), RobotError> {
    let hand = finger || carriers == mechanism.joints();
    for shape in &link.collision {
        let place = place * isometry(&shape.origin);
        check(mechanism, link, &shape.geometry, &place)?;
        let solid = match &shape.geometry {
            urdf_rs::Geometry::Box { size } => Some(Solid::Box(Vector3::from(size.0))),
            urdf_rs::Geometry::Cylinder { radius, length } => {
                Some(Solid::Cylinder { radius: *radius, height: *length })
            }
            urdf_rs::Geometry::Capsule { radius, length } => Some(straight(0.5 * length, *radius)),
            urdf_rs::Geometry::Sphere { radius } => Some(straight(0.0, *radius)),
            urdf_rs::Geometry::Mesh { filename, scale } => {
                let scale = scale.map_or(Vector3::repeat(1.0), |scale| Vector3::from(scale.0));
                mesh(mechanism, link, filename, scale, finger)?.map(Solid::Capsule)
            }
        };
        links.extend(solid.map(|solid| Link::new(&link.name, carriers, solid, place, hand)));
    }
    Ok(())
}

/// No form of a link is larger or farther away, m: far beyond any arm. With larger numbers the library for distances fails.
const LARGEST: f64 = 100.0;

/// Refuses a form of no size or of one that cannot be, and one that lies nowhere.
fn check(
    mechanism: &Mechanism,
    link: &urdf_rs::Link,
    form: &urdf_rs::Geometry,
    place: &Isometry3<f64>,
) -> Result<(), RobotError> {
    let is_size = |length: &f64| *length > 0.0 && *length <= LARGEST;
    let (size, expected) = match form {
        urdf_rs::Geometry::Box { size } => (size.0.to_vec(), "all sides"),
        urdf_rs::Geometry::Cylinder { radius, length } => (vec![*radius, *length], "radius and length"),
        urdf_rs::Geometry::Capsule { radius, length } => (vec![*radius, *length], "radius and length"),
        urdf_rs::Geometry::Sphere { radius } => (vec![*radius], "its radius"),
        // Its size is known when it is read.
        urdf_rs::Geometry::Mesh { .. } => (Vec::new(), ""),
    };
    if !size.iter().all(is_size) {
        let problem =
            format!("has a form of the size {size:?}; expected {expected} above 0 and up to {LARGEST} m");
        return Err(mechanism.urdf.fault(&link.name, &problem));
    }
    let is_near = place.translation.vector.iter().all(|length| length.abs() <= LARGEST);
    if !is_near || !place.rotation.coords.iter().all(|value| value.is_finite()) {
        let problem =
            format!("has a form that lies nowhere near; expected it within {LARGEST} m of the arm's base");
        return Err(mechanism.urdf.fault(&link.name, &problem));
    }
    Ok(())
}

fn straight(half: f64, radius: f64) -> Solid {
    let end = |sign: f64| Point3::new(0.0, 0.0, sign * half);
    Solid::Capsule(Capsule { start: end(-1.0), end: end(1.0), radius })
}

/// The bounding capsule of a mesh, or what stands in for it, in the frame of its geometry.
fn mesh(
    mechanism: &Mechanism,
    link: &urdf_rs::Link,
    filename: &str,
    scale: Vector3<f64>,
    finger: bool,
) -> Result<Option<Capsule>, RobotError> {
    let urdf = &mechanism.urdf;
    let file = locate(urdf.path_of(&link.name), filename);
    match (file, mechanism.meshes) {
        (Some(file), _) => {
            let scene = mesh_file::read(&file).map_err(|error| {
                urdf.fault(&link.name, &format!("has a mesh that cannot be read: {}: {error}", file.display()))
            })?;
            let vertices = scene.meshes.iter().flat_map(|mesh| &mesh.vertices);
            let points = vertices.map(|vertex| {
                Point3::from(Vector3::from(vertex.map(f64::from)).component_mul(&scale))
            });
            let points: Vec<_> = points.collect();
            // Written so that what is no number is refused as well.
            if !points.iter().flat_map(|point| point.iter()).all(|length| length.abs() <= LARGEST) {
                let problem = format!(
                    "has a mesh with a corner beyond {LARGEST} m or at none: {}; expected metres",
                    file.display()
                );
                return Err(urdf.fault(&link.name, &problem));
            }
            Ok(Capsule::around_points(&points))
        }
        (None, Meshes::Required) => Err(urdf.fault(
            &link.name,
            &format!(
                "needs the mesh \"{filename}\", which is not there; put it beside the URDF, or let capsules stand in \
                 for missing meshes (--missing-meshes capsules)"
            ),
        )),
        (None, Meshes::OrCapsules(radius)) => {
            let radius = if finger { FINGER_RADIUS * radius } else { radius };
            let next = urdf.model().joints.iter().find(|joint| joint.parent.link == link.name);
            let end = next.map_or_else(Isometry3::identity, |joint| isometry(&joint.origin));
            Ok(Some(Capsule { start: Point3::origin(), end: Point3::from(end.translation.vector), radius }))
        }
    }
}

/// The file that a mesh's name means: a path, or one within a package whose folder lies above the URDF or beside it.
fn locate(urdf: &Path, name: &str) -> Option<PathBuf> {
    let within = name.trim_start_matches("file://").trim_start_matches("package://");
    let bare = within.split_once('/').map_or(within, |(_, rest)| rest);
    let mut candidates = vec![PathBuf::from(within)];
    for folder in urdf.parent()?.ancestors() {
        candidates.push(folder.join(within));
        candidates.push(folder.join(bare));
    }
    candidates.into_iter().find(|candidate| candidate.is_file())
}
