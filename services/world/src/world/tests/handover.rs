//! What the person does at a part that the robot has as well, and what the robot's wrist feels of it.

use super::manipulator::{Fingers, Manipulator};
use super::{NOISE, Out, robot, task};
use crate::palm::Palm;
use crate::{Partner, Scenario, World};
use coact_period::seconds;
use coact_person::Holder;
use coact_person::{ActivityPhase, Person, Policy, RandomBehaviour};
use coact_pipeline::WorldMode;
use coact_random::RandomStreams;
use coact_stage_state::{Flag, Slot};
use glam::{DQuat, DVec3};
use std::io::Write;

/// Seed of all runs.
const SEED: u64 = 1;

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
        let partner = Partner::Script(Scenario::load(file.path(), &task()).unwrap());
        let settings = super::settings(SEED, partner, WorldMode::Kinematic);
        let world = World::new(&task(), &robot(), settings).unwrap();
        let palm = Palm {
            grasp_point: DVec3::new(0.0, 0.0, 2.0),
            orientation: DQuat::IDENTITY,
            finger_closure: 0.0,
        };
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
        meeting.palm.finger_closure = 2.0;
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
            self.world.simulation.tick = self.tick;
            self.world.simulation.started = Flag::Set;
        }
    }

    /// Goes on up to the first tick of a stage of the person's.
    fn until(&mut self, stage: ActivityPhase) {
        let begun = self.tick;
        while self.world.simulation.person.phase() != stage {
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
fn person_pulls_at_a_given_part_until_the_robot_lets_go() {
    let mut meeting = Meeting::giving(TAKES);
    let nut = meeting.nut();
    meeting.until(ActivityPhase::AwaitRelease);
    assert!(meeting.force().length() < NOISE, "the fingers have just closed");
    for (ticks, expected) in [(100, 1.0), (200, 3.0), (400, 4.0), (5000, 4.0)] {
        meeting.live(ticks);
        let pull = meeting.towards_person();
        assert!((pull - expected).abs() < 0.1, "{pull} N instead of {expected} N");
        assert!(meeting.force().x < 0.0);
    }
    assert!(meeting.world.parts.is(nut, Holder::Robot));
    meeting.palm.finger_closure = 0.0;
    meeting.live(1);
    assert!(meeting.force().length() < NOISE);
    assert!(meeting.world.parts.is(nut, Holder::Person));
}

#[test]
fn pull_ends_when_the_person_lets_go_again() {
    let mut meeting = Meeting::giving(TAKES);
    let nut = meeting.nut();
    meeting.until(ActivityPhase::AwaitRelease);
    meeting.until(ActivityPhase::Withdraw);
    assert!(meeting.force().length() < NOISE);
    assert!(meeting.world.parts.is(nut, Holder::Robot), "the robot has kept it");
}

#[test]
fn person_who_withdraws_leaves_the_part_to_the_robot() {
    let mut meeting = Meeting::giving(&format!("{TAKES}\ngives_up = 0.3"));
    let nut = meeting.nut();
    meeting.until(ActivityPhase::AwaitRelease);
    let grasped = meeting.tick;
    meeting.live(250);
    assert!(meeting.towards_person() > 2.0);
    meeting.until(ActivityPhase::Withdraw);
    assert_eq!(meeting.tick, grasped + 300);
    assert!(meeting.force().length() < NOISE);
    meeting.palm.finger_closure = 0.0;
    meeting.live(5);
    assert!(meeting.world.parts.is(nut, Holder::Nobody), "the robot lets go too late");
    assert_eq!(meeting.world.parts.position(nut).z, meeting.world.task.scene.table_height);
}

#[test]
fn part_that_both_let_go_falls_and_belongs_to_nobody() {
    let mut meeting = Meeting::giving(&format!("{TAKES}\ngives_up = 0.3"));
    let nut = meeting.nut();
    meeting.until(ActivityPhase::AwaitRelease);
    meeting.live(200);
    meeting.palm.finger_closure = 0.0;
    meeting.live(50);
    assert!(meeting.world.parts.is(nut, Holder::Person));
    meeting.live(100);
    assert!(meeting.world.parts.is(nut, Holder::Nobody));
    assert_eq!(meeting.world.parts.position(nut).z, meeting.world.task.scene.table_height);
    meeting.live(3100);
    let home = meeting.world.task.parts[nut].at;
    assert_eq!(meeting.world.parts.position(nut).truncate(), home.into(), "lies where it can be taken again");
}

#[test]
fn part_that_nobody_takes_hold_of_in_time_falls_to_the_table_by_physics() {
    let mut robot = Manipulator::holding("column 3", 8);
    let (before, _) = robot.reach(robot.world.task.scene.handover.into(), DVec3::Z);
    robot.go(&before, Fingers::Closed);
    let person = &mut robot.world.simulation.person;
    person.enter(ActivityPhase::AwaitRelease, u64::MAX);
    person.held = Slot::of(0);
    person.gives_up = u64::MAX;
    robot.stay(300);
    robot.world.simulation.person.gives_up = 1;
    robot.go(&before, Fingers::Open);
    robot.stay(1000);
    let lies = robot.world.parts.position(0).z - robot.world.task.scene.table_height;
    assert!(
        robot.world.parts.is(0, Holder::Nobody) && !robot.holds() && lies < 0.1,
        "{lies} m above the table"
    );
    assert!(robot.out.sample.joints.touch < NOISE);
}

#[test]
fn person_who_takes_a_part_back_has_not_dropped_it() {
    let action = "chain = \"hand over\"\nkind = \"wheel\"\ngives_up = 4.0";
    let mut meeting = Meeting::new(&format!("[[action]]\n{action}\n"));
    meeting.until(ActivityPhase::Give);
    let wheel = meeting.world.simulation.person.held.get().unwrap();
    meeting.until(ActivityPhase::Withdraw);
    let home = meeting.world.task.parts[wheel].at;
    assert!(meeting.world.parts.is(wheel, Holder::Nobody));
    assert!(meeting.world.parts.position(wheel).truncate().distance(home.into()) < 0.01);
}

/// Seconds from when the robot gives to the person's setting out for it.
fn answered_after(settings: &str) -> f64 {
    let mut meeting = Meeting::giving(TAKES);
    let policy = Policy::Random(RandomBehaviour::parse(settings).unwrap());
    meeting.world.person =
        Person::new(&meeting.world.task.scene, &super::habits(), policy, RandomStreams::new(SEED), None);
    meeting.world.simulation.person.enter(ActivityPhase::Rest, 0);
    while meeting.world.simulation.robot.giving_since == 0 {
        meeting.live(1);
    }
    let given = meeting.tick;
    meeting.until(ActivityPhase::AwaitRelease);
    seconds(meeting.tick - given)
}

#[test]
fn person_may_come_late() {
    let late = answered_after("late=1,withdraws=0");
    assert!((2.3..8.0).contains(&late), "{late} s");
    assert!(answered_after("late=0,withdraws=0") < 2.0);
}

#[test]
fn part_is_pressed_lightly_into_the_open_hand() {
    let mut meeting = Meeting::new("[[action]]\nchain = \"hand over\"\nkind = \"wheel\"\n");
    meeting.until(ActivityPhase::Give);
    meeting.live(100);
    assert!(meeting.force().length() < NOISE, "the robot's hand is elsewhere");
    meeting.palm.grasp_point = meeting.world.task.scene.handover.into();
    meeting.live(51);
    assert!((meeting.towards_person() + 0.5).abs() < 0.1, "{} N", meeting.towards_person());
    meeting.live(500);
    assert!((meeting.towards_person() + 1.0).abs() < 0.1, "{} N", meeting.towards_person());
    meeting.palm.finger_closure = 2.0;
    meeting.live(300);
    assert!(meeting.force().length() < NOISE, "the person has let go");
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
    let person = &mut robot.world.simulation.person;
    person.enter(ActivityPhase::AwaitRelease, u64::MAX);
    person.held = Slot::of(0);
    robot.stay(1000);
    let towards = DVec3::from(robot.world.simulation.person.force).normalize();
    let pull = force(&robot).dot(towards);
    assert!((pull - 4.0).abs() < 0.3 && robot.holds(), "{} instead of 4 N", force(&robot));
    robot.go(&before, Fingers::Open);
    assert!(robot.world.parts.is(0, Holder::Person), "taken as soon as it was let go");
    assert!(force(&robot).length() < NOISE);
}
