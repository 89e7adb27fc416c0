use coact_joint_task::Task;
use coact_messages::{Decision, FieldFrame, LayerKind, NONE, Speech, Truth};
use coact_run_records::Event;

/// Follows the task: subgoals, assemblies, decisions, utterances, and achieved subgoals that the fields lost.
#[derive(Debug)]
pub struct TaskWatch {
    task: Task,
    /// Subgoals of the present assembly that are in their place (truth), bit for bit.
    achieved: u64,
    /// Subgoals with a peak in the layer of achieved subgoals, bit for bit.
    remembered: u64,
    /// Subgoals of the assembly with this number that the robot has perceived to be achieved, bit for bit.
    perceived: (u64, u64),
    /// Assemblies completed.
    completed: u64,
    decision: Decision,
    /// Cycle of the newest sentence.
    spoken: u64,
}

impl TaskWatch {
    /// For a task.
    pub fn new(task: &Task) -> Self {
        let decision = Decision { action: NONE, reserved: 0, since: 0 };
        Self {
            task: task.clone(),
            achieved: 0,
            remembered: 0,
            perceived: (0, 0),
            completed: 0,
            decision,
            spoken: 0,
        }
    }

    /// Goes on after a restart from the events that were written before.
    pub fn resume(&mut self, events: &[Event]) {
        for event in events {
            match event {
                Event::Subgoal { subgoal, assembly, .. } if *assembly == self.completed => {
                    self.achieved |= 1 << subgoal;
                }
                Event::Perceived { subgoal, assembly, .. } => {
                    self.perceive(*assembly, 1 << subgoal);
                }
                Event::Assembly { completed, .. } => (self.completed, self.achieved) = (*completed, 0),
                Event::Decision { at_ms, action } => {
                    let index = self.task.actions.iter().position(|own| own.name == *action);
                    self.decision.action = index.map_or(NONE, |index| index as u32);
                    self.decision.since = *at_ms;
                }
                Event::Utterance { at_ms, .. } => self.spoken = *at_ms,
                _ => {}
            }
        }
    }

    /// What was really achieved; events are appended to `events`.
    pub fn truth(&mut self, truth: &Truth, events: &mut Vec<Event>) {
        let at_ms = truth.header.cycle;
        if truth.assemblies > self.completed {
            self.complete(truth.assemblies, at_ms, events);
        }
        if truth.assemblies < self.completed {
            return; // complete, and not yet laid out again
        }
        for (subgoal, goal) in self.task.subgoals.iter().enumerate() {
            let bit = 1 << subgoal;
            if truth.achieved & bit != 0 && self.achieved & bit == 0 {
                self.achieved |= bit;
                let (assembly, name) = (truth.assemblies, goal.name.clone());
                events.push(Event::Subgoal { at_ms, assembly, subgoal, name });
            }
        }
        if self.task.is_complete(self.achieved) {
            self.complete(truth.assemblies + 1, at_ms, events);
        }
    }

    /// What the fields show; `truth` tells a peak that was lost from one that ended because its subgoal is open again.
    pub fn frame(&mut self, frame: &FieldFrame, truth: &Truth, events: &mut Vec<Event>) {
        if frame.decision != self.decision {
            self.decision = frame.decision;
            if let Some(action) = self.task.actions.get(frame.decision.action as usize) {
                events.push(Event::Decision { at_ms: frame.decision.since, action: action.name.clone() });
            }
        }
        let mut remembered = 0;
        for (subgoal, population) in frame.populations(LayerKind::SubgoalsAchieved).enumerate().take(64) {
            remembered |= u64::from(frame.since[population] != 0) << subgoal;
        }
        let lost = self.remembered & !remembered & truth.achieved;
        // What stands for a part that the scene was just laid out without is of the assembly before.
        let new = self.perceive(truth.assemblies, remembered & !self.remembered);
        self.remembered = remembered;
        let populations = frame.populations(LayerKind::SubgoalsAchieved);
        for ((subgoal, goal), population) in self.task.subgoals.iter().enumerate().zip(populations) {
            if new & (1 << subgoal) != 0 {
                let (at_ms, assembly, name) = (frame.since[population], truth.assemblies, goal.name.clone());
                events.push(Event::Perceived { at_ms, assembly, subgoal, name });
            }
            if lost & (1 << subgoal) != 0 {
                events.push(Event::Forgotten { at_ms: frame.header.cycle, name: goal.name.clone() });
            }
        }
    }

    /// Notes which subgoals are perceived in an assembly; those that were not before.
    fn perceive(&mut self, assembly: u64, subgoals: u64) -> u64 {
        if assembly != self.perceived.0 {
            self.perceived = (assembly, 0);
        }
        let new = subgoals & !self.perceived.1;
        self.perceived.1 |= subgoals;
        new
    }

    /// What the robot said; a reader that connects gets the last sentence once more, which is not news.
    pub fn speech(&mut self, speech: &Speech, events: &mut Vec<Event>) {
        if speech.header.cycle <= self.spoken {
            return;
        }
        self.spoken = speech.header.cycle;
        let text = speech.sentence().to_owned();
        events.push(Event::Utterance { at_ms: speech.header.cycle, text });
    }

    fn complete(&mut self, completed: u64, at_ms: u64, events: &mut Vec<Event>) {
        (self.completed, self.achieved) = (completed, 0);
        events.push(Event::Assembly { at_ms, completed });
    }
}
