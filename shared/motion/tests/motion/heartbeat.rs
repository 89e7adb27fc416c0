//! A search beats all the time, so that a long one is not taken for one that hangs.
#![allow(clippy::unwrap_used)]

use coact_motion::{Goal, Mechanism, Obstacle, Problem, Scene, SearchHeartbeat, Solid};
use coact_robot::{HandGoal, MotionState, Robot};
use nalgebra::{Isometry3, Vector3};
use std::thread;
use std::time::{Duration, Instant};

/// Far longer than any step of a search takes, on a busy machine too.
const LONGEST_PAUSE: Duration = Duration::from_secs(2);

/// Plans a movement past as many pillars, and is refused or not.
fn plan(heartbeat: SearchHeartbeat, pillars: usize) {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config/robots/aros.toml");
    let robot = Robot::load(file.as_ref()).unwrap();
    let mechanism = Mechanism::of(&robot).unwrap().beating(heartbeat);
    let collision_model = mechanism.with_fingers(&robot.hand, &robot.hand.posture(1.2)).unwrap();
    let pillar = |index: usize| {
        let place = Isometry3::translation(-0.45 - 0.1 * index as f64, 0.45 - 0.05 * index as f64, 1.0);
        Obstacle::new("pillar", Solid::Cylinder { radius: 0.03, height: 0.6 }, &place)
    };
    let table = Obstacle::new(
        "table",
        Solid::Box(Vector3::new(1.0, 1.2, 0.04)),
        &Isometry3::translation(-0.7, 0.3, 0.68),
    );
    let obstacles = (0..pillars).map(pillar).chain([table]).collect();
    let scene = Scene { obstacles, ..Scene::default() };
    let part = Isometry3::translation(-0.55, 0.25, 0.7);
    let goals = (0..8).map(|grip| HandGoal::grip(&part, 0.04, grip % 2, 0.15 + 0.1 * grip as f64, 0.7));
    let start = robot.park.map(MotionState::at_rest);
    _ = Problem::new(&mechanism, &collision_model, &scene, start, Goal::Hand(goals.collect())).plan();
}

#[test]
fn a_search_beats_all_the_time() {
    let heartbeat = SearchHeartbeat::default();
    let own = heartbeat.clone();
    let search = thread::spawn(move || (0..4).for_each(|pillars| plan(own.clone(), pillars)));
    let (begin, mut last, mut at, mut longest) = (Instant::now(), 0, Instant::now(), Duration::ZERO);
    while !search.is_finished() {
        thread::sleep(Duration::from_micros(50));
        let beats = heartbeat.beats();
        if beats != last {
            (last, at) = (beats, Instant::now());
        }
        longest = longest.max(at.elapsed());
    }
    search.join().unwrap();
    println!("{last} beats in {:?}, none for {longest:?} at the longest", begin.elapsed());
    assert!(last > 1000 && longest < LONGEST_PAUSE, "{last} beats, none for {longest:?}");
}
