use crate::network_file::{Attribute, Relation, RuleEntry, Selector, Times};
use crate::network_plan::Synapse;
use crate::population::Population;
use crate::source_file::SourceFile;
use crate::{Choice, Role, Subgoal, Task, TaskError};
use coact_messages::LayerKind;
use std::ops::Range;

/// Turns the rules of a network file into synapses.
pub(crate) struct SynapseRules<'a> {
    pub source: &'a SourceFile,
    pub task: &'a Task,
    /// Names that rules know layers and channels by, with their places in `meanings`: first the layers.
    pub names: Vec<(String, Range<usize>)>,
    /// What each population stands for and, behind them, each channel.
    pub meanings: Vec<Population>,
}

impl SynapseRules<'_> {
    /// The synapses that the rules of `table` make, rule by rule.
    pub fn connect(&self, table: &str, rules: &[RuleEntry]) -> Result<Vec<Synapse>, TaskError> {
        let mut synapses = Vec::new();
        for (index, rule) in rules.iter().enumerate() {
            let sources = self.select(&format!("{table}[{index}].from"), &rule.from, true)?;
            let targets = self.select(&format!("{table}[{index}].to"), &rule.to, false)?;
            for &to in &targets {
                let related = |&&from: &&usize| self.related(rule, &self.meanings[from], &self.meanings[to]);
                let found: Vec<usize> = sources.iter().filter(related).copied().collect();
                let weight = rule.weight * self.times(rule, &self.meanings[to]);
                synapses.extend(found.into_iter().map(|from| Synapse { from, to, weight, rule: index }));
            }
        }
        Ok(synapses)
    }

    /// Places in `meanings` of what a selector names; only of layers, if it is no `source`.
    fn select(&self, key: &str, selector: &Selector, source: bool) -> Result<Vec<usize>, TaskError> {
        let Selector { layer, role, side, workspace, steadied } = selector;
        let names = || self.names.iter().filter(|(_, range)| source || range.start < self.layer_end());
        let range = names().find(|(name, _)| name == layer.get_ref()).map(|(_, range)| range.clone());
        let range = range.ok_or_else(|| {
            let known: Vec<_> = names().map(|(name, _)| format!("{name:?}")).collect();
            let problem = format!("{:?} is unknown; expected one of {}", layer.get_ref(), known.join(", "));
            self.source.error(layer.span(), format!("{key}.layer"), problem)
        })?;
        Ok(range
            .filter(|&index| {
                let meaning = &self.meanings[index];
                role.is_none_or(|role| meaning.role == role)
                    && side.is_none_or(|side| meaning.side == Some(side))
                    && workspace.is_none_or(|workspace| meaning.workspace == Some(workspace))
                    && steadied.is_none_or(|steadied| meaning.steadied == steadied)
            })
            .collect())
    }

    /// How many times a rule's weight counts for this target.
    fn times(&self, rule: &RuleEntry, to: &Population) -> f64 {
        match (rule.times, to.choice) {
            (Some(Times::Count), Some(choice)) => self.choice(choice).count as f64,
            _ => 1.0,
        }
    }

    /// Where the layers end and the channels begin.
    fn layer_end(&self) -> usize {
        self.names[LayerKind::ALL.len() - 1].1.end
    }

    /// Whether a rule connects these two.
    fn related(&self, rule: &RuleEntry, from: &Population, to: &Population) -> bool {
        let same = rule.same.iter().all(|&attribute| alike(attribute, from, to));
        let unlike =
            rule.unlike.is_empty() || rule.unlike.iter().any(|&attribute| !alike(attribute, from, to));
        same && unlike
            && match rule.relation {
                None => true,
                Some(Relation::Before) => self.comes_before(from, to),
                Some(Relation::Offered) => to
                    .choice
                    .zip(from.subgoal)
                    .is_some_and(|(choice, goal)| self.choice(choice).of.contains(&goal)),
                Some(Relation::Spares) => from
                    .choice
                    .zip(to.subgoal)
                    .is_some_and(|(choice, goal)| self.choice(choice).spares.contains(&goal)),
                Some(Relation::Answers) => {
                    from.answer.is_some()
                        && from.answer == to.rule
                        && (to.subgoal.is_none() || from.subgoal == to.subgoal)
                        && (to.role != Role::Steady || from.steadied)
                }
            }
    }

    fn choice(&self, index: usize) -> &Choice {
        &self.task.choices[index]
    }

    /// Whether the plan puts the subgoal or the choice of `from` directly before the subgoal of `to`; of a population that stands for
    /// a kind of part, before one of the subgoals that need it.
    fn comes_before(&self, from: &Population, to: &Population) -> bool {
        let follows = |after: &usize| {
            let Subgoal { after, after_choices, .. } = &self.task.subgoals[*after];
            from.subgoal.is_some_and(|before| after.contains(&before))
                || from.choice.is_some_and(|before| after_choices.contains(&before))
        };
        match to.subgoal {
            Some(after) => follows(&after),
            None => (0..self.task.subgoals.len())
                .filter(|&goal| Some(self.task.subgoals[goal].kind) == to.kind)
                .any(|goal| follows(&goal)),
        }
    }
}

/// Whether both stand for the same thing, and both for one at all.
fn alike(attribute: Attribute, from: &Population, to: &Population) -> bool {
    fn equal<T: PartialEq>(from: &Option<T>, to: &Option<T>) -> bool {
        from.is_some() && from == to
    }
    match attribute {
        Attribute::Act => equal(&from.act, &to.act),
        Attribute::Kind => equal(&from.kind, &to.kind),
        Attribute::Grip => equal(&from.grip, &to.grip),
        Attribute::Gesture => equal(&from.gesture, &to.gesture),
        Attribute::Subgoal => equal(&from.subgoal, &to.subgoal),
        Attribute::Side => equal(&from.side, &to.side),
        Attribute::Workspace => equal(&from.workspace, &to.workspace),
        Attribute::Chain => equal(&from.chain, &to.chain),
    }
}
