use crate::errand::{Errand, Leg};
use bytemuck::{Pod, Zeroable};
use coact_messages::{Command, JOINTS, NONE};
use coact_robot::{HandGoal, MotionState, Movement, Posture, PostureSearch, Reach};
use nalgebra::{Point3, Vector3};

/// All that control remembers from cycle to cycle, besides the setpoints: the words of [`Command::memory`], in this
/// order, 8 bytes each; the remaining words are zero. Whole numbers are stored as their bits.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub(crate) struct Memory {
    /// [`MARK`]: the words are control's, of this layout.
    pub mark: u64,
    /// The movement under way: position, velocity, acceleration of each joint at its start.
    pub start: [[f64; 3]; JOINTS],
    /// Where each joint comes to rest, rad.
    pub target: [f64; JOINTS],
    /// Duration of the movement, s.
    pub duration: f64,
    /// Cycles since its start.
    pub elapsed: u64,
    /// 1 while braking: the movement starts anew, from rest, when everything stands still.
    pub halted: u64,
    /// How much slower than the limits allow the movement shall be, when it starts at rest.
    pub slowness: f64,
    /// [`Errand`] under way.
    pub errand: u64,
    /// [`Leg`] of it.
    pub leg: u64,
    /// Cycles since the leg began (braking not counted).
    pub leg_age: u64,
    /// Action that the errand serves: index into `Task::actions`, or [`NONE`].
    pub action: u64,
    /// [`Decision::since`](coact_messages::Decision) of the decision that began it.
    pub since: u64,
    /// Kind of part that the errand is about, or [`NONE`].
    pub kind: u64,
    /// Kind of part in the hand, or [`NONE`].
    pub held: u64,
    /// 1 when `taken_from` is the place on the table from which the held part was taken.
    pub taken: u64,
    /// That place, m.
    pub taken_from: [f64; 3],
    /// Cycles for which the felt touch has said what the leg waits for: part present, or part lost.
    pub touched: u64,
    /// Cycles for which the person's hand has been where the leg waits for it.
    pub met: u64,
    /// Grasps in a row that closed on nothing.
    pub misses: u64,
    /// Cycles for which no decision has concerned the held part.
    pub undecided: u64,
    /// Action that was carried out (or given up) last, or [`NONE`]: not repeated for the same decision.
    pub finished: u64,
    /// Its `since`.
    pub finished_since: u64,
    /// Cycles since then.
    pub finished_age: u64,
    /// 1 when it was given up.
    pub failed: u64,
    /// Goal of the errand: grasp point, approach, closing axis (m, unit vectors), then rolls, back, floor.
    pub goal: [f64; 12],
    /// Arm posture from which the postures are searched, rad.
    pub from: Posture,
    /// The posture search: cursor, found, cost, swivel, roll, centre of refinement.
    pub search: [f64; 7],
    /// The best postures found so far, or those of the errand: before the goal, at the goal; rad.
    pub reach: [Posture; 2],
}

/// Marks the words as control's, of this layout: to be changed with it.
pub(crate) const MARK: u64 = 0x636f_6163_7401;

const WORDS: usize = size_of::<Memory>() / 8;

impl Memory {
    /// At rest at `position`, knowing nothing.
    pub fn at_rest(position: [f64; JOINTS]) -> Self {
        Self {
            mark: MARK,
            start: position.map(|angle| [angle, 0.0, 0.0]),
            target: position,
            duration: 1e-3,
            elapsed: 1,
            slowness: 1.0,
            action: NONE.into(),
            kind: NONE.into(),
            held: NONE.into(),
            finished: NONE.into(),
            ..Self::zeroed()
        }
    }

    /// From a command; `None` when its words are not control's.
    pub fn recall(command: &Command) -> Option<Self> {
        let memory: Self = *bytemuck::from_bytes(bytemuck::cast_slice(&command.memory[..WORDS]));
        let known = Errand::from_word(memory.errand).is_some() && Leg::from_word(memory.leg).is_some();
        let sound = memory.duration > 0.0 && memory.target.iter().all(|angle| angle.is_finite());
        (memory.mark == MARK && known && sound).then_some(memory)
    }

    /// Into a command.
    pub fn store(&self, command: &mut Command) {
        command.memory[..WORDS].copy_from_slice(bytemuck::cast_slice(bytemuck::bytes_of(self)));
        command.memory[WORDS..].fill(0.0);
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
    }

    /// Kind of part in the hand.
    pub fn held(&self) -> Option<usize> {
        index(self.held)
    }

    /// Kind of part that the errand is about.
    pub fn kind(&self) -> Option<usize> {
        index(self.kind)
    }

    pub fn movement(&self) -> Movement<JOINTS> {
        let start = self.start.map(|[position, velocity, acceleration]| MotionState {
            position,
            velocity,
            acceleration,
        });
        Movement { start, target: self.target, duration: self.duration }
    }

    pub fn set_movement(&mut self, movement: &Movement<JOINTS>) {
        self.start = movement.start.map(|state| [state.position, state.velocity, state.acceleration]);
        self.target = movement.target;
        self.duration = movement.duration;
        self.elapsed = 0;
    }

    pub fn goal(&self) -> HandGoal {
        let [px, py, pz, ax, ay, az, cx, cy, cz, rolls, back, floor] = self.goal;
        HandGoal {
            point: Point3::new(px, py, pz),
            approach: Vector3::new(ax, ay, az),
            closing: Vector3::new(cx, cy, cz),
            rolls: rolls as u32,
            back,
            floor,
        }
    }

    pub fn set_goal(&mut self, goal: &HandGoal) {
        let HandGoal { point, approach, closing, rolls, back, floor } = goal;
        self.goal[..3].copy_from_slice(point.coords.as_slice());
        self.goal[3..6].copy_from_slice(approach.as_slice());
        self.goal[6..9].copy_from_slice(closing.as_slice());
        self.goal[9..].copy_from_slice(&[f64::from(*rolls), *back, *floor]);
    }

    pub fn search(&self) -> PostureSearch {
        let [cursor, found, cost, swivel, roll, at, about] = self.search;
        let best = Reach { before: self.reach[0], at: self.reach[1] };
        PostureSearch {
            cursor: cursor as u32,
            found: found as u32,
            cost,
            swivel,
            roll,
            centre: [at, about],
            best,
        }
    }

    pub fn set_search(&mut self, search: &PostureSearch) {
        let PostureSearch { cursor, found, cost, swivel, roll, centre, best } = *search;
        self.search = [f64::from(cursor), f64::from(found), cost, swivel, roll, centre[0], centre[1]];
        self.reach = [best.before, best.at];
    }
}

fn index(word: u64) -> Option<usize> {
    (word < u64::from(NONE)).then_some(word as usize)
}
