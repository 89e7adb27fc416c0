use crate::extraction::{Labelled, extract};
use crate::order::Order;
use crate::outcome::Outcome;
use crate::playback::Playback;
use crate::replay::Replay;
use crate::training::fit;
use anyhow::Context;
use coact_fields::Network;
use coact_joint_task::{NetworkPlan, Task};
use coact_perception::{Perception, PreshapeModel};
use coact_recordings::Reach;

/// What is evaluated.
#[derive(Debug, Clone, Copy)]
pub struct Evaluation<'a> {
    /// The plan that leaves some goals.
    pub task: &'a Task,
    /// The network that is made of it.
    pub plan: &'a NetworkPlan,
    /// Model of preshaping, from other people than the recorded ones; `None`: leave one person out.
    pub model: Option<&'a PreshapeModel>,
    /// In which order a person's reaches are replayed.
    pub order: Order,
}

/// Replays every reach for an object that the task has a part of, and judges what was decided. Outcomes stand person
/// by person, in the order of the replay.
///
/// # Errors
/// When no model can be made of the other people, or the network's parameters are refused.
pub fn evaluate(evaluation: Evaluation, reaches: &[Reach]) -> anyhow::Result<Vec<Outcome>> {
    let people = evaluation.order.people(reaches);
    let labelled = match evaluation.model {
        Some(_) => Vec::new(),
        None => each_person(&people, |person| Ok(extract(evaluation.task, person)?))?,
    };
    let outcomes = each_person(&people, |person| evaluation.replay(person, &labelled))?;
    Ok(outcomes.into_iter().flatten().collect())
}

/// Does `work` for every person, people in parallel, and gathers the results in their order.
fn each_person<T: Send>(
    people: &[Vec<&Reach>],
    work: impl Fn(&[&Reach]) -> anyhow::Result<T> + Sync,
) -> anyhow::Result<Vec<T>> {
    std::thread::scope(|scope| {
        let threads: Vec<_> = people.iter().map(|person| scope.spawn(|| work(person))).collect();
        threads
            .into_iter()
            .map(|thread| thread.join().map_err(|_| anyhow::anyhow!("a replay panicked"))?)
            .collect()
    })
}

impl Evaluation<'_> {
    fn replay(&self, person: &[&Reach], labelled: &[Vec<Labelled>]) -> anyhow::Result<Vec<Outcome>> {
        let participant = person[0].participant;
        let model = match self.model {
            Some(model) => model.clone(),
            None => {
                let others: Vec<Labelled> = labelled
                    .iter()
                    .flatten()
                    .filter(|reach| reach.participant != participant)
                    .cloned()
                    .collect();
                fit(&others).with_context(|| format!("leaving out participant {participant}"))?
            }
        };
        let network = Network::new(self.plan.clone(), self.task.fingerprint, 1)?;
        let playback = Playback::new(self.task, Perception::new(self.task, &model)?, person);
        let mut replay = Replay::new(self.task, self.plan, network, playback);
        let wanted = |reach: &&&Reach| {
            self.task.kinds.iter().any(|kind| (kind.width - reach.size.width()).abs() < 1e-6)
        };
        Ok(person.iter().filter(wanted).map(|reach| replay.replay(reach)).collect())
    }
}
