use super::TaskReader;
use crate::task_file::ChoiceEntry;
use crate::{Choice, Subgoal, TaskError};
use coact_messages::MAX_SUBGOALS;

impl TaskReader<'_> {
    /// The plan's alternatives, among its `subgoals`.
    pub(super) fn choices(&self, subgoals: &[Subgoal]) -> Result<Vec<Choice>, TaskError> {
        let entries = &self.file.choice;
        if !entries.is_empty() {
            self.within("choice", entries.len(), MAX_SUBGOALS, "choices")?;
        }
        let numbered = || entries.iter().enumerate();
        let members =
            numbered().map(|(index, entry)| self.members(index, entry)).collect::<Result<Vec<_>, _>>()?;
        self.once_each(&members)?;
        let choice = |(index, entry): (usize, &ChoiceEntry)| Choice {
            name: entry.name.get_ref().clone(),
            of: members[index].clone(),
            count: *entry.count.get_ref(),
            spares: spares(index, &members, subgoals),
        };
        let choices: Vec<Choice> = numbered().map(choice).collect();
        self.never_waits_for_what_is_spared(subgoals, &choices)?;
        Ok(choices)
    }

    /// The subgoals that a choice offers: more than are enough.
    fn members(&self, index: usize, entry: &ChoiceEntry) -> Result<Vec<usize>, TaskError> {
        let names = self.file.subgoal.iter().map(|subgoal| &subgoal.name);
        let key = format!("choice[{index}].of");
        let of = entry.of.iter().map(|name| self.find(&key, name, names.clone()));
        let of = of.collect::<Result<Vec<_>, _>>()?;
        let count = *entry.count.get_ref();
        if (1..of.len()).contains(&count) {
            return Ok(of);
        }
        let problem = format!(
            "{count} of {} subgoals; expected 1 or more, and fewer than it offers (what is needed in any case needs no choice)",
            of.len()
        );
        Err(self.source.error(entry.count.span(), format!("choice[{index}].count"), problem))
    }

    /// Refuses a subgoal that two choices offer, or one twice: how many of it are enough would have two answers.
    fn once_each(&self, members: &[Vec<usize>]) -> Result<(), TaskError> {
        let mut seen = std::collections::HashSet::new();
        for (choice, of) in members.iter().enumerate() {
            if let Some(place) = of.iter().position(|&goal| !seen.insert(goal)) {
                let name = &self.file.choice[choice].of[place];
                let problem = format!(
                    "{:?} is offered twice; expected each subgoal in one choice at most",
                    name.get_ref()
                );
                return Err(self.source.error(name.span(), format!("choice[{choice}].of"), problem));
            }
        }
        Ok(())
    }

    /// Refuses a step that waits for one which may be spared, while it is needed itself: it could never be done.
    fn never_waits_for_what_is_spared(
        &self,
        subgoals: &[Subgoal],
        choices: &[Choice],
    ) -> Result<(), TaskError> {
        for choice in choices {
            for (index, subgoal) in
                subgoals.iter().enumerate().filter(|(index, _)| !choice.spares.contains(index))
            {
                let Some(&before) = subgoal.after.iter().find(|before| choice.spares.contains(before)) else {
                    continue;
                };
                let (name, before) = (&self.file.subgoal[index].name, &subgoals[before].name);
                let problem = format!(
                    "{:?} comes after {before:?}, which nobody needs once {:?} is made; expected it after the choice itself, or the choice to \
                     offer the last step of each alternative",
                    name.get_ref(),
                    choice.name
                );
                return Err(self.source.error(name.span(), format!("subgoal[{index}].after"), problem));
            }
        }
        Ok(())
    }
}

/// What choice number `choice` spares: what it offers, and all that nothing else follows from and no other choice offers.
fn spares(choice: usize, members: &[Vec<usize>], subgoals: &[Subgoal]) -> Vec<usize> {
    let mut spares = members[choice].clone();
    let elsewhere = |goal: &usize| members.iter().any(|of| of.contains(goal));
    loop {
        let only_prepares = |goal: &usize| {
            let mut followers =
                (0..subgoals.len()).filter(|&next| subgoals[next].after.contains(goal)).peekable();
            followers.peek().is_some() && followers.all(|next| spares.contains(&next))
        };
        let more = (0..subgoals.len())
            .find(|goal| !spares.contains(goal) && !elsewhere(goal) && only_prepares(goal));
        match more {
            None => break,
            Some(goal) => spares.push(goal),
        }
    }
    spares.sort_unstable();
    spares
}
