//! The partner who reaches behind something.

use super::mistakes::run;
use crate::parts::Parts;
use crate::sensors::{LinesOfSight, is_seen, recognise};
use coact_messages::{KeypointName, NONE, SceneView, SensorSample, Sighting};
use coact_motion::Capsule;
use coact_person::ActivityPhase;
use coact_random::RandomStreams;
use glam::DVec3;
use nalgebra::{Point3, Vector3};

const ALWAYS: &str = "idle=0,goal=0,request=0,means=0,hidden=1,words=0,dropouts=0";

/// Ticks of one hidden action, and what was seen in it.
#[derive(Debug, Default)]
struct Hidden {
    chosen: u64,
    grasped: u64,
    lifted: u64,
    kind: u32,
    home: [f64; 3],
    seen_setting_out: bool,
    seen_again: bool,
}

impl Hidden {
    /// What the newest frames of hand and parts tell, by the ticks of their capture.
    fn look(&mut self, sample: &SensorSample) {
        let shows_the_hand = sample.hands[0].keypoints[KeypointName::Wrist as usize..]
            .iter()
            .any(|point| point.confidence > 0.0);
        let captured = if shows_the_hand { sample.hands[0].captured_cycle } else { 0 };
        let at_the_part =
            self.grasped > 0 && captured >= self.grasped && (self.lifted == 0 || captured < self.lifted);
        assert!(!at_the_part, "the hand is seen at the part: {self:?}");
        let wrist = sample.hands[0].keypoints[KeypointName::Wrist as usize].confidence > 0.0;
        self.seen_setting_out |= wrist && self.grasped == 0 && captured > self.chosen;
        self.seen_again |= wrist && self.lifted > 0 && captured > self.lifted;
        let scene = &sample.scene;
        if scene.captured_cycle < self.chosen {
            return;
        }
        assert_eq!(scene.obstacles, 1);
        for sighting in &scene.sighting[..scene.sightings as usize] {
            let away =
                (0..3).map(|axis| (sighting.position[axis] - self.home[axis]).powi(2)).sum::<f64>().sqrt();
            assert!(sighting.kind != self.kind || away > 0.02, "the part is seen where it lies: {self:?}");
        }
    }
}

#[test]
fn hand_and_part_are_not_seen_until_the_hand_comes_out_again() {
    let (mut hidden, mut takings) = (0, 0);
    for seed in 0..4 {
        let (mut now, mut last): (Option<Hidden>, _) = (None, ActivityPhase::Rest);
        run(seed, 120, ALWAYS, |tick, world, out, _| {
            let person = &world.simulation.person;
            let before = std::mem::replace(&mut last, person.phase());
            takings += u64::from(before == ActivityPhase::Reach && person.phase() == ActivityPhase::Dwell);
            assert_eq!(
                person.occluder().is_some(),
                person.variation.hidden.is_set() && person.phase() != ActivityPhase::Rest
            );
            let shown = person.occluder().is_some() && out.truth.chain != NONE;
            assert_eq!(out.truth.hidden, u32::from(shown), "seed {seed}, tick {tick}");
            let Some(part) = person.part.get().filter(|_| person.occluder().is_some()) else {
                let over = now.take().filter(|over| over.grasped > 0);
                assert!(over.is_none_or(|over| over.seen_setting_out && over.seen_again));
                return;
            };
            let own = now.get_or_insert_with(|| {
                let (kind, home) = (world.parts.kind(part) as u32, world.parts.position(part).into());
                Hidden { chosen: tick, kind, home, ..Hidden::default() }
            });
            match (before, person.phase()) {
                (ActivityPhase::Reach, ActivityPhase::Dwell) => (own.grasped, hidden) = (tick, hidden + 1),
                (ActivityPhase::Dwell, _) if own.lifted == 0 && person.phase() != ActivityPhase::Dwell => {
                    own.lifted = tick
                }
                _ => {}
            }
            own.look(&out.sample);
        });
    }
    assert!(hidden >= 10 && 2 * hidden >= takings, "{hidden} of {takings} were hidden");
}

#[test]
fn parts_behind_the_person_s_arm_are_not_seen() {
    let mut behind = 0;
    run(3, 60, "hidden=0,dropouts=0", |tick, world, out, _| {
        let scene = &out.sample.scene;
        if scene.captured_cycle != tick {
            return;
        }
        let [shoulder, elbow, wrist, _] = out.truth.arms[0];
        for part in 0..world.parts.all().len() {
            let (kind, at) = (world.parts.kind(part) as u32, world.parts.position(part));
            let height = world.task.kinds[world.parts.kind(part)].shape.height();
            let top = at + world.parts.orientation(part) * DVec3::Z * height;
            let arm = [[shoulder, elbow], [elbow, wrist]].map(|[start, end]| Capsule {
                start: start.into(),
                end: end.into(),
                radius: 0.03,
            });
            let eye = world.task.scene.eye();
            let sight = LinesOfSight { eye, boxes: &[], robot: &[], person: &arm };
            if !is_seen(top.into(), &sight, &world.task.scene) {
                behind += 1;
                let shows =
                    |one: &Sighting| one.kind == kind && at.distance(DVec3::from(one.position)) < 0.012;
                assert!(!scene.sightings().iter().any(shows), "part {part} at tick {tick}");
            }
        }
    });
    assert!(behind > 20, "seldom: {behind}");
}

#[test]
fn what_is_behind_a_link_of_the_robot_is_not_seen_and_the_picture_shows_that_something_is_before_it() {
    let (task, random) = (super::task(), RandomStreams::new(5));
    let parts = Parts::new(&task, Vec::new(), task.scene.fit);
    let (eye, at) = (task.scene.eye(), |part| parts.position(part));
    let link = |middle: DVec3, radius| {
        let (middle, aside) = (Point3::from(middle.to_array()), Vector3::new(0.05, 0.02, 0.0));
        Capsule { start: middle - aside, end: middle + aside, radius }
    };
    // Over one part on the robot's side so low that neither camera sees it; before another so high that the one beside the table does.
    let of_robot = |part: &usize| task.scene.is_before_eye_beside(at(*part).into());
    let mut of_robot = (0..task.parts.len()).filter(of_robot);
    let [low, high] = std::array::from_fn(|_| of_robot.next().unwrap());
    let links = [link(at(low) + 0.12 * DVec3::Z, 0.1), link(at(high).lerp(eye.into(), 0.2), 0.04)];
    let sight = LinesOfSight { eye, boxes: &[], robot: &links, person: &[] };
    let mut view: Box<SceneView> = bytemuck::zeroed_box();
    let hidden: Vec<bool> = (0..task.parts.len()).map(|part| sight.hide(at(part).into())).collect();
    let is_seen = |part: usize| is_seen(at(part).into(), &sight, &task.scene);
    assert!(hidden[low] && !is_seen(low) && hidden[high] && is_seen(high), "{hidden:?}");
    assert!(hidden.iter().filter(|hidden| **hidden).count() < 5, "{hidden:?}");
    let mut seen = vec![0; task.parts.len()];
    for frame in 1..=100_u64 {
        recognise(100 * frame, Some(100 * frame - 100), &random, (&task, &parts), &sight, &mut view);
        for (part, seen) in seen.iter_mut().enumerate() {
            let shows = |one: &Sighting| at(part).distance(DVec3::from(one.position)) < 0.012;
            *seen += u32::from(view.sightings().iter().any(shows));
            let above = view.surface.above(eye, at(part).into()).unwrap();
            assert_eq!(above > 0.1, hidden[part], "part {part}: {above}");
        }
    }
    for (part, seen) in seen.into_iter().enumerate() {
        assert!(if is_seen(part) { seen > 90 } else { seen == 0 }, "part {part}: {seen} of 100");
    }
}
