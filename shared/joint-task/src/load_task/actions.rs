use super::TaskReader;
use crate::task_file::{ActionEntry, Each};
use crate::{Action, Kind, Subgoal, TaskError};

impl TaskReader<'_> {
    /// The actions that each rule makes.
    pub(super) fn actions(&self, kinds: &[Kind], subgoals: &[Subgoal]) -> Result<Vec<Action>, TaskError> {
        self.distinct("action", self.file.action.iter().map(|action| &action.name))?;
        Ok(self.file.action.iter().flat_map(|entry| expand(entry, kinds, subgoals)).collect())
    }
}

fn expand(entry: &ActionEntry, kinds: &[Kind], subgoals: &[Subgoal]) -> Vec<Action> {
    let rule = entry.name.get_ref();
    let named = |object: &str, kind, subgoal| Action {
        name: format!("{rule}: {object}"),
        rule: rule.clone(),
        action_type: entry.action_type,
        kind: Some(kind),
        subgoal,
    };
    match entry.each {
        Each::Once => vec![Action {
            name: rule.clone(),
            rule: rule.clone(),
            action_type: entry.action_type,
            kind: None,
            subgoal: None,
        }],
        Each::Kind => kinds.iter().enumerate().map(|(index, kind)| named(&kind.name, index, None)).collect(),
        Each::Subgoal => subgoals
            .iter()
            .enumerate()
            .filter(|(_, subgoal)| entry.side.is_none_or(|side| side == subgoal.side))
            .map(|(index, subgoal)| named(&subgoal.name, subgoal.kind, Some(index)))
            .collect(),
    }
}
