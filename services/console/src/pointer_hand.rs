use crate::{Pointer, Surroundings, Thing};
use coact_joint_task::Task;
use coact_messages::KeypointName;
use coact_person::{FINGERS, HandModel};
use glam::{DVec2, DVec3};

/// The hand of somebody at a pointer: it follows the pointer as an arm can, high enough above the table, comes down to what it is
/// over, opens on the way to it, and closes around it.
///
/// A pointer has two dimensions, a hand has more. What is added is what eyes and arm of any person add: the height at which a thing
/// stands, the opening that it needs, and how fast a hand can be. It knows no plan and means nothing.
#[derive(Debug, Clone)]
pub struct PointerHand {
    task: Task,
    model: HandModel,
    motion: Option<Motion>,
    held: Option<Held>,
    /// The fingers were to close in the step before.
    pressed: bool,
}

/// What the fingers close around: the hand stays there until they have, wherever the pointer is by then.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Held {
    /// Kind of part.
    kind: usize,
    /// Where the hand took it, m.
    at: DVec3,
    /// For how long the fingers have been closed, s.
    closed: f64,
}

/// How the hand moves.
#[derive(Debug, Clone, Copy)]
struct Motion {
    /// Middle between the finger tips, m, and its velocity, m/s.
    centre: DVec3,
    velocity: DVec3,
    /// Above the table plane, rad.
    pitch: f64,
    /// Thumb to index, m.
    aperture: f64,
    /// How far the index finger is stretched out alone, 0 to 1, and what it points at, m.
    stretched: f64,
    aim: DVec3,
}

/// Where the hand is to be.
#[derive(Debug, Clone, Copy)]
struct Goal {
    centre: DVec3,
    pitch: f64,
    aperture: f64,
    /// What the index finger is to point at, m.
    points_at: Option<DVec3>,
}

/// How closely the hand follows, 1/s: 0.1 s behind a pointer that moves evenly. All values here are chosen by hand where nothing else
/// is said; they are not sensitive.
const STIFFNESS: f64 = 20.0;
/// Most speed, m/s, and acceleration, m/s²: of people's quick reaches over a table.
const MOST_SPEED: f64 = 1.5;
const MOST_ACCELERATION: f64 = 12.0;
/// How fast the wrist turns, rad/s, and the fingers open or close, m/s.
const TURNING: f64 = 5.0;
const FINGER_SPEED: f64 = 0.30;
/// An empty hand on its way is so high above the table, m, and one that carries something so high.
const HOVERS: f64 = 0.09;
const CARRIES: f64 = 0.14;
/// The hand is at a thing when it is so near to its axis, sideways, m, and begins to come down to it from here.
const AT_THING: f64 = 0.04;
const NEAR_THING: f64 = 0.11;
/// The same of a socket, and of the place where parts change hands.
const NEAR_PLACE: f64 = 0.07;
/// Fingers close once the hand is so near to where it is to be, m, and so slow, m/s.
const ARRIVED: (f64, f64) = (0.015, 0.20);
/// A hand lifts what its fingers have been closed around for so long, s: people's loads rise some tenths of a second after contact
/// (Johansson and Westling 1984).
const LIFTS_AFTER: f64 = 0.15;
/// Opening of a hand that is over nothing, m; of fingers that close on nothing; and of a hand that shows a gesture.
const RELAXED: f64 = 0.06;
const CLOSED: f64 = 0.02;
const SHOWN: f64 = 0.10;
/// A hand that points is so far from the shoulder, sideways, m, and so high above the table, m: the arm nearly stretched.
const POINTS_FROM: f64 = 0.52;
const POINTS_ABOVE: f64 = 0.28;
/// A finger is stretched out or folded within this time, s.
const STRETCHES_IN: f64 = 0.25;
/// A hand so near to where it rests lies down, m.
const AT_REST: f64 = 0.08;
/// Highest lift, m.
const MOST_LIFT: f64 = 0.4;

impl PointerHand {
    /// A hand of the person who sits at the task's table.
    pub fn new(task: &Task) -> Self {
        Self {
            task: task.clone(),
            model: HandModel::new(&task.scene),
            motion: None,
            held: None,
            pressed: false,
        }
    }

    /// Moves on by `dt` s, and gives the nine keypoints, m. A hand that was not told of for a while goes on from where it was.
    pub fn step(&mut self, pointer: &Pointer, around: &Surroundings, dt: f64) -> [DVec3; 9] {
        self.grasp_or_let_go(pointer, around);
        let goal = self.goal(pointer, around);
        let rest = self.model.rest();
        let begins = || Motion {
            centre: self.model.centre(&rest),
            velocity: DVec3::ZERO,
            pitch: rest.pitch,
            aperture: rest.aperture,
            stretched: 0.0,
            aim: DVec3::new(pointer.x, pointer.y, self.task.scene.table_height),
        };
        let mut motion = self.motion.unwrap_or_else(begins);
        motion.follow(&goal, dt);
        self.shape_fingers(pointer, &goal, &mut motion, dt);
        self.motion = Some(motion);
        self.keypoints(&motion)
    }

    /// The hand that grasps or rests, the hand that points, or one between them.
    fn keypoints(&self, motion: &Motion) -> [DVec3; 9] {
        let around = self.model.reaching(motion.centre, motion.pitch, motion.aperture);
        if motion.stretched == 0.0 {
            return around;
        }
        let pointing = self.model.pointing(around[KeypointName::Wrist as usize], motion.aim);
        std::array::from_fn(|index| around[index].lerp(pointing[index], motion.stretched))
    }

    /// Who presses over a thing wants it; who lets go of the button lets go of it.
    fn grasp_or_let_go(&mut self, pointer: &Pointer, around: &Surroundings) {
        let pressed_before = std::mem::replace(&mut self.pressed, pointer.pressed);
        let begins = pointer.pressed && !pressed_before;
        if !pointer.pressed {
            self.held = None;
        } else if begins {
            let near = around.nearest(DVec2::new(pointer.x, pointer.y)).filter(|(_, away)| *away < AT_THING);
            self.held = near.map(|(thing, _)| Held { kind: thing.kind, at: thing.centre, closed: 0.0 });
        }
    }

    /// Fingers close around a thing once the hand is there.
    fn shape_fingers(&mut self, pointer: &Pointer, goal: &Goal, motion: &mut Motion, dt: f64) {
        let wanted = match &self.held {
            None if pointer.pressed => CLOSED,
            None => goal.aperture,
            Some(held) if held.closed > 0.0 || motion.is_at(held.at) => self.around(held.kind),
            Some(held) => opening(self.task.kinds[held.kind].width),
        };
        let step = FINGER_SPEED * dt;
        motion.aperture += (wanted - motion.aperture).clamp(-step, step);
        if let Some(held) = &mut self.held
            && motion.aperture <= self.task.kinds[held.kind].width + FINGERS
        {
            held.closed += dt;
        }
    }

    /// Thumb to index around a part of this kind, m.
    fn around(&self, kind: usize) -> f64 {
        self.task.kinds[kind].width + FINGERS
    }

    fn goal(&self, pointer: &Pointer, around: &Surroundings) -> Goal {
        let at = DVec2::new(pointer.x, pointer.y);
        let scene = &self.task.scene;
        let rest = self.model.rest();
        let resting = self.model.centre(&rest);
        let lift = pointer.lift.clamp(0.0, MOST_LIFT);
        let pitch = self.task.grips.get(pointer.grip).map_or(rest.pitch, |grip| grip.pitch);
        if let Some(gesture) = pointer.gesture.and_then(|gesture| self.task.gestures.get(gesture)) {
            let centre = at.extend(scene.handover[2] + lift);
            return Goal { centre, pitch: gesture.pitch, aperture: SHOWN, points_at: None };
        }
        if pointer.pointing {
            let near = around.nearest(at).map_or(at.extend(scene.table_height), |(thing, _)| thing.centre);
            return self.pointing_at(near, lift);
        }
        if let Some(Held { kind, at: taken, closed }) = self.held {
            let carried = || self.carried_to(kind, at, around) + lift * DVec3::Z;
            let centre = if closed < LIFTS_AFTER { taken } else { carried() };
            return Goal { centre, pitch, aperture: self.around(kind), points_at: None };
        }
        if !pointer.pressed && at.distance(resting.truncate()) < AT_REST {
            return Goal { centre: resting, pitch: rest.pitch, aperture: rest.aperture, points_at: None };
        }
        let hover = scene.table_height + HOVERS;
        match around.nearest(at) {
            Some((thing, away)) => {
                let down = ((NEAR_THING - away) / (NEAR_THING - AT_THING)).clamp(0.0, 1.0);
                let centre = if away < AT_THING { thing.centre.truncate() } else { at };
                let height = hover.max(thing.centre.z) * (1.0 - down) + thing.centre.z * down;
                let centre = centre.extend(height + lift);
                Goal { centre, pitch, aperture: opening(thing.width), points_at: None }
            }
            None => Goal { centre: at.extend(hover + lift), pitch, aperture: RELAXED, points_at: None },
        }
    }

    /// A hand that stays back, on the line from the shoulder to what it points at.
    fn pointing_at(&self, place: DVec3, lift: f64) -> Goal {
        let (shoulder, scene) = (DVec3::from(self.task.scene.person_shoulder), &self.task.scene);
        let ahead = (place - shoulder).truncate().normalize_or(DVec2::X);
        let centre = shoulder.truncate() + POINTS_FROM * ahead;
        let centre = centre.extend(scene.table_height + POINTS_ABOVE + lift);
        Goal { centre, pitch: 0.0, aperture: RELAXED, points_at: Some(place) }
    }

    /// Where a hand goes that carries a part of `kind` and points at `at`: over the table, or to a place that is near.
    fn carried_to(&self, kind: usize, at: DVec2, around: &Surroundings) -> DVec3 {
        let scene = &self.task.scene;
        let free = around.sockets.iter().filter(|socket| socket.kind == kind).map(|socket| socket.centre);
        let handover = DVec3::from(scene.handover) + 0.5 * self.task.kinds[kind].shape.height() * DVec3::Z;
        let away = |place: &DVec3| place.truncate().distance(at);
        let places = free.chain([handover]).filter(|place| away(place) < NEAR_PLACE);
        let nearest = places.min_by(|one, other| away(one).total_cmp(&away(other)));
        nearest.unwrap_or_else(|| at.extend(self.lowest_above(at) + CARRIES))
    }

    /// The height of what stands there: the base, or the table.
    fn lowest_above(&self, at: DVec2) -> f64 {
        let scene = &self.task.scene;
        let [x, y, z] = scene.platform;
        let over_base = DVec2::new(x, y).distance(at) < scene.platform_radius + 2.0 * AT_THING;
        if over_base { z + scene.platform_height } else { scene.table_height }
    }
}

/// Thumb to index of a hand that reaches for something of this width, m: it grows by 0.8 mm with each mm of width (Jeannerod 1984;
/// Marteniuk et al. 1990).
fn opening(width: f64) -> f64 {
    0.040 + 0.8 * width + FINGERS
}

impl Motion {
    fn is_at(&self, place: DVec3) -> bool {
        self.centre.distance(place) < ARRIVED.0 && self.velocity.length() < ARRIVED.1
    }

    fn follow(&mut self, goal: &Goal, dt: f64) {
        let wanted = STIFFNESS * (STIFFNESS * (goal.centre - self.centre) - 2.0 * self.velocity);
        self.velocity += wanted.clamp_length_max(MOST_ACCELERATION) * dt;
        self.velocity = self.velocity.clamp_length_max(MOST_SPEED);
        self.centre += self.velocity * dt;
        let stretched = if goal.points_at.is_some() { 1.0 } else { 0.0 };
        self.stretched += (stretched - self.stretched).clamp(-dt / STRETCHES_IN, dt / STRETCHES_IN);
        if let Some(place) = goal.points_at {
            self.aim += (place - self.aim).clamp_length_max(MOST_SPEED * dt);
        }
        let turn = TURNING * dt;
        self.pitch += (goal.pitch - self.pitch).clamp(-turn, turn);
    }
}

impl Surroundings {
    /// The thing that is nearest to a place on the table, sideways, if one is near, and how far away it is.
    fn nearest(&self, at: DVec2) -> Option<(&Thing, f64)> {
        let away = self.things.iter().map(|thing| (thing, thing.centre.truncate().distance(at)));
        let near = away.filter(|(_, away)| *away < NEAR_THING);
        near.min_by(|one, other| one.1.total_cmp(&other.1))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use bytemuck::Zeroable;
    use coact_messages::{HandPoints, Plausible};
    use std::path::Path;

    const FRAME: f64 = 1.0 / 60.0;

    fn task() -> Task {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
        Task::load(&file).unwrap()
    }

    fn aperture(points: &[DVec3; 9]) -> f64 {
        points[KeypointName::ThumbTip as usize].distance(points[KeypointName::IndexTip as usize])
    }

    fn middle(points: &[DVec3; 9]) -> DVec3 {
        points[KeypointName::ThumbTip as usize].midpoint(points[KeypointName::IndexTip as usize])
    }

    fn pointer(at: DVec3, pressed: bool) -> Pointer {
        Pointer { x: at.x, y: at.y, lift: 0.0, pressed, grip: 0, gesture: None, pointing: false }
    }

    /// Follows the pointer for a second, and checks in each frame that an arm can do this.
    fn second(hand: &mut PointerHand, pointer: &Pointer, around: &Surroundings) -> [DVec3; 9] {
        let mut last: Option<[DVec3; 9]> = None;
        for _ in 0..60 {
            let points = hand.step(pointer, around, FRAME);
            let message =
                HandPoints { position: points.map(|point| point.to_array()), ..HandPoints::zeroed() };
            assert_eq!(message.check(), Ok(()));
            if let Some(last) = last {
                assert!(middle(&points).distance(middle(&last)) < MOST_SPEED * FRAME + 1e-3);
            }
            last = Some(points);
        }
        last.unwrap()
    }

    #[test]
    fn it_reaches_opens_closes_carries_and_lets_go() {
        let task = task();
        let mut hand = PointerHand::new(&task);
        let wheel = Thing { kind: 0, centre: DVec3::new(-0.98, 0.02, 0.8125), width: task.kinds[0].width };
        let socket = DVec3::from(task.subgoals[0].socket) + 0.0125 * DVec3::from(task.subgoals[0].axis);
        let around = Surroundings {
            things: vec![wheel],
            sockets: vec![crate::Socket { kind: 0, centre: socket }],
            ..Surroundings::none()
        };
        let free = second(&mut hand, &pointer(DVec3::new(-0.9, 0.5, 0.0), false), &around);
        assert!((middle(&free).z - task.scene.table_height - HOVERS).abs() < 0.005);
        assert!((aperture(&free) - RELAXED).abs() < 0.002);
        // A centimetre aside is near enough: eyes guide the hand.
        let there = wheel.centre + DVec3::new(0.01, 0.0, 0.0);
        let over = second(&mut hand, &pointer(there, false), &around);
        assert!(middle(&over).distance(wheel.centre) < 0.005, "{}", middle(&over));
        assert!(aperture(&over) > wheel.width + FINGERS + 0.015);
        hand.step(&pointer(there, true), &around, FRAME);
        // The pointer goes on at once; the hand first takes what was pressed on.
        let mut frames = 0;
        let closed = loop {
            let points = hand.step(&pointer(DVec3::new(-0.9, 0.2, 0.0), true), &around, FRAME);
            assert!(middle(&points).distance(wheel.centre) < 0.01, "it is lifted before it is held");
            frames += 1;
            if hand.held.unwrap().closed > 0.1 {
                break points;
            }
        };
        assert!((aperture(&closed) - wheel.width - FINGERS).abs() < 0.001 && frames < 30);
        let carried = second(&mut hand, &pointer(DVec3::new(-0.9, 0.2, 0.0), true), &around);
        assert!((middle(&carried).z - task.scene.table_height - CARRIES).abs() < 0.01);
        let placed = second(&mut hand, &pointer(socket + DVec3::new(0.03, -0.02, 0.0), true), &around);
        assert!(middle(&placed).distance(socket) < 0.005, "{}", middle(&placed));
        let mounted = Surroundings { things: vec![Thing { centre: socket, ..wheel }], ..around };
        let open = second(&mut hand, &pointer(socket, false), &mounted);
        assert!(aperture(&open) > wheel.width + FINGERS + 0.012);
    }

    #[test]
    fn fingers_close_when_the_hand_has_come_and_on_nothing_they_close_alone() {
        let task = task();
        let mut hand = PointerHand::new(&task);
        let around = Surroundings::none();
        let far = DVec3::new(-0.7, 0.5, 0.0);
        assert!((aperture(&second(&mut hand, &pointer(far, true), &around)) - CLOSED).abs() < 0.001);
        assert_eq!(hand.held, None);
        second(&mut hand, &pointer(DVec3::new(-0.9, 0.2, 0.0), false), &around);
        let thing = Thing { kind: 0, centre: far.with_z(0.8125), width: task.kinds[0].width };
        let around = Surroundings { things: vec![thing], ..Surroundings::none() };
        let on_the_way = hand.step(&pointer(far, true), &around, FRAME);
        assert!(hand.held.is_some() && aperture(&on_the_way) > RELAXED - 0.01);
        let there = second(&mut hand, &pointer(far, true), &around);
        assert!((aperture(&there) - thing.width - FINGERS).abs() < 0.001);
    }

    #[test]
    fn a_hand_that_points_stays_back_and_its_finger_alone_is_on_the_line_to_the_thing() {
        let task = task();
        let mut hand = PointerHand::new(&task);
        let nut = DVec3::new(-0.36, 0.52, 0.81);
        let around = Surroundings {
            things: vec![Thing { kind: 1, centre: nut, width: task.kinds[1].width }],
            ..Surroundings::none()
        };
        let points = second(&mut hand, &Pointer { pointing: true, ..pointer(nut, false) }, &around);
        let at = |name: KeypointName| points[name as usize];
        let finger = at(KeypointName::IndexTip) - at(KeypointName::IndexKnuckle);
        assert!(finger.angle_between(nut - at(KeypointName::IndexTip)) < 0.01);
        let reach = |name: KeypointName| at(name).distance(at(KeypointName::Wrist));
        assert!(reach(KeypointName::IndexTip) > reach(KeypointName::MiddleTip) + 0.05);
        assert!(at(KeypointName::IndexTip).distance(nut) > 0.3, "it stays on the person's side");
        let relaxed = second(&mut hand, &pointer(DVec3::new(-0.9, 0.2, 0.0), false), &Surroundings::none());
        assert!((aperture(&relaxed) - RELAXED).abs() < 0.002);
    }

    #[test]
    fn a_gesture_is_an_open_hand_where_parts_change_hands_and_the_resting_hand_lies() {
        let task = task();
        let mut hand = PointerHand::new(&task);
        let handover = DVec3::from(task.scene.handover);
        let shown = Pointer { gesture: Some(0), ..pointer(handover, false) };
        let points = second(&mut hand, &shown, &Surroundings::none());
        assert!(aperture(&points) > 0.09 && middle(&points).distance(handover) < 0.01);
        let rest = hand.model.centre(&hand.model.rest());
        let points = second(&mut hand, &pointer(rest, false), &Surroundings::none());
        assert!(middle(&points).distance(rest) < 0.01 && aperture(&points) < 0.04);
    }
}
