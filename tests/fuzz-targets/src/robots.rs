//! Descriptions of robots: robot file, URDF, meshes.

use crate::configuration::{shipped, taken};
use crate::scratch::Scratch;
use coact_motion::{Mechanism, Meshes};
use coact_robot::{HAND_JOINTS, Robot, Urdf};
use std::cell::RefCell;
use std::collections::BTreeMap;

/// Radius of the capsules that stand in for meshes, m: any.
const MISSING: Meshes = Meshes::OrCapsules(0.05);

fn text(name: &str) -> String {
    std::fs::read_to_string(shipped(name)).unwrap()
}

pub(crate) fn robot_file(bytes: &[u8]) -> bool {
    Scratch::file("aros.urdf", text("robots/aros.urdf").as_bytes());
    Scratch::with("aros.toml", bytes, |path| {
        taken(Robot::load(path)).is_some_and(|robot| is_planned_for(&robot))
    })
}

pub(crate) fn urdf(bytes: &[u8]) -> bool {
    Scratch::file("aros.toml", text("robots/aros.toml").as_bytes());
    Scratch::with("aros.urdf", bytes, |path| {
        let Some(urdf) = taken(Urdf::load(path)) else { return false };
        if let Some(mechanism) = taken(Mechanism::from_urdf(urdf.clone(), MISSING)) {
            taken(mechanism.collision_model(&|_| 0.3));
            taken(mechanism.with_hand(&urdf, MISSING));
        }
        taken(Robot::load(&path.with_file_name("aros.toml"))).is_none_or(|robot| {
            is_planned_for(&robot);
            true
        })
    })
}

fn is_planned_for(robot: &Robot) -> bool {
    let model =
        Mechanism::of(robot).and_then(|mechanism| mechanism.with_fingers(&robot.hand, &[0.1; HAND_JOINTS]));
    taken(model).is_some()
}

pub(crate) fn mesh_stl(bytes: &[u8]) -> bool {
    mesh("mesh.stl", bytes)
}

pub(crate) fn mesh_obj(bytes: &[u8]) -> bool {
    mesh("mesh.obj", bytes)
}

pub(crate) fn mesh_collada(bytes: &[u8]) -> bool {
    mesh("mesh.dae", bytes)
}

/// Loads a robot of which one link is this mesh.
fn mesh(name: &str, bytes: &[u8]) -> bool {
    thread_local! {
        static ROBOTS: RefCell<BTreeMap<String, Robot>> = const { RefCell::new(BTreeMap::new()) };
    }
    Scratch::file(name, bytes);
    let load = || {
        let mesh = format!("<mesh filename=\"{name}\"/>");
        let urdf = text("robots/aros.urdf").replace("<sphere radius=\"0.08\"/>", &mesh);
        Scratch::file("aros.urdf", urdf.as_bytes());
        Robot::load(&Scratch::file("aros.toml", text("robots/aros.toml").as_bytes())).unwrap()
    };
    ROBOTS.with_borrow_mut(|robots| is_planned_for(robots.entry(name.to_owned()).or_insert_with(load)))
}
