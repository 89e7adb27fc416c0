use crate::source_file::SourceFile;
use crate::task_file::TaskFile;
use crate::{Agent, NetworkPlan, Task, TaskError};
use std::ops::Range;
use std::path::Path;

/// A task under examination: what it says, and where each thing stands in its file.
pub(super) struct ExaminedTask {
    source: SourceFile,
    pub file: TaskFile,
    pub task: Task,
    pub plan: NetworkPlan,
    /// `needs[a * subgoals + b]`: a needs b, directly or not, if b is chosen.
    needs: Vec<bool>,
}

impl ExaminedTask {
    pub fn load(path: &Path) -> Result<Self, TaskError> {
        let (task, plan) = NetworkPlan::load(path)?;
        let source = SourceFile::read(path)?;
        let file = source.parse()?;
        let needs = needs(&task);
        Ok(Self { source, file, task, plan, needs })
    }

    /// File and line of a part of the file.
    pub fn place(&self, span: Range<usize>) -> String {
        let error = self.source.error(span, "", "");
        format!("{}:{}", error.file, error.line)
    }

    pub fn place_of_subgoal(&self, subgoal: usize) -> String {
        self.place(self.file.subgoal[subgoal].name.span())
    }

    /// The rule of the file that made a chain: one for each kind of part.
    pub fn place_of_chain(&self, chain: usize) -> String {
        self.place(self.file.chain[self.rule_of(chain)].name.span())
    }

    pub fn rule_of(&self, chain: usize) -> usize {
        chain / self.task.kinds.len()
    }

    pub fn subgoals(&self) -> Range<usize> {
        0..self.task.subgoals.len()
    }

    /// Whether the two can be open at the same time: neither needs the other.
    pub fn concur(&self, one: usize, other: usize) -> bool {
        let needs = |a: usize, b: usize| self.needs[a * self.task.subgoals.len() + b];
        one == other || !(needs(one, other) || needs(other, one))
    }

    /// How many parts of `kind` lie in the workspace of `owner` at the start.
    pub fn parts(&self, kind: usize, owner: Agent) -> usize {
        self.task.parts.iter().filter(|part| part.kind == kind && part.workspace == owner).count()
    }

    /// The subgoals that a chain can serve, with parts that lie where it begins.
    pub fn served(&self, chain: usize) -> impl Iterator<Item = usize> {
        let chain = &self.task.chains[chain];
        let possible = self.parts(chain.kind, chain.from) > 0;
        let goals = &self.task.subgoals;
        let serves = move |goal: &usize| goals[*goal].kind == chain.kind && goals[*goal].side == chain.side;
        self.subgoals().filter(move |goal| possible && serves(goal))
    }
}

fn needs(task: &Task) -> Vec<bool> {
    let count = task.subgoals.len();
    let mut needs = vec![false; count * count];
    for _ in 0..count {
        for (goal, subgoal) in task.subgoals.iter().enumerate() {
            let offered = subgoal.after_choices.iter().flat_map(|&choice| &task.choices[choice].of);
            for &before in subgoal.after.iter().chain(offered) {
                needs[goal * count + before] = true;
                for other in 0..count {
                    needs[goal * count + other] |= needs[before * count + other];
                }
            }
        }
    }
    needs
}
