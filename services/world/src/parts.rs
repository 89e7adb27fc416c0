use coact_joint_task::{Fit, Part, Task};
use coact_messages::{MAX_PARTS, NONE, PartState};
use coact_person::{Holder, PartsView};
use coact_stage_state::{Implausible, ensure, finite};
use glam::{DQuat, DVec3};

/// How far before its socket a part begins to enter what it is mounted in, if it is aligned with it, m: more than the
/// longest axle and the deepest hole.
const ENTRY: f64 = 0.06;
/// How far other parts must be from where a part is put back, m: more than two parts are wide.
const HOME_CLEARANCE: f64 = 0.1;
/// How far below the table top a part has fallen off it, m. Not sensitive: nothing lies in between.
const FALLEN: f64 = 0.05;

/// All parts of the scene, and what becomes of a part that is let go.
#[derive(Debug, Clone)]
pub(crate) struct Parts {
    state: [PartState; MAX_PARTS],
    count: usize,
    /// Subgoals that are achieved whenever the scene is laid out, and the part of each.
    start: Vec<(usize, usize)>,
    /// How exactly a part must be in a socket to be mounted.
    fit: Fit,
}

impl Parts {
    /// Parts where the task lays them out; those of `start` (subgoals and their parts) in their sockets.
    pub fn new(task: &Task, start: Vec<(usize, usize)>, fit: Fit) -> Self {
        let state = [PartState::default(); MAX_PARTS];
        let mut parts = Self { state, count: task.parts.len(), start, fit };
        parts.lay_out(task);
        parts
    }

    /// Puts every part back to where it was at the start.
    pub fn lay_out(&mut self, task: &Task) {
        for (state, part) in self.state.iter_mut().zip(&task.parts) {
            *state = PartState {
                position: [part.at[0], part.at[1], task.scene.table_height],
                orientation: DQuat::IDENTITY.into(),
                velocity: [0.0; 3],
                kind: part.kind as u32,
                state: Holder::Nobody as u32,
                subgoal: NONE,
                reserved: 0,
            };
        }
        for index in 0..self.start.len() {
            let (subgoal, part) = self.start[index];
            self.mount(part, subgoal, task);
        }
    }

    /// Takes over where the parts were, unless one of them is where or what it cannot be.
    pub fn restore(&mut self, state: &[PartState; MAX_PARTS], task: &Task) -> Result<(), Implausible> {
        for (part, laid) in state.iter().zip(&task.parts) {
            finite("part: place", &[part.position, part.velocity].concat())?;
            let is_turn = DQuat::from_array(part.orientation).is_normalized();
            ensure(is_turn, "part.orientation", "a unit quaternion")?;
            ensure(part.kind as usize == laid.kind, "part.kind", "that of the task")?;
            ensure(part.state <= Holder::Socket as u32, "part.state", "0, 1, 2 or 3")?;
            let is_somewhere =
                part.state != Holder::Socket as u32 || (part.subgoal as usize) < task.subgoals.len();
            ensure(is_somewhere, "part.subgoal", "a subgoal of the task for a mounted part")?;
        }
        self.state = *state;
        Ok(())
    }

    pub fn all(&self) -> &[PartState] {
        &self.state[..self.count]
    }

    pub fn row(&self) -> &[PartState; MAX_PARTS] {
        &self.state
    }

    /// The parts as anybody can see them.
    pub fn view(&self) -> PartsView<'_> {
        PartsView::new(self.all())
    }

    pub fn kind(&self, part: usize) -> usize {
        self.view().kind(part)
    }

    pub fn is(&self, part: usize, holder: Holder) -> bool {
        self.view().is(part, holder)
    }

    pub fn give_to(&mut self, part: usize, holder: Holder) {
        self.state[part].state = holder as u32;
    }

    pub fn position(&self, part: usize) -> DVec3 {
        self.view().position(part)
    }

    pub fn orientation(&self, part: usize) -> DQuat {
        self.view().orientation(part)
    }

    pub fn place(&mut self, part: usize, position: DVec3, orientation: DQuat) {
        self.state[part].position = position.into();
        self.state[part].orientation = orientation.into();
    }

    /// Places a part that moves, velocity in m/s.
    pub fn move_to(&mut self, part: usize, position: DVec3, orientation: DQuat, velocity: [f64; 3]) {
        self.place(part, position, orientation);
        self.state[part].velocity = velocity;
    }

    /// Distance of `point` from the part's own axis, between its underside and its top, m.
    pub fn distance_to_axis(&self, part: usize, point: DVec3, task: &Task) -> f64 {
        self.view().distance_to_axis(part, point, task)
    }

    /// Bit i is set when subgoal i's part is in its place.
    pub fn achieved(&self) -> u64 {
        self.view().achieved()
    }

    /// Bit i is set when part i is with `holder`.
    pub fn held_by(&self, holder: Holder) -> u64 {
        (0..self.count).filter(|&part| self.is(part, holder)).fold(0, |mask, part| mask | 1 << part)
    }

    /// A part that nobody holds any more is mounted in the free socket of its kind that it fits into, or drops.
    pub fn let_go(&mut self, part: usize, task: &Task) {
        match self.socket_of(part, task) {
            Some(subgoal) => self.mount(part, subgoal, task),
            None => self.drop(part, task),
        }
    }

    fn socket_of(&self, part: usize, task: &Task) -> Option<usize> {
        let distance = |index: &usize| self.position(part).distance(task.subgoals[*index].socket.into());
        self.sockets_ahead(part, task)
            .filter(|index| distance(index) <= self.fit.position)
            .min_by(|one, other| distance(one).total_cmp(&distance(other)))
    }

    /// Whether a part is about to enter a socket: on its axis and along it, within tolerance, and no farther off than
    /// a hole is deep or an axle long.
    pub fn enters(&self, part: usize, task: &Task) -> bool {
        self.sockets_ahead(part, task).any(|index| {
            let goal = &task.subgoals[index];
            let offset = self.position(part) - DVec3::from(goal.socket);
            let along = offset.dot(goal.axis.into());
            let aside = (offset - along * DVec3::from(goal.axis)).length();
            aside <= self.fit.position && (-self.fit.position..ENTRY).contains(&along)
        })
    }

    /// Free sockets of a part's kind with whose axes it is aligned, within tolerance.
    fn sockets_ahead<'a>(&self, part: usize, task: &'a Task) -> impl Iterator<Item = usize> + use<'a> {
        let (achieved, kind, fit) = (self.achieved(), self.kind(part), self.fit);
        let own = self.orientation(part) * DVec3::Z;
        let fits = move |axis: [f64; 3]| own.angle_between(axis.into()) <= fit.angle;
        (0..task.subgoals.len()).filter(move |&index| {
            let goal = &task.subgoals[index];
            goal.kind == kind && achieved & (1 << index) == 0 && fits(goal.axis)
        })
    }

    /// Mounts every loose part that has come to stand in a socket.
    pub fn settle(&mut self, task: &Task) {
        for part in 0..self.count {
            if self.is(part, Holder::Nobody) {
                self.let_go(part, task);
            }
        }
    }

    /// Whether a free part lies where neither of the two can take it from.
    pub fn is_stray(&self, part: usize, task: &Task) -> bool {
        let at = self.state[part].position;
        let within =
            |[low, high]: &[[f64; 2]; 2]| (0..2).all(|axis| at[axis] >= low[axis] && at[axis] <= high[axis]);
        let fallen = at[2] < task.scene.table_height - FALLEN;
        self.is(part, Holder::Nobody) && (fallen || !task.scene.workspace.iter().any(within))
    }

    /// Puts a part back to where the task lays it out, or where other parts lie there, as near to it as its workspace has room.
    pub fn put_back(&mut self, part: usize, task: &Task) {
        let Part { at: [x, y], workspace, .. } = task.parts[part];
        let home = DVec3::new(x, y, task.scene.table_height);
        let room = |place: &DVec3| {
            let mut others = (0..self.count).filter(|other| *other != part);
            others.all(|other| self.position(other).distance(*place) >= HOME_CLEARANCE)
        };
        let away = |place: &DVec3| place.distance(home);
        let around = grid(task.scene.workspace[workspace.index()], task.scene.table_height);
        let places = std::iter::once(home).chain(around).filter(room);
        if let Some(place) = places.min_by(|one, other| away(one).total_cmp(&away(other))) {
            self.move_to(part, place, DQuat::IDENTITY, [0.0; 3]);
        }
    }

    fn mount(&mut self, part: usize, subgoal: usize, task: &Task) {
        let goal = &task.subgoals[subgoal];
        self.place(part, goal.socket.into(), upright_along(goal.axis.into()));
        self.state[part].state = Holder::Socket as u32;
        self.state[part].subgoal = subgoal as u32;
    }

    /// Leaves the part where it is, free: without dynamics it rests upright on what is below.
    pub fn drop(&mut self, part: usize, task: &Task) {
        self.state[part].state = Holder::Nobody as u32;
        self.state[part].subgoal = NONE;
        let at = self.position(part);
        debug_assert!(at.is_finite(), "part {part} of {} is nowhere", task.name);
    }

    /// Rests all free parts upright on what is below them (for a robot without dynamics).
    pub fn rest_free(&mut self, task: &Task) {
        for part in 0..self.count {
            if self.is(part, Holder::Nobody) {
                self.rest(part, task);
            }
        }
    }

    fn rest(&mut self, part: usize, task: &Task) {
        let scene = &task.scene;
        let at = self.position(part);
        let base = DVec3::from(scene.platform);
        let on_base = (at - base).truncate().length() < scene.platform_radius;
        let height = if on_base { base.z + scene.platform_height } else { scene.table_height };
        self.place(part, DVec3::new(at.x, at.y, height), DQuat::IDENTITY);
    }
}

/// Places all over a workspace, m.
fn grid([low, high]: [[f64; 2]; 2], height: f64) -> impl Iterator<Item = DVec3> {
    let steps = move |axis: usize| {
        let count = ((high[axis] - low[axis]) / HOME_CLEARANCE).max(0.0) as u32;
        (0..=count).map(move |step| low[axis] + HOME_CLEARANCE * f64::from(step))
    };
    steps(0).flat_map(move |x| steps(1).map(move |y| DVec3::new(x, y, height)))
}

/// The shortest turn that brings a part's own z axis onto `axis`.
fn upright_along(axis: DVec3) -> DQuat {
    DQuat::from_rotation_arc(DVec3::Z, axis.normalize_or(DVec3::Z))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use std::path::Path;

    fn laid_out() -> (Task, Parts) {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks/toy-vehicle.toml");
        let task = Task::load(&file).unwrap();
        let parts = Parts::new(&task, Vec::new(), task.scene.fit);
        (task, parts)
    }

    #[test]
    fn a_part_that_fell_is_put_where_it_lay_or_beside_what_lies_there_now() {
        let (task, laid) = laid_out();
        for part in 0..task.parts.len() {
            let home = laid.position(part);
            for intruder in 0..task.parts.len() {
                let mut parts = laid.clone();
                parts.place(intruder, home + DVec3::new(0.01, 0.0, 0.0), DQuat::IDENTITY);
                parts.place(part, DVec3::new(0.0, 3.0, -40.0), DQuat::IDENTITY);
                parts.put_back(part, &task);
                let at = parts.position(part);
                assert!(!parts.is_stray(part, &task), "part {part} at {at}");
                assert_eq!(at == home, intruder == part, "part {part}, where {intruder} lies, at {at}");
                let mut others = (0..task.parts.len()).filter(|other| *other != part);
                assert!(others.all(|other| parts.position(other).distance(at) >= HOME_CLEARANCE));
            }
        }
    }
}
