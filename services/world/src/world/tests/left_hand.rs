//! The partner who takes some parts with the left hand.

use super::fake_robot::FakeRobot;
use super::{Out, config, robot};
use crate::Partner;
use crate::world::World;
use coact_joint_task::Task;
use coact_messages::{ArmSide, KeypointName};
use coact_person::Activity;
use coact_pipeline::WorldMode;
use coact_stage_state::Slot;
use glam::DVec3;

const ALWAYS: &str = "random:idle=0,goal=0.5,means=0,hidden=0,words=0,dropouts=0,left=1";
/// No wrist goes so far in a tick, m: 3 m/s.
const STEP: f64 = 0.003;

/// As it is shipped: some parts lie nearer to the left hand.
fn task() -> Task {
    Task::load(&config("tasks/toy-vehicle.toml")).unwrap()
}

fn world(seed: u64) -> World {
    let partner = Partner::load(ALWAYS, &task(), seed).unwrap();
    World::new(&task(), &robot(), super::settings(seed, partner, WorldMode::Kinematic)).unwrap()
}

#[test]
fn the_left_hand_takes_what_lies_nearer_to_it_and_neither_hand_ever_jumps() {
    let rest = ArmSide::BOTH.map(|side| DVec3::from(task().scene.rest(side)));
    let (mut by_left, mut by_right, mut received) = (0, 0, 0);
    for seed in 0..3 {
        let (mut world, mut robot, mut out) = (world(seed), FakeRobot::new(), Out::new());
        let mut before: Option<[DVec3; 2]> = None;
        for tick in 1..=60_000 {
            let held = world.simulation.person.held;
            robot.step(tick, &mut world, &mut out);
            let person = &world.simulation.person;
            let wrists = out.truth.arms.map(|[_, _, wrist, _]| DVec3::from(wrist));
            if let Some(before) = before {
                let farthest = before[0].distance(wrists[0]).max(before[1].distance(wrists[1]));
                assert!(farthest < STEP, "seed {seed}, tick {tick}: {farthest} m");
            }
            before = Some(wrists);
            assert_eq!(out.truth.side, person.side as u32);
            let other = person.side.other() as usize;
            assert!(wrists[other].distance(rest[other]) < 1e-9, "the other hand rests");
            if held != Slot::EMPTY || person.held == Slot::EMPTY {
                continue;
            }
            let centre = world.parts.view().centre(person.held.get().unwrap(), &world.task);
            assert!(centre.distance(world.person.hand_centre(person)) < 1e-6);
            let [right, left] = rest.map(|rest| rest.distance(centre));
            match person.side {
                ArmSide::Left if person.activity() == Activity::Receive => received += 1,
                ArmSide::Left => {
                    by_left += 1;
                    assert!(left < right, "{left}, {right}");
                }
                ArmSide::Right => by_right += 1,
            }
        }
    }
    assert!(by_left >= 3 && by_right >= 3, "{by_left} with the left hand, {by_right} with the right one");
    assert!(received >= 3, "{received} from the robot with the left hand");
}

#[test]
fn the_tracker_shows_each_hand_where_it_is_and_the_left_one_as_a_mirror_image() {
    let (mut world, mut robot, mut out) = (world(1), FakeRobot::new(), Out::new());
    (1..=200).for_each(|tick| robot.step(tick, &mut world, &mut out));
    let thumb_side = ArmSide::BOTH.map(|side| {
        let at = |name: KeypointName| {
            DVec3::from(out.sample.hands[side as usize].keypoints[name as usize].position)
        };
        let wrist = DVec3::from(out.truth.arms[side as usize][2]);
        assert!(at(KeypointName::Wrist).distance(wrist) < 0.01, "{side:?}");
        let [ahead, thumb] =
            [KeypointName::LittleKnuckle, KeypointName::ThumbTip].map(|name| at(name) - wrist);
        ahead.truncate().perp_dot(thumb.truncate()).signum()
    });
    assert_eq!(thumb_side, [1.0, -1.0], "seen from above, thumbs point at each other");
}
