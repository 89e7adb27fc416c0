//! What counts as closing, by whom, and what as contact.
#![allow(clippy::unwrap_used)]

use coact_messages::{ARM_JOINTS, Command, JOINTS, Truth};
use coact_robot::Robot;
use coact_safety::SafetyLimits;
use coact_separation::SeparationMeter;
use nalgebra::{Point3, Vector3};
use std::path::Path;

fn shipped() -> (Robot, SafetyLimits) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
    let robot = Robot::load(&folder.join("robots/aros.toml")).unwrap();
    (robot, SafetyLimits::load(&folder.join("safety.toml")).unwrap())
}

/// All joints, with the arm parked but for its first joint, and the fingers' bases at an angle, rad.
fn joints(robot: &Robot, first: f64, base: f64) -> [f64; JOINTS] {
    let mut joints = [0.0; JOINTS];
    joints[..ARM_JOINTS].copy_from_slice(&robot.park);
    joints[0] += first;
    let fingers = robot.hand.posture(base);
    joints[ARM_JOINTS..ARM_JOINTS + fingers.len()].copy_from_slice(&fingers);
    joints
}

fn palm(robot: &Robot, first: f64) -> Point3<f64> {
    let joints = joints(robot, first, 0.5);
    let posture: [f64; ARM_JOINTS] = std::array::from_fn(|joint| joints[joint]);
    Point3::from(robot.palm(&posture).translation.vector)
}

/// Direction in which the palm moves when the first joint turns.
fn sideways(robot: &Robot) -> Vector3<f64> {
    (palm(robot, 1e-3) - palm(robot, 0.0)).normalize()
}

/// A robot and, beside its palm, the hand of an arm that points at it.
struct Scene {
    robot: Robot,
    meter: SeparationMeter,
    /// From the palm to the finger tip of the person.
    away: Vector3<f64>,
}

impl Scene {
    /// With so many metres between hand and robot.
    fn with_gap(gap: f64) -> Self {
        let (robot, limits) = shipped();
        let meter = SeparationMeter::new(&robot, &limits).unwrap();
        let away = sideways(&robot) * 0.5;
        let mut scene = Self { robot, meter, away };
        // The nearest link is not straight on the way to the palm: a few steps lead there.
        for _ in 0..20 {
            let mut meter = scene.meter.clone();
            meter.tick(&scene.truth(0.0, 0.5, 0.0), &bytemuck::zeroed_box());
            let too_far = meter.report().nearest_m.unwrap() - gap;
            scene.away -= scene.away.normalize() * too_far;
        }
        scene
    }

    /// The robot's first joint turned by `first`, its fingers at `base`, rad, and the person nearer by `nearer` m.
    fn truth(&self, first: f64, base: f64, nearer: f64) -> Box<Truth> {
        let mut truth: Box<Truth> = bytemuck::zeroed_box();
        truth.joints = joints(&self.robot, first, base);
        let outwards = self.away.normalize();
        let tip = palm(&self.robot, 0.0) + self.away - outwards * nearer;
        for (joint, length) in [0.8, 0.5, 0.2, 0.0].into_iter().enumerate() {
            truth.arms[0][joint] = (tip + outwards * length).into();
        }
        truth
    }

    fn tick(&mut self, first: f64, base: f64, nearer: f64) {
        let (truth, command): (_, Box<Command>) = (self.truth(first, base, nearer), bytemuck::zeroed_box());
        self.meter.tick(&truth, &command);
    }
}

#[test]
fn whoever_moves_is_who_closes() {
    let mut scene = Scene::with_gap(0.03);
    scene.tick(0.0, 0.5, 0.0);
    scene.tick(0.0, 0.5, 0.001);
    let report = scene.meter.report();
    assert_eq!((report.robot_closing_ms, report.person_closing_ms), (0, 1), "{report:?}");
    scene.tick(0.001, 0.5, 0.001);
    let report = scene.meter.report();
    assert_eq!((report.robot_closing_ms, report.person_closing_ms), (1, 1), "{report:?}");
    assert_eq!((report.contact_ms, report.contact_speed_mps), (0, 0.0));
    // Who goes away closes nothing.
    scene.tick(-0.001, 0.5, 0.0);
    let report = scene.meter.report();
    assert_eq!((report.robot_closing_ms, report.person_closing_ms), (1, 1), "{report:?}");
}

/// Whoever looks at the messages now and then knows an older command, or a younger one, than what the joints follow.
#[test]
fn whether_a_motion_is_part_of_a_handover_no_command_tells_but_the_truth() {
    let closing_ms = |followed, known| {
        let mut scene = Scene::with_gap(0.03);
        let command = Box::new(Command { handover: known, ..*bytemuck::zeroed_box::<Command>() });
        for first in [0.0, 0.001] {
            let truth = Truth { handover: followed, ..*scene.truth(first, 0.5, 0.0) };
            scene.meter.tick(&truth, &command);
        }
        scene.meter.report().robot_closing_ms
    };
    assert_eq!([closing_ms(1, 0), closing_ms(0, 1)], [0, 1]);
}

#[test]
fn beyond_the_protective_separation_everybody_may_close() {
    let mut scene = Scene::with_gap(0.05);
    (0..5).for_each(|step| scene.tick(0.001 * f64::from(step), 0.5, 0.001 * f64::from(step)));
    let report = scene.meter.report();
    assert_eq!((report.robot_closing_ms, report.person_closing_ms), (0, 0), "{report:?}");
}

#[test]
fn contact_is_counted_with_the_speed_of_what_touches() {
    let mut scene = Scene::with_gap(-0.01);
    scene.tick(0.0, 0.5, 0.0);
    scene.tick(0.0, 0.5, 0.0);
    assert_eq!(scene.meter.report().contact_ms, 1);
    assert!(scene.meter.report().contact_speed_mps < 1e-9);
    scene.tick(0.0002, 0.5, 0.0);
    let report = scene.meter.report();
    // What touches is in contact; its neighbours, which do not, close.
    assert_eq!((report.contact_ms, report.robot_closing_ms), (2, 1));
    // The palm is 0.3 to 1.2 m away from the axis of the first joint, which turns by 0.2 rad/s.
    assert!((0.05..0.3).contains(&report.contact_speed_mps), "{report:?}");
}

#[test]
fn fingers_that_hardly_move_close_on_nobody() {
    let mut scene = Scene::with_gap(0.03);
    // Once through all shapes that there are models of; the finger ends move by less than 15 µm in each tick.
    let limits = scene.robot.hand.joints[1].limits;
    let ticks = ((limits.upper - limits.lower) / 1e-4) as u32;
    (0..ticks).for_each(|tick| scene.tick(0.0, limits.upper - 1e-4 * f64::from(tick), 0.0));
    assert_eq!(scene.meter.report().robot_closing_ms, 0, "{:?}", scene.meter.report());
}

#[test]
fn the_margin_is_what_is_left_beyond_the_way_of_both_until_the_robot_stands() {
    let measured = |ticks: &[(f64, f64)]| {
        let mut scene = Scene::with_gap(0.10);
        ticks.iter().for_each(|(first, nearer)| scene.tick(*first, 0.5, *nearer));
        let report = scene.meter.report();
        (report.smallest_margin_m, report.nearest_m.unwrap())
    };
    assert_eq!(measured(&[(0.0, 0.0), (0.0, 0.001)]).0, None, "the robot stands");
    assert_eq!(measured(&[(0.0, 0.0), (-0.001, 0.0)]).0, None, "the robot goes away");
    let (alone, nearest) = measured(&[(0.0, 0.0), (0.001, 0.0)]);
    // It has closed by this much in a millisecond, reacts in 35 ms, brakes at 10 m/s², and is known to 20 mm.
    let speed = (0.10 - nearest) / 1e-3;
    let left = nearest - (0.02 + 0.035 * speed + speed * speed / 20.0);
    assert!(speed > 0.1 && (alone.unwrap() - left).abs() < 1e-3, "{alone:?}, {left} m at {speed} m/s");
    // A hand that comes at 1 m/s takes a millimetre now, and one for each millisecond until the robot stands.
    let (both, _) = measured(&[(0.0, 0.0), (0.001, 0.001)]);
    let less = alone.unwrap() - both.unwrap();
    assert!((less - (0.001 + 0.035 + speed / 10.0)).abs() < 1e-3, "{less} m less");
}
