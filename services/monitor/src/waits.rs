use crate::ActiveAgents;
use coact_joint_task::{Agent, Task};
use coact_messages::{Command, Truth};
use coact_run_records::{Event, WaitEvent, Waiting};

/// Follows who waits for whom, as [`ActiveAgents`] has it: each wait is an event once it is over.
#[derive(Debug)]
pub struct Waits {
    task: Task,
    /// By [`Agent::index`].
    open: [Option<WaitEvent>; 2],
}

impl Waits {
    /// For a task.
    pub fn new(task: &Task) -> Self {
        Self { task: task.clone(), open: [const { None }; 2] }
    }

    /// What is true in a cycle, and what the arm is commanded; waits that are over are appended to `events`.
    pub fn tick(&mut self, truth: &Truth, command: &Command, events: &mut Vec<Event>) {
        let waits = ActiveAgents::now(&self.task, truth, command).waits;
        let action = self.task.actions.get(command.action as usize).and_then(|action| action.subgoal);
        let meant = Some(truth.subgoal as usize);
        for (agent, who, subgoal) in
            [(Agent::Robot, Waiting::Robot, action.or(meant)), (Agent::Person, Waiting::Person, meant)]
        {
            let open = &mut self.open[agent.index()];
            if !waits[agent.index()] {
                events.extend(open.take().map(Event::Wait));
                continue;
            }
            let goal = subgoal.and_then(|subgoal| self.task.subgoals.get(subgoal));
            let at_ms = truth.header.cycle;
            let begun = || WaitEvent { who, from_ms: at_ms, until_ms: at_ms, subgoal: String::new() };
            let wait = open.get_or_insert_with(begun);
            wait.until_ms = at_ms + 1;
            // What the person means is known only when it is done.
            if let Some(goal) = goal.filter(|_| wait.subgoal.is_empty()) {
                wait.subgoal.clone_from(&goal.name);
            }
        }
    }

    /// The run is over, and with it what still lasts.
    pub fn finish(&mut self, events: &mut Vec<Event>) {
        events.extend(self.open.iter_mut().filter_map(Option::take).map(Event::Wait));
    }
}
