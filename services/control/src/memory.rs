use crate::course::Course;
use crate::errand::{Errand, Leg};
use bytemuck::{Pod, Zeroable};
use coact_messages::{ARM_JOINTS, Command, JOINTS, NONE};
use coact_robot::{MotionState, PointToPoint, Posture};
use nalgebra::{Isometry3, Quaternion, Translation3, UnitQuaternion};

/// Joints of the hand, the last of them reserved.
pub(crate) const FINGER_JOINTS: usize = JOINTS - ARM_JOINTS;

/// All that control remembers from cycle to cycle, besides the setpoints: the words of [`Command::state`], in this
/// order, 8 bytes each; the remaining words are zero. Whole numbers are stored as their bits.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub(crate) struct Memory {
    /// [`MARK`]: the words are control's, of this layout.
    pub mark: u64,
    /// The arm's movement under way, and the one that follows it at cycle `begins` (0: none does).
    pub course: Course,
    pub next: Course,
    pub begins: u64,
    /// Time of the course so far, s, the share of its own speed at which it goes on, and the change of that, 1/s.
    pub elapsed: f64,
    pub pace: f64,
    pub pace_change: f64,
    /// The fingers' movement: position, velocity, acceleration of each joint at its start; where each comes to rest,
    /// rad; duration, s; cycles since its start.
    pub finger_start: [[f64; 3]; FINGER_JOINTS],
    pub finger_target: [f64; FINGER_JOINTS],
    pub finger_duration: f64,
    pub finger_elapsed: u64,
    /// 1 while arm, or fingers, brake: their movements start anew, from rest, when they stand still.
    pub arm_halted: u64,
    pub fingers_halted: u64,
    /// [`Errand`] under way.
    pub errand: u64,
    /// [`Leg`] of it.
    pub leg: u64,
    /// Cycles since the leg began.
    pub leg_age: u64,
    /// Action that the errand serves: index into `Task::actions`, or [`NONE`].
    pub action: u64,
    /// [`Decision::since`](coact_messages::Decision) of the decision that began it.
    pub since: u64,
    /// Kind of part that the errand is about, or [`NONE`].
    pub kind: u64,
    /// Kind of part in the hand, or [`NONE`], and its place and turn (x, y, z, w) in the palm's frame, m.
    pub held: u64,
    pub in_palm: [f64; 7],
    /// How the hand holds, or is about to take, a part: index into [`Holds`](crate::holds::Holds), or [`NONE`].
    pub hold: u64,
    /// Sum of the places (m, in the palm's frame) at which it was seen since the fingers closed, how many there are, and
    /// the cycle of the newest camera frame among them.
    pub seen: [f64; 3],
    pub sightings: u64,
    pub seen_in: u64,
    /// 1 when `taken_from` is the place on the table from which the held part was taken.
    pub taken: u64,
    /// That place, m.
    pub taken_from: [f64; 3],
    /// Cycles for which the felt touch has said what the leg waits for: part present, or part lost.
    pub touched: u64,
    /// Cycles for which the person's hand has been where the leg waits for it, and for which it has pulled.
    pub met: u64,
    pub pulled: u64,
    /// Grasps in a row that closed on nothing, and movements in a row that the planner refused.
    pub misses: u64,
    pub refusals: u64,
    /// Cycles for which no decision has concerned the held part, and for which there has been none at all.
    pub undecided: u64,
    pub silent: u64,
    /// Action that was carried out (or given up) last, or [`NONE`]: not repeated for the same decision.
    pub finished: u64,
    /// Its `since`.
    pub finished_since: u64,
    /// Cycles since then.
    pub finished_age: u64,
    /// 1 when it was given up.
    pub failed: u64,
    /// Place (m) and turn (x, y, z, w) of what the errand is about, and whether the hand stops before it.
    pub place: [f64; 7],
    pub before: u64,
    /// Questions to the planner so far; 1 while the last one is open; for how many cycles it has been, or shall not be
    /// asked again.
    pub questions: u64,
    pub asking: u64,
    pub waited: u64,
    /// 1 when `next` is there; 1 when the last answer only gets the hand free.
    pub ready: u64,
    pub withdraws: u64,
    /// Cycles ahead at which a movement begins that is asked for in motion.
    pub lead: u64,
    /// How far the hand is in a narrow place out of which it must go first: share of the way, 0 to 1.
    pub inside: f64,
    /// Cycles for which the person has been in the way.
    pub blocked: u64,
    /// Cycle at which the present decision was first seen, 0 when its movement has begun; movements that a decision
    /// has begun so far, and how many cycles after it the last one did.
    pub decided: u64,
    pub begun: u64,
    pub reaction: u64,
}

/// Marks the words as control's, of this layout: to be changed with it.
pub(crate) const MARK: u64 = 0x636f_6163_7405;

const WORDS: usize = size_of::<Memory>() / 8;
/// Cycles ahead at which a movement begins that is asked for in motion, at first and at most.
pub(crate) const LEAD: (u64, u64) = (40, 320);

impl Memory {
    /// At rest at `position`, knowing nothing.
    pub fn at_rest(position: [f64; JOINTS]) -> Self {
        let (arm, fingers) = split(position);
        Self {
            mark: MARK,
            course: Course::resting(arm),
            next: Course::resting(arm),
            pace: 1.0,
            finger_start: fingers.map(|angle| [angle, 0.0, 0.0]),
            finger_target: fingers,
            finger_duration: 1e-3,
            finger_elapsed: 1,
            action: NONE.into(),
            kind: NONE.into(),
            held: NONE.into(),
            hold: NONE.into(),
            finished: NONE.into(),
            lead: LEAD.0,
            ..Self::zeroed()
        }
    }

    /// From a command; `None` when its words are not control's.
    pub fn recall(command: &Command) -> Option<Self> {
        let memory: Self = *bytemuck::from_bytes(bytemuck::cast_slice(&command.state[..WORDS]));
        if memory.mark != MARK {
            return None;
        }
        let known = Errand::from_word(memory.errand).is_some() && Leg::from_word(memory.leg).is_some();
        let fingers =
            memory.finger_duration > 0.0 && memory.finger_target.iter().all(|angle| angle.is_finite());
        let pace = (0.0..=1.0).contains(&memory.pace) && memory.pace_change.is_finite();
        let courses = memory.course.is_sound() && memory.next.is_sound() && memory.elapsed >= 0.0;
        (known && fingers && pace && courses).then_some(memory)
    }

    /// Into a command.
    pub fn store(&self, command: &mut Command) {
        command.state[..WORDS].copy_from_slice(bytemuck::cast_slice(bytemuck::bytes_of(self)));
        command.state[WORDS..].fill(0.0);
    }

    pub fn errand(&self) -> Errand {
        Errand::from_word(self.errand).unwrap_or(Errand::Park)
    }

    pub fn leg(&self) -> Leg {
        Leg::from_word(self.leg).unwrap_or(Leg::Rest)
    }

    /// Enters a leg.
    pub fn enter(&mut self, leg: Leg) {
        self.leg = leg as u64;
        self.leg_age = 0;
        self.touched = 0;
        self.met = 0;
        self.pulled = 0;
        (self.seen, self.sightings) = ([0.0; 3], 0);
    }

    /// Kind of part in the hand.
    pub fn held(&self) -> Option<usize> {
        index(self.held)
    }

    /// Kind of part that the errand is about.
    pub fn kind(&self) -> Option<usize> {
        index(self.kind)
    }

    /// Whether the robot's hand shall touch the person's `t` s after the start of the course: where it takes what the
    /// person holds out, and where it brings a part to the person's hand. On the way there it keeps clear of it.
    pub fn meets(&self, t: f64) -> bool {
        match self.errand() {
            Errand::Receive => self.before == 0,
            Errand::Offer => self.course.is_approach(t),
            _ => false,
        }
    }

    /// Whether the arm has come to the end of its course.
    pub fn arrived(&self) -> bool {
        self.arm_halted == 0 && self.begins == 0 && self.elapsed >= self.course.duration()
    }

    /// Whether the fingers have come to the end of their movement.
    pub fn fingers_arrived(&self) -> bool {
        self.fingers_halted == 0 && self.finger_elapsed as f64 * 1e-3 >= self.finger_duration
    }

    /// Puts a course under way.
    pub fn follow(&mut self, course: &Course) {
        self.course = *course;
        (self.elapsed, self.pace, self.pace_change) = (0.0, 1.0, 0.0);
        (self.begins, self.arm_halted) = (0, 0);
    }

    pub fn finger_movement(&self) -> PointToPoint<FINGER_JOINTS> {
        let start = self.finger_start.map(|[position, velocity, acceleration]| MotionState {
            position,
            velocity,
            acceleration,
        });
        PointToPoint { start, target: self.finger_target, duration: self.finger_duration }
    }

    pub fn set_finger_movement(&mut self, movement: &PointToPoint<FINGER_JOINTS>) {
        self.finger_start = movement.start.map(|state| [state.position, state.velocity, state.acceleration]);
        self.finger_target = movement.target;
        self.finger_duration = movement.duration;
        (self.finger_elapsed, self.fingers_halted) = (0, 0);
    }
}

/// Arm and fingers of a row of all joints.
pub(crate) fn split(position: [f64; JOINTS]) -> (Posture, [f64; FINGER_JOINTS]) {
    (std::array::from_fn(|joint| position[joint]), std::array::from_fn(|joint| position[ARM_JOINTS + joint]))
}

/// A pose from its words: place and turn (x, y, z, w).
pub(crate) fn pose([px, py, pz, x, y, z, w]: [f64; 7]) -> Isometry3<f64> {
    let turn = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9).unwrap_or_default();
    Isometry3::from_parts(Translation3::new(px, py, pz), turn)
}

/// The words of a pose.
pub(crate) fn words(pose: &Isometry3<f64>) -> [f64; 7] {
    let (at, turn) = (pose.translation.vector, pose.rotation.coords);
    [at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w]
}

fn index(word: u64) -> Option<usize> {
    (word < u64::from(NONE)).then_some(word as usize)
}
