use crate::ControlError;
use coact_joint_task::Task;
use coact_robot::{Graspable, Grip, GripSide, Grips, HAND_JOINTS, Hand, HandGoal, NextUse};
use nalgebra::Isometry3;

/// All the ways in which the hand can hold the parts of a task. Memory names each of them by its index.
#[derive(Debug, Clone)]
pub(crate) struct Holds {
    /// Those of each kind of part.
    grips: Vec<Grips>,
    all: Vec<Hold>,
}

/// One way to hold a kind of part.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hold {
    pub kind: usize,
    pub grip: Grip,
    /// Angles of the hand's joints that is closed on it, and of one that has let it go, rad.
    pub closed: [f64; HAND_JOINTS],
    pub open: [f64; HAND_JOINTS],
}

/// How far into a part each finger is told to close, as a share of its width: what makes them press.
const SQUEEZE: f64 = 0.3;

impl Holds {
    /// # Errors
    /// [`ControlError::Ungraspable`] when the hand has no grip for a kind of part.
    pub fn new(hand: &Hand, task: &Task) -> Result<Self, ControlError> {
        let of_kinds = task
            .kinds
            .iter()
            .map(|kind| Grips::of(hand, coact_workplace::graspable(kind), NextUse::Anything));
        let grips: Vec<Grips> = of_kinds.collect();
        if let Some(kind) = grips.iter().position(|grips| grips.all.is_empty()) {
            let (name, width) = (task.kinds[kind].name.clone(), task.kinds[kind].width);
            return Err(ControlError::Ungraspable { name, width });
        }
        let holds = grips.iter().enumerate().flat_map(|(kind, grips)| {
            grips.all.iter().map(move |grip| {
                let closed = grip.fingers(hand, &grips.object, -SQUEEZE * grips.object.width);
                Hold { kind, grip: *grip, closed, open: grip.open(hand, &grips.object) }
            })
        });
        Ok(Self { all: holds.collect(), grips })
    }

    /// All of them.
    pub fn all(&self) -> &[Hold] {
        &self.all
    }

    /// What is gripped of a kind.
    pub fn form(&self, kind: usize) -> &Graspable {
        &self.grips[kind].object
    }

    /// The hand open around a part of this kind, whichever way it takes it: angles of its joints, rad.
    pub fn around(&self, kind: usize) -> [f64; HAND_JOINTS] {
        self.grips[kind].open
    }

    /// The hold that a word of memory names, when it is one of this kind; else the kind's first one.
    pub fn known(&self, word: u64, kind: usize) -> usize {
        let named =
            usize::try_from(word).ok().filter(|hold| self.all.get(*hold).is_some_and(|h| h.kind == kind));
        named.unwrap_or_else(|| self.first(kind))
    }

    /// Goals of the hand that takes, or brings, a part whose frame is `frame`, each with its hold: of all that serve what
    /// is done next. The approach begins `back` m before; shoulder, elbow and wrist stay above `floor` m.
    pub fn goals(
        &self,
        kind: usize,
        next: NextUse,
        frame: &Isometry3<f64>,
        back: f64,
        floor: f64,
    ) -> impl Iterator<Item = (HandGoal, usize)> {
        let (grips, first) = (&self.grips[kind], self.first(kind));
        let goals = grips.goals(frame, back, floor).into_iter();
        let suiting = goals.filter(move |(grip, _)| grips.suits(&grips.all[*grip], next));
        suiting.map(move |(grip, goal)| (goal, first + grip))
    }

    /// How a part of this kind is taken out of a person's hand: from above, where that is not.
    pub fn received(&self, kind: usize) -> usize {
        let is_from_above = |hold: &Hold| hold.kind == kind && hold.grip.side == GripSide::Above;
        self.all.iter().position(is_from_above).unwrap_or_else(|| self.first(kind))
    }

    fn first(&self, kind: usize) -> usize {
        self.all.iter().take_while(|hold| hold.kind < kind).count()
    }
}
