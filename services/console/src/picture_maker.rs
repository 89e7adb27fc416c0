use crate::numbers::Numbers;
use crate::{Glimpse, Picture, Seen};
use coact_joint_task::{Act, NetworkPlan, Task};
use coact_messages::{
    ARM_JOINTS, ArmSide, Command, DriveReport, FieldFrame, HoldReason, LayerKind, NONE, Percept,
    SensorSample, Sighting,
};
use coact_motion::{Capsule, CollisionModel, Mechanism, Solid};
use coact_period::seconds;
use coact_robot::{HAND_JOINTS, Knot, Robot, RobotError, state_at};
use coact_safety::PersonLimits;
use coact_seen_parts::SeenParts;
use nalgebra::{Point3, Quaternion, UnitQuaternion, Vector3};

/// Makes pictures of the newest messages. Their numbers, section after section (m, rad, ms; world frame):
///
/// 1. each form of the robot, as [`forms`](PictureMaker::forms) has them: place, quaternion x y z w;
/// 2. each part that is seen, or was and may still be there: kind, place, quaternion x y z w, who holds it (0 nobody, 1 the robot, 2 the person,
///    3 who knows: something is before it); -1 for none;
/// 3. the nine keypoints of the right arm, then of the left one, as measured: place, confidence;
/// 4. shoulder, elbow, wrist and finger tip of both as perceived: place, radius within which it may be, age;
/// 5. the same four of both as they truly are;
/// 6. the hand's planned way from here on: [`PictureMaker::WAY`] places;
/// 7. where robot and person are nearest to each other: a place on each, and the distance;
/// 8. where the person's hand is expected, and the signal of the goal that is inferred;
/// 9. the [`PictureMaker::WARMEST`] sites of the destination field that are most active: x, y, activity; none below its resting level's half;
/// 10. twelve numbers: speed override, declared handover, phase, action (-1: none), stopped by an supervisor, aperture of the hand,
///     speed of its tip, speed of the robot's hand, cycle of the person's last onset, whether the person is not seen, two reserved;
/// 11. each population: signal, highest activity of its sites, cycle since which its peak stands (0: none);
/// 12. the activity of each site.
#[derive(Debug)]
pub struct PictureMaker {
    task: Task,
    plan: NetworkPlan,
    robot: Robot,
    mechanism: Mechanism,
    radii: [f64; 3],
    hand: ShapedHand,
    parts: SeenParts,
    /// Cycle and place of the robot's hand in the picture before.
    last_hand: Option<(u64, Point3<f64>)>,
}

/// The robot's forms with the fingers as they were last.
#[derive(Debug)]
struct ShapedHand {
    fingers: [f64; HAND_JOINTS],
    model: CollisionModel,
}

/// Fingers that have moved by less than this are drawn as before, rad: nobody sees it.
const FINGERS_MOVED: f64 = 0.01;
/// A part that is held is not farther than this from the hand that holds it, m.
const HELD_WITHIN: f64 = 0.12;
/// Above this, somebody holds a part, or a goal is inferred: the middle between not at all and surely.
const SURE: f64 = 0.5;
/// Deviations beyond which hardly anything is, for the eye.
const DEVIATIONS: f64 = 2.0;

impl PictureMaker {
    /// Places of the planned way.
    pub const WAY: usize = 24;
    /// Sites of the destination field: some peaks.
    pub const WARMEST: usize = 64;

    /// For runs of this task with this robot, beside a person who is taken to be so large.
    ///
    /// # Errors
    /// The robot's geometry cannot be used.
    pub fn new(
        task: Task,
        plan: NetworkPlan,
        robot: Robot,
        person: &PersonLimits,
    ) -> Result<Self, RobotError> {
        let mechanism = Mechanism::of(&robot)?;
        let fingers = [0.0; HAND_JOINTS];
        let hand = ShapedHand { fingers, model: mechanism.with_fingers(&robot.hand, &fingers)? };
        Ok(Self {
            task,
            plan,
            robot,
            mechanism,
            radii: person.radii,
            hand,
            parts: SeenParts::none(),
            last_hand: None,
        })
    }

    /// The task.
    pub fn task(&self) -> &Task {
        &self.task
    }

    /// Its network.
    pub fn plan(&self) -> &NetworkPlan {
        &self.plan
    }

    /// The forms that the robot is made of, as its file has them.
    pub fn forms(&self) -> impl ExactSizeIterator<Item = &Solid> {
        self.hand.model.links().iter().map(|link| &link.solid)
    }

    /// How many numbers of a picture come before those of the truth.
    #[cfg(test)]
    pub(crate) fn numbers_before_truth(&self) -> usize {
        self.forms().len() * 7 + self.task.parts.len() * 9 + 2 * (9 * 4 + 4 * 5)
    }

    /// What these messages show; none while there are none.
    pub fn glimpse(&mut self, seen: &Seen) -> Option<Glimpse> {
        let cycle = seen.cycle()?;
        let mut numbers = Numbers::default();
        let links = seen.sample.map(|sample| self.draw_robot(sample, &mut numbers)).unwrap_or_default();
        numbers.unknown((self.forms().len() - links.len()) * 7);
        self.draw_parts(seen, &mut numbers);
        self.draw_person(seen, &mut numbers);
        self.draw_way(seen.command, &mut numbers);
        self.draw_nearest(&links, seen.percept, &mut numbers);
        self.draw_expected(seen, &mut numbers);
        draw_destinations(seen.frame, &mut numbers);
        self.draw_state(cycle, seen, &mut numbers);
        let sites = self.draw_network(seen.frame, &mut numbers);
        let (signals, since) =
            seen.frame.map(|frame| self.explaining(frame, seen.percept)).unwrap_or_default();
        Some(Glimpse { picture: Picture::new(cycle, &numbers.0, &sites), signals, since })
    }

    /// Draws the robot, the fingers as they stand, and gives the capsules around its forms.
    fn draw_robot(&mut self, sample: &SensorSample, numbers: &mut Numbers) -> Vec<Capsule> {
        let (arm, hand) = sample.joints.position.split_at(ARM_JOINTS);
        let fingers: [f64; HAND_JOINTS] = std::array::from_fn(|joint| hand[joint]);
        let moved =
            fingers.iter().zip(self.hand.fingers).any(|(now, then)| (now - then).abs() > FINGERS_MOVED);
        // Angles that no hand can have are not drawn: the old ones are.
        if moved && let Ok(model) = self.mechanism.with_fingers(&self.robot.hand, &fingers) {
            self.hand = ShapedHand { fingers, model };
        }
        let (model, posture) = (&self.hand.model, std::array::from_fn(|joint| arm[joint]));
        for place in model.places(&self.mechanism, &posture) {
            numbers.extend(place.translation.vector.iter().chain(place.rotation.coords.iter()));
        }
        model.bounding_capsules(&self.mechanism, &posture)
    }

    fn draw_parts(&mut self, seen: &Seen, numbers: &mut Numbers) {
        seen.sample.into_iter().for_each(|sample| self.parts.see(&sample.scene, &self.task));
        let count = self.parts.all().len().min(self.task.parts.len());
        for (part, cycle) in self.parts.with_cycles().take(count) {
            numbers.push(f64::from(part.kind));
            numbers.extend(part.position.iter().chain(&part.orientation));
            let covered = self.parts.is_covered_since(cycle);
            numbers.push(if covered { 3.0 } else { self.holder(part, seen) });
        }
        for _ in count..self.task.parts.len() {
            numbers.push(-1.0);
            numbers.unknown(8);
        }
    }

    /// Who holds a part that is seen: 0 nobody, 1 the robot, 2 the person.
    fn holder(&self, part: &Sighting, seen: &Seen) -> f64 {
        let (Some(percept), Some(sample), Some(kind)) =
            (seen.percept, seen.sample, self.task.kinds.get(part.kind as usize))
        else {
            return 0.0;
        };
        let [x, y, z, w] = part.orientation;
        let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
        let centre = Point3::from(part.position) + turn * Vector3::z() * (0.5 * kind.shape.height());
        let robot = self.robot.grasp_point(&sample.joints.position);
        let person = Point3::from(percept.acting_arm().fingertip.position);
        let index = part.kind as usize;
        match () {
            () if percept.robot_holds[index] > SURE && (robot - centre).norm() < HELD_WITHIN => 1.0,
            () if percept.person_holds[index] > SURE && (person - centre).norm() < HELD_WITHIN => 2.0,
            () => 0.0,
        }
    }

    fn draw_person(&self, seen: &Seen, numbers: &mut Numbers) {
        for side in ArmSide::BOTH.map(|side| side as usize) {
            match seen.sample {
                Some(sample) => sample.hands[side].keypoints.iter().for_each(|keypoint| {
                    numbers.extend(&keypoint.position);
                    numbers.push(keypoint.confidence);
                }),
                None => numbers.unknown(9 * 4),
            }
        }
        for side in ArmSide::BOTH.map(|side| side as usize) {
            match seen.percept.map(|percept| &percept.arms[side]).filter(|arm| arm.age != u64::MAX) {
                Some(arm) => arm.points().iter().for_each(|point| {
                    numbers.extend(&point.position);
                    numbers.push(DEVIATIONS * point.deviation);
                    numbers.push(point.age as f64);
                }),
                None => numbers.unknown(4 * 5),
            }
        }
        match seen.truth {
            Some(truth) => numbers.extend(truth.arms.as_flattened().as_flattened()),
            None => numbers.unknown(2 * 4 * 3),
        }
    }

    fn draw_way(&self, command: Option<&Command>, numbers: &mut Numbers) {
        let path = command.map(|command| &command.path).filter(|path| path.followed == 1);
        let Some(path) = path.filter(|path| (1..=path.knots.len() as u64).contains(&path.count)) else {
            return numbers.unknown(Self::WAY * 3);
        };
        let knots: &[Knot] = bytemuck::cast_slice(&path.knots[..path.count as usize]);
        let end = knots.last().map_or(0.0, |knot| knot.t);
        let left = end - path.elapsed;
        if left <= 0.0 {
            return numbers.unknown(Self::WAY * 3);
        }
        for step in 0..Self::WAY {
            let t = path.elapsed + left * step as f64 / (Self::WAY - 1) as f64;
            let posture = state_at(knots, t).map(|state| state.position);
            let place = self.robot.grasp_point(&posture);
            numbers.extend(place.iter());
        }
    }

    fn draw_nearest(&self, links: &[Capsule], percept: Option<&Percept>, numbers: &mut Numbers) {
        let limbs = percept.map(|percept| self.limbs(percept)).unwrap_or_default();
        let pairs = links.iter().flat_map(|link| limbs.iter().map(move |limb| (link, limb)));
        let nearest = pairs.min_by(|one, other| one.0.distance(one.1).total_cmp(&other.0.distance(other.1)));
        numbers.extend_or_unknown(nearest.map(|(link, limb)| {
            let (on_link, on_limb) = link.nearest(limb);
            let (from, to) = (on_link.coords, on_limb.coords);
            [from.x, from.y, from.z, to.x, to.y, to.z, link.distance(limb)]
        }));
    }

    /// Around both arms, as far as they were ever seen.
    fn limbs(&self, percept: &Percept) -> Vec<Capsule> {
        let limb = |(ends, radius): (&[Point3<f64>], f64)| Capsule { start: ends[0], end: ends[1], radius };
        let known = percept.arms.iter().filter(|arm| arm.age != u64::MAX);
        let points = known.map(|arm| arm.points().map(|point| Point3::from(point.position)));
        points.flat_map(|points| points.windows(2).zip(self.radii).map(limb).collect::<Vec<_>>()).collect()
    }

    /// Where the person is expected: at the part that the strongest inferred goal is about, or where parts change hands when she
    /// asks for one.
    fn draw_expected(&self, seen: &Seen, numbers: &mut Numbers) {
        let expected = seen.frame.zip(seen.percept).and_then(|(frame, percept)| {
            let goals = frame.populations(LayerKind::Intention);
            let standing = goals.filter(|population| frame.signal[*population] > SURE);
            let strongest =
                standing.max_by(|one, other| frame.signal[*one].total_cmp(&frame.signal[*other]))?;
            let chain = &self.task.chains[self.plan.populations.get(strongest)?.chain_index?];
            let [x, y, z] = match chain.act {
                Act::Grasp { .. } => percept.workspace[chain.from.index()].position[chain.kind],
                _ => self.task.scene.handover,
            };
            Some([x, y, z, frame.signal[strongest]])
        });
        numbers.extend_or_unknown(expected);
    }

    fn draw_state(&mut self, cycle: u64, seen: &Seen, numbers: &mut Numbers) {
        match seen.command {
            Some(command) => {
                let action = if command.action == NONE { -1.0 } else { f64::from(command.action) };
                let handover = f64::from(u8::from(command.handover != 0));
                numbers.extend(&[command.speed_override, handover, f64::from(command.phase), action]);
            }
            None => numbers.unknown(4),
        }
        let stopped = |drive: &DriveReport| f64::from(u8::from(drive.hold == HoldReason::Stopped as u32));
        numbers.push(seen.sample.map_or(f64::NAN, |sample| stopped(&sample.drive)));
        numbers.push(seen.percept.map_or(f64::NAN, |percept| percept.hand.aperture));
        let tip = |percept: &Percept| Vector3::from(percept.acting_arm().fingertip.velocity).norm();
        numbers.push(seen.percept.map_or(f64::NAN, tip));
        let hand = seen.sample.map(|sample| self.robot.grasp_point(&sample.joints.position));
        numbers.push(self.speed_of_hand(cycle, hand));
        let onset = |percept: &Percept| match percept.hand.reaching {
            1 => percept.header.cycle.saturating_sub(percept.hand.since_onset) as f64,
            _ => f64::NAN,
        };
        numbers.push(seen.percept.map_or(f64::NAN, onset));
        numbers.push(
            seen.percept.map_or(1.0, |percept| f64::from(u8::from(!percept.acting_arm().is_tracked()))),
        );
        numbers.unknown(2);
    }

    /// Speed of the robot's hand since the picture before, m/s.
    fn speed_of_hand(&mut self, cycle: u64, hand: Option<Point3<f64>>) -> f64 {
        let hand = hand.map(|hand| (cycle, hand));
        let (Some((then, from)), Some((now, to))) = (std::mem::replace(&mut self.last_hand, hand), hand)
        else {
            return f64::NAN;
        };
        if now > then { (to - from).norm() / seconds(now - then) } else { f64::NAN }
    }

    /// Adds the populations, and gives the activity of all sites.
    fn draw_network(&self, frame: Option<&FieldFrame>, numbers: &mut Numbers) -> Vec<f32> {
        let (populations, each) = (self.plan.populations.len(), self.plan.sites_per_population);
        let Some(frame) = frame else {
            numbers.unknown(3 * populations);
            return Vec::new();
        };
        for (population, sites) in frame.activity.chunks(each).take(populations).enumerate() {
            let highest = sites.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            numbers.extend(&[frame.signal[population], highest, frame.since[population] as f64]);
        }
        frame.activity[..populations * each].iter().map(|activity| *activity as f32).collect()
    }

    /// What explains the populations of a frame.
    fn explaining(&self, frame: &FieldFrame, percept: Option<&Percept>) -> (Vec<f32>, Vec<u64>) {
        let signals = coact_fields::signals(&self.plan, frame, percept);
        let signals = signals.iter().map(|signal| *signal as f32).collect();
        (signals, frame.since[..self.plan.populations.len()].to_vec())
    }
}

/// Where the destination field is active.
fn draw_destinations(frame: Option<&FieldFrame>, numbers: &mut Numbers) {
    let Some(frame) = frame else { return numbers.unknown(3 * PictureMaker::WARMEST) };
    let sites = &frame.destination[..frame.table.used()];
    let resting = sites.iter().copied().fold(f64::INFINITY, f64::min);
    let active = sites.iter().enumerate().filter(|(_, activity)| **activity > 0.5 * resting);
    let mut active: Vec<(usize, f64)> = active.map(|(site, activity)| (site, *activity)).collect();
    active.sort_by(|one, other| other.1.total_cmp(&one.1));
    active.truncate(PictureMaker::WARMEST);
    for (site, activity) in &active {
        let [x, y] = frame.table.place(*site);
        numbers.extend(&[x, y, *activity]);
    }
    numbers.unknown(3 * (PictureMaker::WARMEST - active.len()));
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use coact_messages::{SiteGrid, Surface};
    use std::path::Path;

    fn maker() -> PictureMaker {
        let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
        let (task, plan) = NetworkPlan::load(&shipped.join("tasks/toy-vehicle.toml")).unwrap();
        let robot = Robot::load(&shipped.join("robots/aros.toml")).unwrap();
        let limits = coact_safety::SafetyLimits::load(&shipped.join("safety.toml")).unwrap();
        PictureMaker::new(task, plan, robot, &limits.person).unwrap()
    }

    fn numbers(picture: &Picture) -> Vec<f32> {
        picture.bytes[16..].chunks(4).map(|four| f32::from_le_bytes(four.try_into().unwrap())).collect()
    }

    #[test]
    fn what_is_not_known_has_its_place_as_well() {
        let mut maker = maker();
        assert!(maker.glimpse(&Seen::default()).is_none());
        let (links, parts) = (maker.forms().len() * 7, maker.task.parts.len() * 9);
        let populations = maker.plan.populations.len();
        let person = 2 * (9 * 4 + 4 * 5 + 4 * 3);
        let mut frame: Box<FieldFrame> = bytemuck::zeroed_box();
        frame.header.cycle = 70;
        frame.signal[2] = 1.0;
        let glimpse = maker.glimpse(&Seen { frame: Some(&frame), ..Seen::default() }).unwrap();
        let sites = populations * maker.plan.sites_per_population;
        let drawn = numbers(&glimpse.picture);
        let before = links + parts + person + PictureMaker::WAY * 3 + 7 + 4 + 3 * PictureMaker::WARMEST + 12;
        assert_eq!(drawn.len(), before + 3 * populations + sites);
        assert_eq!(glimpse.picture.cycle, 70);
        assert_eq!(drawn[before + 3 * 2], 1.0);
        assert!(drawn[..links].iter().all(|number| number.is_nan()));
        assert_eq!(glimpse.signals.len(), populations + maker.plan.channels.len());
    }

    #[test]
    fn the_robot_is_drawn_where_its_joints_are_and_a_part_where_it_is_seen() {
        let mut maker = maker();
        let mut sample: Box<SensorSample> = bytemuck::zeroed_box();
        sample.joints.position[..7].copy_from_slice(&maker.robot.park);
        sample.scene.sightings = 1;
        sample.scene.captured_cycle = 33;
        sample.scene.sighting[0] = Sighting {
            kind: 1,
            position: [-0.4, 0.5, 0.8],
            orientation: [0.0, 0.0, 0.0, 1.0],
            confidence: 1.0,
            ..bytemuck::Zeroable::zeroed()
        };
        let drawn =
            numbers(&maker.glimpse(&Seen { sample: Some(&sample), ..Seen::default() }).unwrap().picture);
        let links = maker.forms().len();
        let palm = maker.robot.palm(&sample.joints.position);
        // The URDF's palm: a box of 10, 9 and 8 cm, its middle 1 cm out of the palm.
        let is_palm = |form: &Solid| *form == Solid::Box(Vector3::new(0.10, 0.09, 0.08));
        let index = maker.forms().position(is_palm).unwrap();
        let at = |index: usize| f64::from(drawn[index]);
        let place = Point3::new(at(index * 7), at(index * 7 + 1), at(index * 7 + 2));
        let middle = palm * Point3::new(0.0, 0.0, 0.01);
        assert!((place - middle).norm() < 1e-6, "{place} is not {middle}");
        let turn = palm.rotation.coords.map(|value| value as f32);
        let drawn_turn = &drawn[index * 7 + 3..][..4];
        let same = drawn_turn.iter().zip(turn.iter()).map(|(one, other)| one * other).sum::<f32>().abs();
        assert!((same - 1.0).abs() < 1e-5, "{drawn_turn:?} is not {turn}");
        let part = &drawn[links * 7..][..9];
        assert_eq!(part, [1.0, -0.4, 0.5, 0.8, 0.0, 0.0, 0.0, 1.0, 0.0]);
        assert_eq!(drawn[links * 7 + 9], -1.0);
        // It stays for some frames, and something is before it then.
        for cycle in [66, 99] {
            sample.scene.captured_cycle = cycle;
            maker.glimpse(&Seen { sample: Some(&sample), ..Seen::default() }).unwrap();
        }
        let Surface { grid, level, height } = &mut sample.scene.surface;
        let scene = &maker.task.scene;
        (*grid, *level) =
            (SiteGrid { first: [-1.5, -0.5], spacing: [0.04; 2], sites: [60, 60] }, scene.table_height);
        height.fill(30);
        (sample.scene.sightings, sample.scene.captured_cycle) = (0, 99 + 501);
        let seen = Seen { sample: Some(&sample), ..Seen::default() };
        let drawn = numbers(&maker.glimpse(&seen).unwrap().picture);
        assert_eq!(drawn[links * 7..][..9], [1.0, -0.4, 0.5, 0.8, 0.0, 0.0, 0.0, 1.0, 3.0]);
    }
}
