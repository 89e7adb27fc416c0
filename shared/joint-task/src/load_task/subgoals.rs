use super::TaskReader;
use crate::task_file::SubgoalEntry;
use crate::{Choice, Subgoal, TaskError};
use coact_messages::MAX_SUBGOALS;

impl TaskReader<'_> {
    /// The plan.
    pub(super) fn subgoals(&self) -> Result<Vec<Subgoal>, TaskError> {
        self.within("subgoal", self.file.subgoal.len(), MAX_SUBGOALS, "subgoals")?;
        let names = self.file.subgoal.iter().map(|subgoal| &subgoal.name);
        self.distinct("subgoal", names.clone())?;
        // A step may come after either.
        self.distinct("subgoal or choice", names.chain(self.file.choice.iter().map(|choice| &choice.name)))?;
        self.file.subgoal.iter().enumerate().map(|(index, entry)| self.subgoal(index, entry)).collect()
    }

    fn subgoal(&self, index: usize, entry: &SubgoalEntry) -> Result<Subgoal, TaskError> {
        let count = self.file.subgoal.len();
        let names = self.file.subgoal.iter().map(|subgoal| &subgoal.name);
        let names = names.chain(self.file.choice.iter().map(|choice| &choice.name));
        let before =
            entry.after.iter().map(|name| self.find(&format!("subgoal[{index}].after"), name, names.clone()));
        let before = before.collect::<Result<Vec<_>, _>>()?;
        let (after, choices): (Vec<_>, Vec<_>) = before.into_iter().partition(|&before| before < count);
        let length = entry.socket.axis.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length < 1e-6 || !length.is_finite() {
            let key = format!("subgoal[{index}].socket.axis");
            return Err(self.source.error(
                entry.socket.at.span(),
                key,
                "expected a direction, e.g. [0, 0, 1]",
            ));
        }
        Ok(Subgoal {
            name: entry.name.get_ref().clone(),
            kind: self.kind(&format!("subgoal[{index}].kind"), &entry.kind)?,
            side: entry.side,
            socket: *entry.socket.at.get_ref(),
            axis: entry.socket.axis.map(|x| x / length),
            steadied: entry.steadied,
            after,
            after_choices: choices.into_iter().map(|choice| choice - count).collect(),
        })
    }

    /// Refuses a plan in which a subgoal waits for itself, whatever is chosen.
    pub(super) fn acyclic(&self, subgoals: &[Subgoal], choices: &[Choice]) -> Result<(), TaskError> {
        let mut done = vec![false; subgoals.len()];
        for _ in 0..subgoals.len() {
            for (index, Subgoal { after, after_choices, .. }) in subgoals.iter().enumerate() {
                let mut offered = after_choices.iter().flat_map(|&choice| &choices[choice].of);
                done[index] |=
                    after.iter().all(|&before| done[before]) && offered.all(|&before| done[before]);
            }
        }
        match done.iter().position(|&done| !done) {
            None => Ok(()),
            Some(index) => Err(self.source.error(
                self.file.subgoal[index].name.span(),
                format!("subgoal[{index}].after"),
                "the plan runs in a circle here; expected a partial order",
            )),
        }
    }
}
