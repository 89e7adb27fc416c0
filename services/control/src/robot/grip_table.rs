use super::PartGrip;
use crate::ControlError;
use coact_joint_task::Task;
use coact_robot::{Graspable, Grip, GripSide, Grips, HAND_JOINTS, Hand, HandGoal, NextUse};
use nalgebra::Isometry3;

/// All the grips in which the hand can grasp the parts of a task. Control's state names each of them by its index.
#[derive(Debug, Clone)]
pub(crate) struct GripTable {
    /// Those of each kind of part.
    by_kind: Vec<Grips>,
    all: Vec<PartGrip>,
}

/// A goal of the hand, and the grip in which it grasps a part there, if it does.
#[derive(Debug, Clone, Copy)]
pub(crate) struct GripGoal {
    pub goal: HandGoal,
    pub grip: Option<usize>,
}

/// How far into a part each finger is told to close, as a fraction of its width. The fingers' servos turn the difference
/// between that and where the part stops them into force. Chosen by hand: parts neither slip nor slide away.
const SQUEEZE: f64 = 0.3;
/// Something round is wedged between fingers 1 and 2 when it is narrower than so many times the gap between them: with 2 their inner edges press
/// on it at 30 degrees and more to where they close.
const WEDGED: f64 = 2.0;
/// How far their spread opens to let it go, rad. Chosen by hand: a nut of 25 mm was seen to come free at 0.15, and not at 0.06.
const APART: f64 = 0.2;

impl GripTable {
    /// # Errors
    /// [`ControlError::Ungraspable`] when the hand has no grip for a kind of part.
    pub fn new(hand: &Hand, task: &Task) -> Result<Self, ControlError> {
        let by_kind: Vec<Grips> = task
            .kinds
            .iter()
            .map(|kind| Grips::of(hand, coact_workplace::graspable(kind), NextUse::Anything))
            .collect();
        if let Some(kind) = by_kind.iter().position(|grips| grips.all.is_empty()) {
            let (name, width) = (task.kinds[kind].name.clone(), task.kinds[kind].width);
            return Err(ControlError::Ungraspable { name, width });
        }
        let all = by_kind.iter().enumerate().flat_map(|(kind, grips)| part_grips(hand, kind, grips));
        Ok(Self { all: all.collect(), by_kind })
    }

    /// All of them.
    pub fn all(&self) -> &[PartGrip] {
        &self.all
    }

    /// What is grasped of a kind.
    pub fn object(&self, kind: usize) -> &Graspable {
        &self.by_kind[kind].object
    }

    /// The hand open around a part of this kind, in whichever grip it is picked: angles of its joints, rad.
    pub fn open_around(&self, kind: usize) -> [f64; HAND_JOINTS] {
        self.by_kind[kind].open
    }

    /// This grip, if it is one of this kind of part; else the kind's first one.
    pub fn known(&self, grip: Option<usize>, kind: usize) -> usize {
        let known = grip.filter(|grip| self.all.get(*grip).is_some_and(|grip| grip.kind == kind));
        known.unwrap_or_else(|| self.first(kind))
    }

    /// Goals of the hand that grasps a part whose frame is `frame`, in all grips that serve what is done next. The approach
    /// begins `back` m before; shoulder, elbow and wrist stay above `floor` m.
    pub fn goals(
        &self,
        kind: usize,
        next: NextUse,
        frame: &Isometry3<f64>,
        back: f64,
        floor: f64,
    ) -> impl Iterator<Item = GripGoal> {
        let (grips, first) = (&self.by_kind[kind], self.first(kind));
        let goals = grips.goals(frame, back, floor).into_iter();
        let suiting = goals.filter(move |(grip, _)| grips.suits(&grips.all[*grip], next));
        suiting.map(move |(grip, goal)| GripGoal { goal, grip: Some(first + grip) })
    }

    /// How a part of this kind is received from a person's hand: from above, where that is not.
    pub fn received(&self, kind: usize) -> usize {
        let is_from_above = |grip: &PartGrip| grip.kind == kind && grip.grip.side == GripSide::Above;
        self.all.iter().position(is_from_above).unwrap_or_else(|| self.first(kind))
    }

    fn first(&self, kind: usize) -> usize {
        self.all.iter().take_while(|grip| grip.kind < kind).count()
    }
}

/// The grips of one kind of part.
fn part_grips(hand: &Hand, kind: usize, grips: &Grips) -> impl Iterator<Item = PartGrip> {
    grips.all.iter().map(move |grip| PartGrip {
        kind,
        grip: *grip,
        closed: grip.fingers(hand, &grips.object, -SQUEEZE * grips.object.width),
        open: let_go(hand, grip, &grips.object),
    })
}

/// The hand that has let go. What is so narrow that it stands between fingers 1 and 2 is wedged there by their grasp, and would leave with them
/// though the third finger has opened: these two go apart as well.
fn let_go(hand: &Hand, grip: &Grip, object: &Graspable) -> [f64; HAND_JOINTS] {
    let mut open = grip.open(hand, object);
    if object.flat.is_none() && object.width < WEDGED * hand.gap_aside() {
        open[0] += APART;
    }
    open
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use coact_robot::Robot;
    use std::path::Path;

    #[test]
    fn what_stands_between_the_fingers_comes_out_when_the_hand_lets_go() {
        let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
        let hand = Robot::load(&shipped.join("robots/aros.toml")).unwrap().hand;
        let task = Task::load(&shipped.join("tasks/toy-vehicle.toml")).unwrap();
        let table = GripTable::new(&hand, &task).unwrap();
        for PartGrip { kind, open, .. } in table.all() {
            let [one, two, _] = hand.ends(open);
            let between = (one.y - two.y).abs() - 2.0 * hand.pad[0];
            match task.kinds[*kind].name.as_str() {
                "nut" => assert!(between > task.kinds[*kind].width, "{between} m"),
                name => assert!((between - hand.gap_aside()).abs() < 1e-3, "{name}: {between} m"),
            }
        }
    }
}
