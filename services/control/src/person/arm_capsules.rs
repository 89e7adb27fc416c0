use super::BodyPart;
use super::arm_bound::ArmBound;
use coact_messages::{PersonArm, TrackedPoint};
use coact_motion::Capsule;
use coact_period::{cycles, seconds};
use coact_safety::{PersonLimits, StaleLimits};
use nalgebra::Vector3;

/// Head, upper arm, forearm and hand of one side of the person, and what the hand holds, as bounding capsules; how they move, and how
/// far they may be from there. Where between the shoulders the head is nobody sees: it is taken to be over both.
///
/// A part of the body that is not seen is where it was last, and grows at the speed of walking people and reaching hands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ArmCapsules {
    /// Upper arm, forearm, hand.
    limbs: [BodyPart; 3],
    /// What is in the hand: its index among the parts that were seen, and a capsule around it.
    held: Option<(usize, BodyPart)>,
    head: BodyPart,
}

/// Shorter than this, a forearm has no direction, m.
const SHORTEST: f64 = 1e-6;

impl ArmCapsules {
    /// Around the arm that perception estimated `since` cycles ago, as it was seen last; none when it never was, or when its numbers
    /// are not finite. A hand whose end was never seen goes on along the forearm.
    pub fn of(arm: &PersonArm, since: u64, limits: &PersonLimits, stale: &StaleLimits) -> Option<Self> {
        let points = arm.points();
        let mut numbers = points.iter().flat_map(|point| point.position.iter().chain(&point.velocity));
        if arm.age == u64::MAX || !numbers.all(|number| number.is_finite()) {
            return None;
        }
        // A joint that was never seen is put where the others suggest: it is as old as they are.
        let [shoulder, elbow, wrist, fingertip] = points.map(|point| {
            let age = if point.age == u64::MAX { arm.age } else { point.age };
            later(&TrackedPoint { age, ..*point }, since, cycles(stale.hand_after))
        });
        let part = |from: &TrackedPoint, to: &TrackedPoint| BodyPart::between(from, to, limits, stale);
        let [mut upper_arm, mut forearm, mut hand] =
            [part(&shoulder, &elbow), part(&elbow, &wrist), part(&wrist, &fingertip)];
        if arm.fingertip.age == u64::MAX {
            let line = forearm.now.end - forearm.now.start;
            let along = line.try_normalize(SHORTEST).unwrap_or_else(Vector3::zeros);
            hand.now.end = hand.now.start + limits.hand_length * along;
        }
        for (limb, radius) in [&mut upper_arm, &mut forearm, &mut hand].into_iter().zip(limits.radii) {
            limb.now.radius = radius;
        }
        let is_seen = |joint: &TrackedPoint| joint.age <= cycles(stale.hand_after);
        // What is not seen is not farther from the nearest joint that is than the arm goes on from there.
        let (walks, reaches) = (limits.walking_speed, limits.hand_speed);
        let below_elbow = limits.forearm_reach + limits.hand_reach;
        let goes_on: [&[(&TrackedPoint, f64, f64)]; 3] = [
            &[(&shoulder, limits.upper_arm_reach, walks)],
            &[
                (&wrist, limits.forearm_reach, reaches),
                (&elbow, limits.forearm_reach, reaches),
                (&shoulder, limits.reach, walks),
            ],
            &[
                (&wrist, limits.hand_reach, reaches),
                (&elbow, below_elbow, reaches),
                (&shoulder, limits.reach, walks),
            ],
        ];
        let limbs = [&mut upper_arm, &mut forearm, &mut hand].into_iter().zip(goes_on);
        for (limb, joints) in limbs.filter(|(limb, _)| !limb.is_seen) {
            let seen = joints.iter().find(|(joint, ..)| is_seen(joint));
            limb.bound =
                seen.map(|(joint, long, most)| ArmBound::of(joint, (*long, *most), &limb.now, limits));
        }
        // The robot's fingers reach around a part to the wrist, where the forearm ends.
        (forearm.hands_over, hand.hands_over) = (true, true);
        let mut head = part(&shoulder, &shoulder);
        head.now.radius = limits.head_radius;
        head.now.end += limits.head_height * Vector3::z();
        head.growth.most_speed = limits.walking_speed.max(head.speed);
        Some(Self { limbs: [upper_arm, forearm, hand], held: None, head })
    }

    /// The same with whichever of these parts is nearest to the hand in it, if it is nearer than `within` m. Each part: its index, a
    /// capsule around where it was seen last, and for how long that is ago, s. It moves along with the wrist.
    pub fn holding(mut self, seen: impl Iterator<Item = (usize, Capsule, f64)>, within: f64) -> Self {
        let [.., hand] = self.limbs;
        let parts = seen.map(|(index, part, ago)| (index, hand.carrying(part, ago, within)));
        let gaps = parts.map(|(index, part)| (hand.now.distance(&part.now), (index, part)));
        let nearest = gaps.filter(|(gap, _)| *gap < within).min_by(|one, other| one.0.total_cmp(&other.0));
        self.held = nearest.map(|(_, part)| part);
        self
    }

    /// The same of an arm whose hand hands nothing over.
    pub fn keeping_apart(mut self) -> Self {
        self.limbs.iter_mut().for_each(|limb| limb.hands_over = false);
        self
    }

    /// Index, among the parts that were seen, of what is in the hand.
    pub fn held(&self) -> Option<usize> {
        self.held.map(|(index, _)| index)
    }

    /// Upper arm, forearm, hand and what it holds `ahead` s from now.
    pub fn after(&self, ahead: f64) -> impl Iterator<Item = Capsule> + use<> {
        let held = self.held.map(|(_, part)| part);
        self.limbs.into_iter().chain(held).map(move |part| part.after(ahead))
    }

    /// All that is known of her body.
    pub fn parts(&self) -> impl Iterator<Item = &BodyPart> {
        self.limbs.iter().chain(self.held.as_ref().map(|(_, part)| part)).chain([&self.head])
    }
}

/// A joint so many cycles later: nobody has seen it since, and it has gone on as it moved, unless it is where it was seen last, more than
/// `seen_within` cycles ago.
fn later(joint: &TrackedPoint, since: u64, seen_within: u64) -> TrackedPoint {
    let age = joint.age.saturating_add(since);
    let time = if age <= seen_within { seconds(since) } else { 0.0 };
    let position = std::array::from_fn(|axis| joint.position[axis] + joint.velocity[axis] * time);
    TrackedPoint { position, age, ..*joint }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::person::growth::Growth;
    use coact_safety::SafetyLimits;
    use nalgebra::Point3;

    fn safety_limits() -> SafetyLimits {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config/safety.toml");
        SafetyLimits::load(file.as_ref()).unwrap()
    }

    fn point() -> TrackedPoint {
        bytemuck::Zeroable::zeroed()
    }

    /// A hand that was seen `age` cycles ago at this speed, m/s.
    fn hand(speed: f64, age: u64) -> BodyPart {
        let SafetyLimits { person, stale, .. } = safety_limits();
        let point = TrackedPoint { velocity: [speed, 0.0, 0.0], age, ..point() };
        BodyPart::between(&point, &point, &person, &stale)
    }

    #[test]
    fn a_hand_has_gained_speed_since_its_velocity_was_measured_and_gains_more() {
        let hand = hand(0.5, 30);
        let Growth { acceleration, velocity_lag: lag, .. } = hand.growth;
        let since = 0.03 + 0.1;
        // Of what it was faster by when it was seen, and of what it may have become faster by since then.
        let (before, after) = (acceleration * lag * since, 0.5 * acceleration * since * since);
        assert!(lag > 0.0 && (hand.growth(0.1) - before - after).abs() < 1e-12, "{}", hand.growth(0.1));
    }

    #[test]
    fn what_was_estimated_some_cycles_ago_has_gone_on_and_grown() {
        let (limits, coming) = (safety_limits(), TrackedPoint { velocity: [0.0, 1.0, 0.0], ..point() });
        let arm = PersonArm {
            shoulder: coming,
            elbow: coming,
            wrist: coming,
            fingertip: coming,
            ..bytemuck::Zeroable::zeroed()
        };
        let hand = |since| {
            let person = ArmCapsules::of(&arm, since, &limits.person, &limits.stale).unwrap();
            let [.., hand] = person.limbs;
            hand
        };
        let (now, later) = (hand(0), hand(40));
        assert!((later.now.end.y - now.now.end.y - 0.04).abs() < 1e-12);
        assert!((later.growth(0.1) - now.growth(0.14)).abs() < 1e-12 && later.growth(0.1) > now.growth(0.1));
        assert!(
            now.is_seen && !hand(cycles(limits.stale.hand_after) + 1).is_seen,
            "nobody has seen it since"
        );
    }

    #[test]
    fn a_part_that_a_frame_missed_has_gone_on_with_the_hand() {
        let limits = safety_limits();
        let moving = |x| TrackedPoint { position: [x, 0.0, 0.0], velocity: [1.0, 0.0, 0.0], ..point() };
        let arm = PersonArm {
            shoulder: moving(-0.6),
            elbow: moving(-0.3),
            wrist: moving(0.0),
            fingertip: moving(0.2),
            ..bytemuck::Zeroable::zeroed()
        };
        let part = |x: f64, ago| {
            let at = Point3::new(x, 0.0, 0.0);
            (0, Capsule { start: at, end: at, radius: 0.02 }, ago)
        };
        let held = |part| {
            let person = ArmCapsules::of(&arm, 0, &limits.person, &limits.stale).unwrap();
            person
                .holding([part].into_iter(), limits.person.carried_within)
                .held
                .map(|(_, held)| held.now.start.x)
        };
        // Beyond what the hand may have in it; and as near as what was seen farther back while the hand was, too.
        let ahead = 0.2 + limits.person.radii[2] + 0.02 + limits.person.carried_within + 0.01;
        assert_eq!(held(part(ahead, 0.0)), None);
        let before = held(part(ahead - 0.05, 0.0)).unwrap();
        assert!((held(part(ahead - 0.1, 0.05)).unwrap() - before).abs() < 1e-12);
    }

    #[test]
    fn fingers_that_something_hides_are_near_the_wrist_that_is_seen() {
        let limits = safety_limits();
        let at = |x, age| TrackedPoint { position: [x, 0.0, 0.0], age, still: 10_000, ..point() };
        let beside = |x: f64| {
            let at = Point3::new(x, 0.0, 0.0);
            Capsule { start: at, end: at, radius: 0.05 }
        };
        for (wrist_age, stays) in [(10, true), (10_000, false)] {
            let arm = PersonArm {
                shoulder: at(-0.3, 10),
                elbow: at(-0.15, wrist_age),
                wrist: at(0.0, wrist_age),
                fingertip: at(0.18, 10_000),
                ..bytemuck::Zeroable::zeroed()
            };
            let [.., hand] = ArmCapsules::of(&arm, 0, &limits.person, &limits.stale).unwrap().limbs;
            assert!(!hand.is_seen && hand.growth(0.2) > 1.0, "of itself it may be anywhere");
            assert_eq!(hand.is_bound_away_from(&beside(0.55), 0.05, 0.2), stays, "{wrist_age}");
            assert!(!hand.is_bound_away_from(&beside(0.3), 0.05, 0.2), "where it may be it is");
            // A bar of which one end is in the fingers reaches farther than they do.
            let bar = Capsule {
                start: Point3::new(0.18, 0.0, 0.0),
                end: Point3::new(0.18, 0.2, 0.0),
                radius: 0.02,
            };
            let held = hand.carrying(bar, 0.0, limits.person.carried_within);
            assert!(!held.is_bound_away_from(&beside(0.55), 0.05, 0.2));
            assert_eq!(held.is_bound_away_from(&beside(0.9), 0.05, 0.2), stays, "{wrist_age}");
        }
    }

    #[test]
    fn an_elbow_that_something_hides_is_near_the_shoulder_and_near_the_wrist() {
        let limits = safety_limits();
        let at = |x, age| TrackedPoint { position: [x, 0.0, 0.0], age, still: 10_000, ..point() };
        let arm = |ages: [u64; 4]| {
            let [shoulder, elbow, wrist, fingertip] =
                [(-0.3, ages[0]), (-0.15, ages[1]), (0.0, ages[2]), (0.18, ages[3])]
                    .map(|(x, age)| at(x, age));
            let arm = PersonArm { shoulder, elbow, wrist, fingertip, ..bytemuck::Zeroable::zeroed() };
            ArmCapsules::of(&arm, 0, &limits.person, &limits.stale).unwrap().limbs
        };
        let away_from = |limb: &BodyPart, x: f64| {
            let at = Point3::new(x, 0.0, 0.0);
            let robot = Capsule { start: at, end: at, radius: 0.05 };
            limb.is_bound_away_from(&robot, 0.05, 0.2)
        };
        let (seen, hidden) = (10, 10_000);
        // Somebody at arm's length of the shoulder: each limb may be near what it hangs on, not where the whole arm reaches.
        let [upper_arm, forearm, hand] = arm([seen, hidden, seen, seen]);
        assert!(hand.is_seen && !upper_arm.is_seen && !forearm.is_seen);
        assert!(away_from(&upper_arm, 0.4) && !away_from(&upper_arm, 0.15));
        assert!(away_from(&forearm, 0.6) && !away_from(&forearm, 0.35));
        // Of a hand that only its elbow tells of, as far as forearm and hand reach.
        let [_, forearm, hand] = arm([hidden, seen, hidden, hidden]);
        assert!(away_from(&forearm, 0.45) && !away_from(&forearm, 0.2));
        assert!(away_from(&hand, 0.7) && !away_from(&hand, 0.5));
        // Of an arm of which only the shoulder is seen, as far as it all reaches; of one that nobody sees, nothing is known.
        let [_, forearm, hand] = arm([seen, hidden, hidden, hidden]);
        assert!([forearm, hand].iter().all(|limb| away_from(limb, 0.8) && !away_from(limb, 0.55)));
        assert!(arm([hidden; 4]).iter().all(|limb| !away_from(limb, 5.0)));
    }

    #[test]
    fn nothing_grows_faster_than_hands_are_and_what_is_not_seen_does_so() {
        for (speed, age) in [(0.0, 10), (0.3, 100), (1.5, 30), (3.0, 150)] {
            let (hand, since) = (hand(speed, age), seconds(age) + 0.3);
            assert!(hand.growth(0.3) <= hand.growth.most_speed * since + 1e-12, "{speed} {age}");
        }
        let unseen = hand(0.5, 151);
        assert!(!unseen.is_seen && (unseen.growth(0.3) - 2.0 * 0.451).abs() < 1e-9, "{}", unseen.growth(0.3));
    }
}
