use crate::braking_path::{BrakingPath, BrakingPoint};
use crate::moving_fingers::MovingFingers;
use crate::person::{BodyPart, PersonCapsules};
use crate::robot::RobotModel;
use crate::state::ControlState;
use coact_motion::{Capsule, Mechanism, MovingCapsules};
use coact_robot::{HAND_JOINTS, Posture, RobotError};
use coact_safety::GuardLimits;

/// Keeps the robot, with what it holds, clear of the person: says whether the arm may go on for another cycle.
///
/// It may, if braking along its path after that cycle keeps the protective separation from all that the person may reach
/// meanwhile, or closes nothing by its own motion that is nearer; what is beside the person moves slowly. So the arm can always
/// be stopped in time: what was found admissible in the last cycle is to brake from there.
#[derive(Debug)]
pub(crate) struct Guard {
    limits: GuardLimits,
    mechanism: Mechanism,
    capsules: MovingCapsules,
    /// Capsules of the hand, and of what it holds, in the frame of the arm's last joint: as it is now, and as it would be.
    hand: Vec<Capsule>,
    next_hand: Vec<Capsule>,
    /// Capsules of the moving links now, at the start of a braking path, at one of its points, and at the point before.
    now: Vec<Capsule>,
    start: Vec<Capsule>,
    links: Vec<Capsule>,
    before: Vec<Capsule>,
}

/// What moves along a trajectory.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Moving<'a> {
    pub state: &'a ControlState,
    /// Where the arm is now, rad.
    pub posture: Posture,
}

/// How much nearer the arm may come than is computed, m: its braking differs a little, a driven arm is behind its setpoints, and of
/// joints that rest 99 % are within 5 mm of where the tracker's scatter has them.
const COMPUTED: f64 = 0.005;
/// Distances are computed with errors below this, m.
const EXACT: f64 = 1e-9;
/// How much farther along its path the arm comes to a stand than is computed, s of the path: seen 3 ms, one step of the
/// computation is 6.
const STOP_ERROR: f64 = 0.006;
/// No point of a link moves faster than this for each rad/s of all joints together, m: the arm's length with the hand, and
/// some.
const LEVER: f64 = 1.3;

impl Guard {
    /// # Errors
    /// [`RobotError`] when the robot's collision geometry cannot be used.
    pub fn new(model: &RobotModel, mechanism: Mechanism, limits: GuardLimits) -> Result<Self, RobotError> {
        let capsules = MovingCapsules::of(&mechanism, &model.robot.hand)?;
        let room = || Vec::with_capacity(capsules.most());
        Ok(Self {
            limits,
            mechanism,
            hand: room(),
            next_hand: room(),
            now: room(),
            start: room(),
            links: room(),
            before: room(),
            capsules,
        })
    }

    /// The hand is like this now: its fingers at these angles (message order), rad, and what it holds, in the palm's frame.
    pub fn see_hand(&mut self, fingers: &[f64; HAND_JOINTS], held: Option<Capsule>) {
        self.capsules.close(fingers, &mut self.hand);
        self.hand.extend(held.map(|held| held.within(&self.mechanism.arm.tool)));
    }

    /// Whether the arm may begin this braking path in the next cycle: neither the step to its beginning nor the braking closes on
    /// the person. `spare`: so much more room is asked for, m.
    pub fn admits(
        &mut self,
        moving: &Moving,
        braking: &BrakingPath,
        person: &PersonCapsules,
        spare: f64,
    ) -> bool {
        let Self { limits, mechanism, capsules, hand, now, start, before, links, .. } = self;
        let look = |links: &mut Vec<Capsule>, posture: &Posture| {
            capsules.place(mechanism, posture, hand, links);
        };
        let kept = limits.protective_separation + COMPUTED + spare;
        let points = braking.points();
        look(start, &points[0].posture);
        if is_far(start, points, person, kept) {
            return true;
        }
        let hands = capsules.of_hand();
        look(now, &moving.posture);
        let touches = moving.state.may_touch_person(points[0].at);
        let step = Step { now, next: start, hands };
        // What is not seen may be anywhere: braking alone is judged.
        if person.parts().filter(|part| part.is_seen).any(|part| step.closes_on(part, touches, kept, 0.0)) {
            return false;
        }
        links.clone_from(start);
        points.iter().zip(&points[1..]).all(|(earlier, point)| {
            std::mem::swap(links, before);
            look(links, &point.posture);
            let robot = Approach { start, before, links, hands, span: point.ahead - earlier.ahead };
            // A stop that is computed is a little shorter than it will be: it ends before the handover does.
            let touches =
                [point.at, point.at + STOP_ERROR].into_iter().all(|at| moving.state.may_touch_person(at));
            person.parts().all(|part| robot.is_clear_of(part, point.ahead, touches, kept, limits))
        })
    }
}

impl Guard {
    /// Whether fingers that close on nothing may go on from where they are: no link of theirs comes nearer to the person than it is,
    /// or all keep the protective separation, at any time until they could stand.
    pub fn admits_fingers(
        &mut self,
        state: &ControlState,
        fingers: &MovingFingers,
        person: &PersonCapsules,
    ) -> bool {
        let Self { limits, mechanism, capsules, hand, next_hand, now, start, .. } = self;
        let (elapsed, kept) = (state.arm.progress.elapsed, limits.protective_separation + COMPUTED);
        let posture = state.arm.trajectory.posture(elapsed);
        let (hands, touches) = (capsules.of_hand(), state.may_touch_person(elapsed));
        capsules.place(mechanism, &posture, hand, now);
        // Fingers swing out on their way: where they will stand if they brake counts as well as where they are going.
        [fingers.stopped(), fingers.target].into_iter().all(|next| {
            capsules.close(&next, next_hand);
            capsules.place(mechanism, &posture, next_hand, start);
            let step = Step { now, next: start, hands };
            !person.parts().any(|part| {
                let mut times = [0.0, 0.5, 1.0].into_iter().map(|fraction| fraction * fingers.stops_in);
                times.any(|ahead| step.closes_on(part, touches, kept, ahead))
            })
        })
    }
}

/// Whether arm and person cannot come nearer than `kept` m to each other while the arm brakes.
fn is_far(links: &[Capsule], points: &[BrakingPoint], person: &PersonCapsules, kept: f64) -> bool {
    let turned = |(one, other): (&BrakingPoint, &BrakingPoint)| -> f64 {
        one.posture.iter().zip(&other.posture).map(|(one, other)| (one - other).abs()).sum()
    };
    let travel = LEVER * points.iter().zip(&points[1..]).map(turned).sum::<f64>();
    let last = points.last().map_or(0.0, |point| point.ahead);
    person.parts().all(|part| {
        let (here, room) = (part.after(0.0), kept + travel + part.reach(last));
        links.iter().all(|link| link.least_distance(&here) > room)
    })
}

/// The step that the robot's links are about to take.
struct Step<'a> {
    now: &'a [Capsule],
    next: &'a [Capsule],
    /// Of each link: whether it belongs to the hand.
    hands: &'a [bool],
}

impl Step<'_> {
    /// Whether it brings any link nearer to a part of the body as that will be `ahead` s from now, and nearer than `kept` m to where
    /// it may be then. In a handover the robot's hand may close on the person's.
    fn closes_on(&self, part: &BodyPart, touches: bool, kept: f64, ahead: f64) -> bool {
        let (here, room) = (part.after(ahead), kept + part.growth(ahead));
        let links = self.now.iter().zip(self.next).zip(self.hands);
        links.filter(|(_, of_hand)| !(touches && **of_hand && part.hands_over)).any(|((now, next), _)| {
            next.least_distance(&here) < room && {
                let distance = next.distance(&here);
                // Nobody knows on which side of it something is that moves farther between two looks than it is away.
                let is_blurred = || part.moves && distance < part.growth(ahead) && has_moved(now, next);
                let closes = || distance < now.distance(&here) - EXACT || is_blurred();
                distance < room && closes() && !part.is_bound_away_from(next, kept, ahead)
            }
        })
    }
}

fn has_moved(now: &Capsule, next: &Capsule) -> bool {
    (next.start - now.start).norm().max((next.end - now.end).norm()) > EXACT
}

/// The robot's links on their way to one point of a braking path: where they are at its start, at the point before, and here.
struct Approach<'a> {
    start: &'a [Capsule],
    before: &'a [Capsule],
    links: &'a [Capsule],
    /// Of each link: whether it belongs to the hand.
    hands: &'a [bool],
    /// Time since the point before, s.
    span: f64,
}

impl Approach<'_> {
    /// Whether it stays `kept` m clear of all places that a part of the body may have reached by then, or closes on none; beside
    /// it, it is slow. In a handover the robot's hand may touch the person's, slowly.
    fn is_clear_of(
        &self,
        part: &BodyPart,
        ahead: f64,
        touches: bool,
        kept: f64,
        limits: &GuardLimits,
    ) -> bool {
        let there = part.after(ahead);
        let room = kept + part.growth(ahead);
        [false, true].into_iter().all(|hand| {
            let nearest = self.nearest(self.links, hand, &there, room);
            if nearest >= room {
                return true;
            }
            let is_handover = touches && hand && part.hands_over;
            let beside = if is_handover { room } else { limits.protective_separation };
            let is_slow = || self.is_slower(hand, &there, beside, limits.contact_speed);
            let here = part.after(0.0);
            // It may not go away first, and then come nearer to what is near. From somebody who is not seen nobody knows what leads away,
            // nor from a fast hand that may by then be on either side of it.
            let closes = || {
                let mut since = [self.start, self.before].into_iter();
                !part.is_seen
                    || (part.is_fast && nearest < part.growth(ahead))
                    || since.any(|then| {
                        self.closes_on(then, hand, &there, room) || self.closes_on(then, hand, &here, kept)
                    })
            };
            let is_bound =
                || self.near(hand, &there, room).all(|link| part.is_bound_away_from(link, kept, ahead));
            (is_handover || !closes() || is_bound()) && is_slow()
        })
    }

    /// Distance of what is, or is not, the hand, m; `most` when it is more.
    fn nearest(&self, links: &[Capsule], hand: bool, there: &Capsule, most: f64) -> f64 {
        let own = links.iter().zip(self.hands).filter(|(_, of_hand)| **of_hand == hand);
        own.fold(most, |nearest, (link, _)| {
            if link.least_distance(there) < nearest { nearest.min(link.distance(there)) } else { nearest }
        })
    }

    /// Whether any link is nearer than `within` m, and nearer than it was then.
    fn closes_on(&self, then: &[Capsule], hand: bool, there: &Capsule, within: f64) -> bool {
        let own = then.iter().zip(self.links).zip(self.hands).filter(|(_, of_hand)| **of_hand == hand);
        own.map(|(links, _)| links).any(|(then, link)| {
            link.least_distance(there) < within && {
                let distance = link.distance(there);
                distance < within && distance < then.distance(there) - EXACT
            }
        })
    }

    /// The links that are nearer than `within` m.
    fn near(&self, hand: bool, there: &Capsule, within: f64) -> impl Iterator<Item = &Capsule> {
        let own = self.links.iter().zip(self.hands).filter(move |(_, of_hand)| **of_hand == hand);
        own.map(|(link, _)| link)
            .filter(move |link| link.least_distance(there) < within && link.distance(there) < within)
    }

    /// Whether all links that are nearer than `within` m move no faster than this, m/s.
    fn is_slower(&self, hand: bool, there: &Capsule, within: f64, most: f64) -> bool {
        let moved =
            self.before.iter().zip(self.links).zip(self.hands).filter(|(_, of_hand)| **of_hand == hand);
        moved.into_iter().all(|((before, link), _)| {
            let way = (link.start - before.start).norm().max((link.end - before.end).norm());
            way <= most * self.span || link.least_distance(there) >= within || link.distance(there) >= within
        })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use coact_messages::TrackedPoint;
    use coact_safety::SafetyLimits;
    use nalgebra::Point3;

    /// Whether a finger closes on a hand at the origin that was seen 30 ms ago, at this speed along x, m/s, when it goes from here to
    /// there along y, m.
    fn closes(speed: f64, from: f64, to: f64) -> bool {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../rt-config/safety.toml");
        let SafetyLimits { person, stale, guard, .. } = SafetyLimits::load(file.as_ref()).unwrap();
        let still = if speed == 0.0 { u64::MAX } else { 0 };
        let velocity = [speed, 0.0, 0.0];
        let point = TrackedPoint { velocity, age: 30, still, ..bytemuck::Zeroable::zeroed() };
        let finger =
            |y| [Capsule { start: Point3::new(0.0, y, 0.0), end: Point3::new(0.0, y, 0.1), radius: 0.0 }];
        let step = Step { now: &finger(from), next: &finger(to), hands: &[true] };
        let hand = BodyPart::between(&point, &point, &person, &stale);
        step.closes_on(&hand, false, guard.protective_separation, 0.0)
    }

    #[test]
    fn a_finger_may_leave_a_hand_that_rests_and_not_come_nearer_to_it() {
        assert!(!closes(0.0, 0.01, 0.0101) && closes(0.0, 0.01, 0.0099));
    }

    #[test]
    fn beside_a_hand_that_moves_fast_it_stands_for_nobody_knows_on_which_side_of_it_that_is() {
        assert!(closes(1.5, 0.01, 0.0101) && !closes(1.5, 0.01, 0.01));
        assert!(!closes(1.5, 0.06, 0.0601), "it is farther away than the hand has gone unseen");
    }
}
