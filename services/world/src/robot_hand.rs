use crate::dynamics::MeasuredGrip;
use crate::palm::Palm;
use crate::parts::Parts;
use crate::robot_hand_state::RobotHandState;
use coact_joint_task::Task;
use coact_messages::{ARM_JOINTS, JOINTS};
use coact_period::cycles;
use coact_person::Holder;
use coact_robot::{HAND_JOINTS, Hand, Robot};
use coact_stage_state::{Flag, Slot};
use glam::{DQuat, DVec3};
use std::time::Duration;

/// How near a part's axis must be to that of the hand, between palm and grasp point, for the fingers to grasp it, m: about
/// half the width of the largest part.
const REACH: f64 = 0.03;
/// Distance of the places at which that is measured, m. Not sensitive: a sixth of the above.
const ALONG: f64 = 0.005;
/// The fingers touch a part when their clear width exceeds the part's by no more than this, m. Chosen by hand, as are the
/// next three; not sensitive.
const TOUCHING: f64 = 0.002;
/// They have let go when it exceeds it by this, m.
const RELEASED: f64 = 0.008;
/// Fingers that are told to stand this much further open than when they held a part let go of it, rad.
const OPENED: f64 = 0.01;
/// Clear width from which a hand without a part looks open to the person, m: wider than most parts. Chosen by hand.
const LOOKS_OPEN: f64 = 0.06;
/// Distance of the grasp point from a place within which the person sees the hand as being there, m: about a hand's length.
const AT_PLACE: f64 = 0.18;
/// An open hand so far above a place, m, is seen as held out there: it requests what it will take from above. Chosen by hand.
const ABOVE: f64 = 0.32;
/// Distance of the grasp point from where it took a part within which the part is not carried yet, m. Chosen by hand.
const LIFTED: f64 = 0.03;
/// Without dynamics: grip force when the fingers just touch, N, and its growth with the angle by which the part stops the
/// fingers short of their setpoint, N/rad. Chosen by hand, of the size of the forces that the dynamics give.
const GRIP_FORCE: (f64, f64) = (2.0, 40.0);

/// Measured force from which a part counts as grasped, N. Chosen by hand, far below what the fingers exert on a part.
const GRASPED_FORCE: f64 = 0.5;
/// Measured force below which the held part counts as lost, N: less than the above, or it would come and go.
const LOST_FORCE: f64 = 0.1;
/// The same while the fingers are told to open, N. Chosen by hand: friction still carries each part with it, so that none falls before
/// it is let go; with ten times as much it would stand fast between fingers that squeeze it.
const RELEASED_FORCE: f64 = 2.0;
/// For how long the force must say that a part is grasped before it is, cycles.
const GRASPED_TIME: u64 = cycles(Duration::from_millis(10));
/// For how long the force must say that the held part is lost before it is, cycles: as long as the force sensor averages.
const LOST_TIME: u64 = cycles(Duration::from_millis(30));

/// Mean finger angles at which a kind of part is touched, gripped and let go, rad, and all hand joints in the grip.
#[derive(Debug, Clone, Copy)]
struct FingerAngles {
    touch: f64,
    grip: f64,
    release: f64,
    hand: [f64; HAND_JOINTS],
}

/// Grasps and releases parts as the robot's fingers close and open.
#[derive(Debug, Clone)]
pub(crate) struct RobotHand {
    robot: Robot,
    angles: Vec<FingerAngles>,
    open: f64,
    handover: DVec3,
    steady: Vec<DVec3>,
}

impl RobotHand {
    pub fn new(robot: &Robot, task: &Task) -> Self {
        let angles = task.kinds.iter().map(|kind| {
            let hand = |gap: f64| robot.hand.grasp(kind.width, gap).angles;
            let mean = |gap: f64| hand(gap)[1..4].iter().sum::<f64>() / 3.0;
            FingerAngles {
                touch: mean(0.5 * TOUCHING),
                grip: mean(0.0),
                release: mean(0.5 * RELEASED),
                hand: hand(0.0),
            }
        });
        Self {
            angles: angles.collect(),
            open: robot.hand.base_for_width(LOOKS_OPEN),
            handover: task.scene.handover.into(),
            steady: task.scene.steady.iter().map(|place| DVec3::from(*place)).collect(),
            robot: robot.clone(),
        }
    }

    /// The palm for joint positions in message order, rad.
    pub fn palm(&self, position: &[f64; JOINTS]) -> Palm {
        let pose = self.robot.palm(&position[..ARM_JOINTS]);
        let point = pose * self.robot.hand.grasp_point();
        let turn = pose.rotation.coords;
        Palm {
            grasp_point: DVec3::new(point.x, point.y, point.z),
            orientation: DQuat::from_xyzw(turn.x, turn.y, turn.z, turn.w),
            finger_closure: coact_messages::finger_closure(position),
        }
    }

    /// Hand joint angles at which the held part stops the fingers, rad; none when the hand is empty.
    pub fn stop(&self, state: &RobotHandState, parts: &Parts) -> Option<[f64; HAND_JOINTS]> {
        state.held.get().map(|part| self.angles[parts.kind(part)].hand)
    }

    /// Force on the held part, N, as the servo would close the fingers.
    pub fn touch(&self, state: &RobotHandState, parts: &Parts) -> f64 {
        let force = |stop: f64| GRIP_FORCE.0 + GRIP_FORCE.1 * (state.commanded_closure - stop).max(0.0);
        state.held.get().map_or(0.0, |part| force(self.angles[parts.kind(part)].grip))
    }

    /// Grasps, carries and releases: as the fingers' forces were measured (`grip`), or without dynamics by rules, as the
    /// palm moved and the fingers closed or opened since the last step.
    ///
    /// A part that the person's fingers have as well (`person_holds`) becomes the person's when the robot lets go. One that
    /// is lost by fingers that were not told to open has slipped.
    pub fn advance(
        &self,
        palm: &Palm,
        grip: Option<MeasuredGrip>,
        state: &mut RobotHandState,
        person_holds: Slot,
        parts: &mut Parts,
        task: &Task,
    ) {
        let held = state.held.get();
        let opens = grip.is_none() || state.commanded_closure < state.tightest - OPENED;
        let least = if opens { RELEASED_FORCE } else { LOST_FORCE };
        let lost = held.filter(|&part| match grip {
            Some(grip) => lasts(state, grip.force_on(part) < least, LOST_TIME),
            None => palm.finger_closure < self.angles[parts.kind(part)].release,
        });
        match (lost, grip) {
            (Some(part), _) => let_go(part, opens, state, person_holds, parts, task),
            (None, Some(grip)) if held.is_none() => {
                let grasped = grip.part.filter(|part| !parts.is(*part, Holder::Socket));
                let grasped = grasped.filter(|_| lasts(state, grip.force > GRASPED_FORCE, GRASPED_TIME));
                grasped.into_iter().for_each(|part| take(palm, state, parts, part));
            }
            (None, None) if held.is_none() => self.grasp(palm, state, parts, task),
            (None, _) => {}
        }
        if grip.is_none() {
            carry(palm, state, parts);
        }
        self.follow(palm, state, parts);
    }

    /// Takes down where palm and fingers are now, and for how long the held part has been carried.
    fn follow(&self, palm: &Palm, state: &mut RobotHandState, parts: &Parts) {
        state.finger_closure = palm.finger_closure;
        let is_empty = state.held == Slot::EMPTY;
        let tightest = state.tightest.max(state.commanded_closure);
        state.tightest = if is_empty { state.commanded_closure } else { tightest };
        if palm.finger_closure < self.open {
            state.slipped = Slot::EMPTY;
        }
        let lifted = palm.grasp_point.distance(state.taken_at.into()) > LIFTED;
        match state.held.get() {
            Some(part) if parts.is(part, Holder::Robot) => state.carried += u64::from(lifted),
            _ => state.carried = 0,
        }
    }

    /// The held part slips out of the closed fingers: it falls, and rolls to `to` on the table top if that is given.
    pub fn lose(&self, state: &mut RobotHandState, parts: &mut Parts, to: Option<[f64; 2]>, task: &Task) {
        let Some(part) = state.held.get() else { return };
        state.held = Slot::EMPTY;
        state.slipped = Slot::of(part);
        state.carried = 0;
        if let Some([x, y]) = to {
            parts.place(part, DVec3::new(x, y, task.scene.table_height), DQuat::IDENTITY);
        }
        parts.drop(part, task);
    }

    /// Distance of a part's axis from that of the hand, m.
    fn distance(&self, part: usize, palm: &Palm, parts: &Parts, task: &Task) -> f64 {
        let Hand { palm_face, grasp_distance, .. } = self.robot.hand;
        let back = palm.orientation * -DVec3::Z;
        let steps = ((grasp_distance - palm_face) / ALONG) as u32;
        let points = (0..=steps).map(|step| palm.grasp_point + f64::from(step) * ALONG * back);
        points.map(|point| parts.distance_to_axis(part, point, task)).fold(f64::INFINITY, f64::min)
    }

    fn grasp(&self, palm: &Palm, state: &mut RobotHandState, parts: &mut Parts, task: &Task) {
        let within = |part: &usize| {
            let angles = self.angles[parts.kind(*part)];
            let closes_now = state.finger_closure < angles.touch && palm.finger_closure >= angles.touch;
            closes_now && !parts.is(*part, Holder::Socket) && self.distance(*part, palm, parts, task) <= REACH
        };
        let distance = |part: &usize| self.distance(*part, palm, parts, task);
        let nearest = (0..parts.all().len())
            .filter(within)
            .min_by(|one, other| distance(one).total_cmp(&distance(other)));
        nearest.into_iter().for_each(|part| take(palm, state, parts, part));
    }

    /// Records since when the hand has stood where the person pays attention to it, and what the person puts into it.
    pub fn notice(&self, tick: u64, palm: &Palm, state: &mut RobotHandState, parts: &Parts, task: &Task) {
        let from_handover = palm.grasp_point - self.handover;
        let at_handover = from_handover.length() < AT_PLACE;
        let above = from_handover.truncate().length() < AT_PLACE && (0.0..ABOVE).contains(&from_handover.z);
        let at_base = self.steady.iter().any(|place| palm.grasp_point.distance(*place) < AT_PLACE);
        let empty = state.held.get().is_none();
        let since = |yes: bool, since: u64| match (yes, since) {
            (false, _) => 0,
            (true, 0) => tick.max(1),
            (true, since) => since,
        };
        state.brought = Flag::from(!empty && (state.brought.is_set() || !at_handover));
        state.requesting_since =
            since((at_handover || above) && empty && palm.finger_closure < self.open, state.requesting_since);
        state.giving_since = since(at_handover && state.brought.is_set(), state.giving_since);
        state.steadying_since = since(at_base && empty, state.steadying_since);
        let between = |part: &usize| {
            parts.is(*part, Holder::Person) && self.distance(*part, palm, parts, task) <= REACH
        };
        let received = (0..parts.all().len()).find(between).filter(|_| empty);
        state.receiving = received.map_or(Slot::EMPTY, Slot::of);
    }
}

/// Whether a change has been measured for more than `ticks` in a row.
fn lasts(state: &mut RobotHandState, changed: bool, ticks: u64) -> bool {
    state.changing = if changed { state.changing + 1 } else { 0 };
    state.changing > ticks
}

/// The fingers lose the held part, because they `opened` or because it slipped.
fn let_go(
    part: usize,
    opened: bool,
    state: &mut RobotHandState,
    person_holds: Slot,
    parts: &mut Parts,
    task: &Task,
) {
    state.held = Slot::EMPTY;
    if person_holds.get() == Some(part) {
        parts.give_to(part, Holder::Person);
    } else {
        state.slipped = if opened { Slot::EMPTY } else { Slot::of(part) };
        parts.let_go(part, task);
    }
}

fn take(palm: &Palm, state: &mut RobotHandState, parts: &mut Parts, part: usize) {
    state.held = Slot::of(part);
    state.changing = 0;
    state.taken_at = palm.grasp_point.into();
    if parts.is(part, Holder::Nobody) {
        parts.give_to(part, Holder::Robot);
    }
    attach(palm, state, parts, part);
}

fn attach(palm: &Palm, state: &mut RobotHandState, parts: &Parts, part: usize) {
    let back = palm.orientation.inverse();
    state.offset = (back * (parts.position(part) - palm.grasp_point)).into();
    state.turn = (back * parts.orientation(part)).normalize().into();
}

/// A part in the robot's hand follows the palm; one that the person holds as well stays in the person's hand.
fn carry(palm: &Palm, state: &mut RobotHandState, parts: &mut Parts) {
    let Some(part) = state.held.get() else { return };
    if !parts.is(part, Holder::Robot) {
        return attach(palm, state, parts, part);
    }
    let position = palm.grasp_point + palm.orientation * DVec3::from(state.offset);
    parts.place(part, position, (palm.orientation * DQuat::from_array(state.turn)).normalize());
}
