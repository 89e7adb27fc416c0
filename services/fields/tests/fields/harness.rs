//! A network with percepts made by hand.
#![allow(clippy::unwrap_used)]

use coact_fields::Network;
use coact_joint_task::{Agent, NetworkPlan, Task};
use coact_messages::{FieldFrame, LayerKind, NONE, PERSON, Percept};
use std::path::Path;

pub struct Harness {
    task: Task,
    network: Network,
    percept: Box<Percept>,
    frame: Box<FieldFrame>,
    next: Box<FieldFrame>,
    tick: u64,
}

impl Harness {
    pub fn of(task: &str) -> Self {
        Self::made(task, None)
    }

    /// With the learned connections of a file under `rt-config`.
    pub fn learned(task: &str, file: &str) -> Self {
        Self::made(task, Some(file))
    }

    fn made(task: &str, learned: Option<&str>) -> Self {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config/tasks");
        let (mut task, mut plan) = NetworkPlan::load(&folder.join(task).with_extension("toml")).unwrap();
        if let Some(learned) = learned {
            plan.learn(&mut task, &folder.join("..").join(learned)).unwrap();
        }
        Self::with(task, plan)
    }

    /// With the network of a task that is not shipped.
    pub fn with(task: Task, plan: NetworkPlan) -> Self {
        let network = Network::new(plan, task.fingerprint, 7).unwrap();
        let mut frame: Box<FieldFrame> = bytemuck::zeroed_box();
        network.rest(&mut frame);
        Self { task, network, percept: bytemuck::zeroed_box(), frame, next: bytemuck::zeroed_box(), tick: 0 }
    }

    pub fn task(&self) -> &Task {
        &self.task
    }

    /// Shows every part where the task lays it out.
    pub fn lay_out(&mut self) {
        for part in &self.task.parts {
            self.percept.workspace[part.workspace.index()].seen[part.kind] = 1.0;
        }
        for workspace in &mut self.percept.workspace {
            for kind in 0..self.task.kinds.len() {
                workspace.gone[kind] = 1.0 - workspace.seen[kind];
            }
        }
    }

    pub fn act(&mut self, name: &str, evidence: f64) {
        let act = (0..self.task.acts.len()).find(|&act| self.task.act_name(act) == name).unwrap();
        self.percept.act[act] = evidence;
    }

    pub fn act_at(&mut self, act: usize, evidence: f64) {
        self.percept.act[act] = evidence;
    }

    pub fn person_holds(&mut self, kind: &str, evidence: f64) {
        let kind = self.kind(kind);
        self.percept.person_holds[kind] = evidence;
    }

    pub fn robot_holds(&mut self, kind: &str, evidence: f64) {
        let kind = self.kind(kind);
        self.percept.robot_holds[kind] = evidence;
    }

    pub fn lost(&mut self, kind: &str, evidence: f64) {
        let kind = self.kind(kind);
        self.percept.lost[kind] = evidence;
    }

    pub fn error(&self) -> Option<String> {
        self.peaks(LayerKind::ErrorMonitoring).into_iter().next()
    }

    pub fn object(&mut self, workspace: Agent, kind: &str, seen: f64, gone: f64) {
        let kind = self.kind(kind);
        self.percept.workspace[workspace.index()].seen[kind] = seen;
        self.percept.workspace[workspace.index()].gone[kind] = gone;
    }

    /// The hand is on its way to a part of this kind, by its movement alone.
    pub fn bound_for(&mut self, kind: &str) {
        let (kind, [low, high]) = (self.kind(kind), self.task.scene.workspace[PERSON]);
        let middle = [0, 1].map(|axis| f64::midpoint(low[axis], high[axis]));
        let destinations = &mut self.percept.destinations;
        (destinations.told, destinations.count) = (1.0, 0);
        destinations.push(Some(kind), middle, 1.0);
        // Of its grip nothing is seen.
        self.percept.grips.count = self.task.grips.len() as u32;
        self.percept.grips.fit.fill(0.0);
    }

    /// The hand is on its way to a part of this kind, and looks like this grip.
    pub fn reaches_for(&mut self, kind: &str, grip: &str) {
        self.bound_for(kind);
        let grip = self.task.grips.iter().position(|own| own.name == grip).unwrap();
        let grips = &mut self.percept.grips;
        for (pitch, own) in grips.pitch.iter_mut().zip(&self.task.grips) {
            *pitch = own.pitch;
        }
        grips.fit[grip] = 1.0;
    }

    pub fn achieve(&mut self, subgoal: &str) {
        let subgoal = self.task.subgoals.iter().position(|candidate| candidate.name == subgoal).unwrap();
        (self.percept.achieved[subgoal], self.percept.open[subgoal]) = (1.0, 0.0);
    }

    /// The camera sees that the place of a subgoal is empty.
    pub fn undo(&mut self, subgoal: &str) {
        let subgoal = self.task.subgoals.iter().position(|candidate| candidate.name == subgoal).unwrap();
        (self.percept.achieved[subgoal], self.percept.open[subgoal]) = (0.0, 1.0);
    }

    /// Name of the kind of part that a subgoal needs.
    pub fn kind_of(&self, subgoal: &str) -> String {
        let subgoal = self.task.subgoals.iter().find(|candidate| candidate.name == subgoal).unwrap();
        self.task.kinds[subgoal.kind].name.clone()
    }

    /// Runs `ticks` ms with the percept as it stands.
    pub fn run(&mut self, ticks: u64) {
        for _ in 0..ticks {
            self.percept.header.cycle = self.tick;
            self.network.step(self.tick, Some(&self.percept), &self.frame, &mut self.next);
            std::mem::swap(&mut self.frame, &mut self.next);
            self.tick += 1;
        }
    }

    pub fn decision(&self) -> Option<String> {
        let action = self.frame.decision.action;
        (action != NONE).then(|| self.task.actions[action as usize].name.clone())
    }

    pub fn intention(&self) -> Option<String> {
        self.peaks(LayerKind::Intention).into_iter().next()
    }

    pub fn simulation(&self) -> Option<String> {
        self.peaks(LayerKind::ActionSimulation).into_iter().next()
    }

    pub fn available(&self) -> Vec<String> {
        self.peaks(LayerKind::SubgoalsAvailable)
    }

    pub fn peaks(&self, layer: LayerKind) -> Vec<String> {
        let plan = self.network.plan();
        let populations = plan.layer(layer).populations.clone();
        populations
            .filter(|&population| self.frame.signal[population] > 0.5)
            .map(|population| plan.populations[population].label.clone())
            .collect()
    }

    fn kind(&self, name: &str) -> usize {
        self.task.kinds.iter().position(|kind| kind.name == name).unwrap()
    }
}
