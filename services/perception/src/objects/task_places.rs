use super::holders::PartSize;
use super::part_track::{BY_PERSON, BY_ROBOT, PartTrack};
use super::{PartTracks, Sight};
use crate::evidence::approach;
use coact_joint_task::{Scene, Subgoal, Task};
use coact_messages::{MAX_SUBGOALS, PERSON, Percept, ROBOT, SceneView, WORKSPACES};
use coact_period::cycles;
use nalgebra::Vector3;
use std::time::Duration;

/// How near a part must be to its socket to be in it, m: parts that stand beside theirs lie farther off, and sightings
/// of a still part, which are averaged, scatter by a few mm.
const IN_PLACE: f64 = 0.014;
/// A socket is empty when no part of its kind is nearer, m. Larger than the above: a part that is being inserted makes the
/// socket neither achieved nor open.
const EMPTY: f64 = 0.05;
/// How far beyond its rectangle a workspace still reaches, m: a part that was laid down at its edge. Chosen by hand.
const BEYOND_EDGE: f64 = 0.03;
/// How high above the table top a part may be and still lie on it, m: on another flat one. Chosen by hand.
const ON_TABLE: f64 = 0.05;
/// Age up to which a sighting tells where the part is now: nine frames of the recogniser, which misses single ones.
const RECENT: u64 = cycles(Duration::from_millis(300));
/// Time in which evidence about parts rises or falls from end to end, cycles: two frames of the recogniser.
const RAMP: f64 = cycles(Duration::from_millis(60)) as f64;
/// Time in which evidence that the person has achieved a step rises from end to end, cycles. Chosen by hand: the hand that has let go of the part
/// is to be forgotten by then in the mind, or what it did is taken for the next step of the same kind of part.
const ACHIEVES: f64 = cycles(Duration::from_millis(200)) as f64;

/// The places of the task: workspaces, sockets, and what each kind of part is like.
#[derive(Debug, Clone)]
pub(crate) struct TaskPlaces {
    scene: Scene,
    subgoals: Vec<Subgoal>,
    sizes: Vec<PartSize>,
    /// How many parts there are of each kind, where that is known.
    counts: Vec<Option<usize>>,
}

impl TaskPlaces {
    /// What the robot's eye sees in a frame.
    pub fn sight<'a>(&self, view: &'a SceneView) -> Sight<'a> {
        Sight { view, eye: self.scene.eye() }
    }

    pub fn new(task: &Task) -> Self {
        let size =
            |kind: &coact_joint_task::Kind| PartSize { width: kind.width, height: kind.shape.height() };
        Self {
            scene: task.scene.clone(),
            subgoals: task.subgoals.clone(),
            sizes: task.kinds.iter().map(size).collect(),
            counts: (0..task.kinds.len()).map(|kind| task.count(kind)).collect(),
        }
    }

    pub fn kinds(&self) -> usize {
        self.sizes.len()
    }

    pub fn size(&self, kind: usize) -> PartSize {
        self.sizes[kind]
    }

    /// How many parts of `kind` there are, if that is known.
    pub fn count(&self, kind: usize) -> Option<usize> {
        self.counts[kind]
    }

    /// Whether a part of `kind` at `position` lies neither on the table nor in a socket.
    pub fn is_airborne(&self, kind: usize, position: [f64; 3]) -> bool {
        position[2] > self.scene.table_height + ON_TABLE && self.socket_at(kind, position).is_none()
    }

    /// Whether a part of `kind` at `position` is in a socket.
    pub fn is_mounted(&self, kind: usize, position: [f64; 3]) -> bool {
        self.socket_at(kind, position).is_some()
    }

    /// The subgoal of `kind` in whose socket `position` lies.
    fn socket_at(&self, kind: usize, position: [f64; 3]) -> Option<usize> {
        let away = |goal: &Subgoal| (Vector3::from(goal.socket) - Vector3::from(position)).norm();
        let near = |goal: &Subgoal| goal.kind == kind && away(goal) < IN_PLACE;
        self.subgoals.iter().position(near)
    }

    /// The workspace in which a part at `position` lies.
    fn workspace_at(&self, position: [f64; 3]) -> Option<usize> {
        (0..WORKSPACES).find(|&side| {
            let [low, high] = self.scene.workspace[side];
            let inside = (0..2).all(|axis| {
                position[axis] >= low[axis] - BEYOND_EDGE && position[axis] <= high[axis] + BEYOND_EDGE
            });
            inside && position[2] < self.scene.table_height + ON_TABLE
        })
    }

    /// Whether a part lies free in the workspace of `side`: in nobody's hand, not mounted.
    pub fn is_free_at(&self, side: usize, kind: usize, track: &PartTrack) -> bool {
        let mounted = self.socket_at(kind, track.position).is_some();
        !track.is_held() && !mounted && self.workspace_at(track.position) == Some(side)
    }

    /// Moves all evidence about parts and places one cycle on; `followed`: what the person's hand does is known.
    pub fn report(&self, tick: u64, parts: &PartTracks, sight: &Sight, followed: bool, out: &mut Percept) {
        if !parts.is_seeing(tick) {
            return;
        }
        let since = tick.saturating_sub(RECENT - 1);
        for kind in 0..self.kinds() {
            (0..WORKSPACES).for_each(|side| self.report_workspace(since, side, kind, parts, sight, out));
            let holds = |bit: u32| parts.parts().any(|(own, part)| own == kind && part.holder & bit != 0);
            approach(&mut out.robot_holds[kind], holds(BY_ROBOT), RAMP);
            approach(&mut out.person_holds[kind], holds(BY_PERSON), RAMP);
        }
        for goal in 0..self.subgoals.len().min(MAX_SUBGOALS) {
            self.report_subgoal(since, goal, parts, sight, followed, out);
        }
    }

    /// Whether each part of `kind` that there is has been seen in the cycle `since` or later, wherever it is.
    pub fn are_all_seen(&self, kind: usize, parts: &PartTracks, since: u64) -> bool {
        let seen = |(own, part): &(usize, &PartTrack)| *own == kind && part.seen >= since;
        self.count(kind).is_some_and(|count| parts.parts().filter(seen).count() >= count)
    }

    fn report_workspace(
        &self,
        since: u64,
        side: usize,
        kind: usize,
        parts: &PartTracks,
        sight: &Sight,
        out: &mut Percept,
    ) {
        let here = |(own, part): &(usize, &PartTrack)| *own == kind && self.is_free_at(side, kind, part);
        let away = |part: &PartTrack| (Vector3::from(part.position) - self.owner(side)).norm();
        let nearest = parts.parts().filter(here).min_by(|(_, a), (_, b)| away(a).total_cmp(&away(b)));
        let place = &mut out.workspace[side];
        let seen = nearest.is_some_and(|(_, part)| part.seen >= since);
        if let Some((_, part)) = nearest {
            place.position[kind] = part.position;
            place.orientation[kind] = part.orientation.map(f64::from);
        }
        let last = self.last_place(side, place.position[kind]);
        let is_bare = || !sight.hides(Vector3::from(last) + Vector3::z() * self.size(kind).height);
        let gone = nearest.is_none() && (is_bare() || self.are_all_seen(kind, parts, since));
        approach(&mut place.seen[kind], seen, RAMP);
        approach(&mut place.gone[kind], gone, RAMP);
    }

    /// Where a part was last known to lie; the middle of the workspace when it never was.
    fn last_place(&self, side: usize, known: [f64; 3]) -> [f64; 3] {
        if self.workspace_at(known) == Some(side) {
            return known;
        }
        let [low, high] = self.scene.workspace[side];
        [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), self.scene.table_height]
    }

    /// Where the owner of a workspace is: the person's hand at rest; the robot stands at the world's origin.
    fn owner(&self, side: usize) -> Vector3<f64> {
        match side {
            PERSON => self.scene.person_rest.into(),
            ROBOT => Vector3::new(0.0, 0.0, self.scene.table_height),
            _ => Vector3::zeros(),
        }
    }

    fn report_subgoal(
        &self,
        since: u64,
        goal: usize,
        parts: &PartTracks,
        sight: &Sight,
        followed: bool,
        out: &mut Percept,
    ) {
        let Subgoal { kind, socket, axis, .. } = self.subgoals[goal];
        let away = |part: &PartTrack| (Vector3::from(socket) - Vector3::from(part.position)).norm();
        let own = parts.parts().filter(|(own, _)| *own == kind);
        let mounted = |part: &PartTrack| away(part) < IN_PLACE && part.has_settled(followed);
        let achieved = own.clone().find(|(_, part)| mounted(part));
        let rise = if achieved.is_some_and(|(_, part)| !part.is_put_by_robot()) { ACHIEVES } else { RAMP };
        let face = Vector3::from(socket) + Vector3::from(axis) * self.size(kind).height;
        let is_known = || !sight.hides(face) || self.are_all_seen(kind, parts, since);
        let empty = !own.clone().any(|(_, part)| away(part) < EMPTY) && is_known();
        approach(&mut out.achieved[goal], achieved.is_some(), rise);
        approach(&mut out.open[goal], empty, RAMP);
    }
}
