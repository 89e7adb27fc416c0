//! What the person does at a part that the robot has as well, and what the robot's wrist feels of it.

use super::manipulator::{Fingers, Manipulator};
use super::{Out, robot, task};
use crate::parts::Holder;
use crate::person::{Script, Stage};
use crate::robot_hand::Palm;
use crate::slot::Slot;
use crate::{BodyKind, Partner, Settings, World};
use glam::{DQuat, DVec3};
use std::io::Write;

/// A world whose person follows a script, and a robot's hand without an arm.
struct Meeting {
    world: World,
    out: Out,
    palm: Palm,
    tick: u64,
}

impl Meeting {
    fn new(script: &str) -> Self {
        let mut file = tempfile::NamedTempFile::new().unwrap();
        file.write_all(script.as_bytes()).unwrap();
        let partner = Partner::Script(Script::load(file.path(), &task()).unwrap());
        let settings = Settings { seed: 1, partner, body: BodyKind::Kinematic };
        let world = World::new(&task(), &robot(), settings).unwrap();
        let palm =
            Palm { grasp_point: DVec3::new(0.0, 0.0, 2.0), orientation: DQuat::IDENTITY, closing: 0.0 };
        Self { world, out: Out::new(), palm, tick: 0 }
    }

    /// The person needs a nut, and the robot holds one out.
    fn giving(action: &str) -> Self {
        let mut meeting = Self::new(&format!(
            "[start]\nachieved = [\"wheel on the person's side\"]\n\n[[action]]\n{action}\n"
        ));
        let nut = meeting.nut();
        meeting.palm.grasp_point = meeting.world.parts.position(nut);
        meeting.live(10);
        meeting.palm.closing = 2.0;
        meeting.live(10);
        meeting.palm.grasp_point = meeting.world.task.scene.handover.into();
        meeting
    }

    /// The robot's nut.
    fn nut(&self) -> usize {
        let task = &self.world.task;
        task.parts.iter().position(|part| task.kinds[part.kind].name == "nut").unwrap()
    }

    fn live(&mut self, ticks: u64) {
        for _ in 0..ticks {
            self.tick += 1;
            let World { parts, task, .. } = &mut self.world;
            parts.rest_free(task);
            self.world.live(self.tick, &self.palm);
            self.world.sense(self.tick, &mut self.out.sample);
            self.world.memory.tick = self.tick;
            self.world.memory.started = 1;
        }
    }

    /// Goes on up to the first tick of a stage of the person's.
    fn until(&mut self, stage: Stage) {
        let begun = self.tick;
        while self.world.memory.person.stage() != stage {
            self.live(1);
            assert!(self.tick < begun + 30_000, "{stage:?} does not come");
        }
    }

    fn force(&self) -> DVec3 {
        self.out.sample.joints.wrist_force.into()
    }

    /// The part of a force that is directed from the robot's hand towards the person, N.
    fn towards_person(&self) -> f64 {
        let shoulder = DVec3::from(self.world.task.scene.person_shoulder);
        self.force().dot((shoulder - self.palm.grasp_point).normalize())
    }
}

const TAKES: &str = "chain = \"insert\"\nkind = \"nut\"";

#[test]
fn person_pulls_at_an_offered_part_until_the_robot_lets_go() {
    let mut meeting = Meeting::giving(TAKES);
    let nut = meeting.nut();
    meeting.until(Stage::AwaitRelease);
    assert_eq!(meeting.force(), DVec3::ZERO, "the fingers have just closed");
    for (ticks, expected) in [(100, 1.0), (200, 3.0), (400, 4.0), (5000, 4.0)] {
        meeting.live(ticks);
        let pull = meeting.towards_person();
        assert!((pull - expected).abs() < 0.1, "{pull} N instead of {expected} N");
        assert!(meeting.force().x < 0.0);
    }
    assert!(meeting.world.parts.is(nut, Holder::Robot));
    meeting.palm.closing = 0.0;
    meeting.live(1);
    assert_eq!(meeting.force(), DVec3::ZERO);
    assert!(meeting.world.parts.is(nut, Holder::Person));
}

#[test]
fn pull_ends_when_the_person_lets_go_again() {
    let mut meeting = Meeting::giving(TAKES);
    let nut = meeting.nut();
    meeting.until(Stage::AwaitRelease);
    meeting.until(Stage::Withdraw);
    assert_eq!(meeting.force(), DVec3::ZERO);
    assert!(meeting.world.parts.is(nut, Holder::Robot), "the robot has kept it");
}

#[test]
fn part_is_pressed_lightly_into_the_open_hand() {
    let mut meeting = Meeting::new("[[action]]\nchain = \"hand over\"\nkind = \"wheel\"\n");
    meeting.until(Stage::Offer);
    meeting.live(100);
    assert_eq!(meeting.force(), DVec3::ZERO, "the robot's hand is elsewhere");
    meeting.palm.grasp_point = meeting.world.task.scene.handover.into();
    meeting.live(51);
    assert!((meeting.towards_person() + 0.5).abs() < 0.1, "{} N", meeting.towards_person());
    meeting.live(500);
    assert!((meeting.towards_person() + 1.0).abs() < 0.1, "{} N", meeting.towards_person());
    meeting.palm.closing = 2.0;
    meeting.live(300);
    assert_eq!(meeting.force(), DVec3::ZERO, "the person has let go");
    assert!(!super::held_by(&meeting.world, Holder::Robot).is_empty());
}

#[test]
fn wrist_feels_a_pull_but_neither_the_weight_nor_the_inertia_of_what_is_held() {
    let mut robot = Manipulator::holding("column 3", 7);
    let force = |robot: &Manipulator| DVec3::from(robot.out.sample.joints.wrist_force);
    let handover = DVec3::from(robot.world.task.scene.handover);
    let (before, _) = robot.reach(handover, DVec3::Z);
    let mut most: f64 = 0.0;
    robot.watch(&before, Fingers::Closed, |robot| most = most.max(force(robot).length()));
    assert!(most < 0.3, "{most} N in a free movement");
    let person = &mut robot.world.memory.person;
    person.enter(Stage::AwaitRelease, u64::MAX);
    person.grip = Slot::of(0);
    robot.stay(1000);
    let towards = DVec3::from(robot.world.memory.person.force).normalize();
    let pull = force(&robot).dot(towards);
    assert!((pull - 4.0).abs() < 0.3 && robot.holds(), "{} instead of 4 N", force(&robot));
    robot.go(&before, Fingers::Open);
    assert!(robot.world.parts.is(0, Holder::Person), "taken as soon as it was let go");
    assert_eq!(force(&robot), DVec3::ZERO);
}
