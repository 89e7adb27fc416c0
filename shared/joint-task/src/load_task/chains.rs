use super::TaskReader;
use crate::task_file::{ChainEntry, Name};
use crate::{Act, Chain, Kind, TaskError};

impl TaskReader<'_> {
    /// One chain for each rule and kind of part.
    pub(super) fn chains(&self, kinds: &[Kind]) -> Result<Vec<Chain>, TaskError> {
        let mut chains = Vec::new();
        for (index, entry) in self.file.chain.iter().enumerate() {
            let answer = entry.answer.as_ref().map(|name| self.answer(index, name)).transpose()?;
            for (kind, Kind { name, .. }) in kinds.iter().enumerate() {
                chains.push(Chain {
                    name: entry.name.get_ref().clone(),
                    act: self.shown_by(index, entry, kind)?,
                    kind,
                    from: entry.from,
                    side: entry.side,
                    answer: answer.clone(),
                    pointing: entry.pointing,
                    says: self.phrases(index, entry, name)?,
                });
            }
        }
        Ok(chains)
    }

    /// The phrases of a chain for one kind of part, by its name.
    fn phrases(&self, index: usize, entry: &ChainEntry, kind: &str) -> Result<Vec<String>, TaskError> {
        let phrase = |(nth, phrase): (usize, &Name)| {
            if !phrase.get_ref().contains("{kind}") {
                let problem = "expected a phrase with {kind} in it, where the part is named";
                return Err(self.source.error(phrase.span(), format!("chain[{index}].says[{nth}]"), problem));
            }
            Ok(phrase.get_ref().replace("{kind}", kind).to_lowercase())
        };
        entry.says.iter().enumerate().map(phrase).collect()
    }

    fn answer(&self, index: usize, name: &Name) -> Result<String, TaskError> {
        let actions = self.file.action.iter().map(|action| &action.name);
        let action = self.find(&format!("chain[{index}].answer"), name, actions)?;
        Ok(self.file.action[action].name.get_ref().clone())
    }

    fn shown_by(&self, index: usize, entry: &ChainEntry, kind: usize) -> Result<Act, TaskError> {
        match (&entry.grip, &entry.gesture) {
            (Some(grip), None) => {
                let grips = self.file.grip.iter().map(|grip| &grip.name);
                Ok(Act::Grasp { grip: self.find(&format!("chain[{index}].grip"), grip, grips)?, kind })
            }
            (None, Some(gesture)) => {
                let gestures = self.file.gesture.iter().map(|gesture| &gesture.name);
                Ok(Act::Gesture(self.find(&format!("chain[{index}].gesture"), gesture, gestures)?))
            }
            _ => Err(self.source.error(
                entry.name.span(),
                format!("chain[{index}]"),
                "expected either `grip` or `gesture`: what shows this chain",
            )),
        }
    }
}

/// What can be observed of a person who knows so many grips and gestures.
pub(super) fn acts(grips: usize, gestures: usize, chains: &[Chain], kinds: usize) -> Vec<Act> {
    let spoken = |chain: &usize| !chains[*chain].says.is_empty();
    let pointed_at = |chain: &usize| chains[*chain].pointing;
    let grasps = (0..grips).flat_map(|grip| (0..kinds).map(move |kind| Act::Grasp { grip, kind }));
    [Act::Rest, Act::Idle, Act::Reach, Act::Hidden]
        .into_iter()
        .chain((0..gestures).map(Act::Gesture))
        .chain((0..chains.len()).filter(spoken).map(Act::Word))
        .chain((0..chains.len()).filter(pointed_at).map(Act::Point))
        .chain(grasps)
        .collect()
}
