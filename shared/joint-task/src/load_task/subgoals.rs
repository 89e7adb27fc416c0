use super::TaskReader;
use crate::task_file::SubgoalEntry;
use crate::{Subgoal, TaskError};
use coact_messages::MAX_SUBGOALS;

impl TaskReader<'_> {
    /// The plan.
    pub(super) fn subgoals(&self) -> Result<Vec<Subgoal>, TaskError> {
        self.within("subgoal", self.file.subgoal.len(), MAX_SUBGOALS, "subgoals")?;
        self.distinct("subgoal", self.file.subgoal.iter().map(|subgoal| &subgoal.name))?;
        let subgoals = self
            .file
            .subgoal
            .iter()
            .enumerate()
            .map(|(index, entry)| self.subgoal(index, entry))
            .collect::<Result<Vec<_>, _>>()?;
        self.acyclic(&subgoals)?;
        Ok(subgoals)
    }

    fn subgoal(&self, index: usize, entry: &SubgoalEntry) -> Result<Subgoal, TaskError> {
        let names = self.file.subgoal.iter().map(|subgoal| &subgoal.name);
        let after = entry
            .after
            .iter()
            .map(|name| self.find(&format!("subgoal[{index}].after"), name, names.clone()))
            .collect::<Result<Vec<_>, _>>()?;
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
        })
    }

    /// Refuses a plan in which a subgoal waits for itself.
    fn acyclic(&self, subgoals: &[Subgoal]) -> Result<(), TaskError> {
        let mut done = vec![false; subgoals.len()];
        for _ in 0..subgoals.len() {
            for (index, subgoal) in subgoals.iter().enumerate() {
                done[index] |= subgoal.after.iter().all(|&before| done[before]);
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
