use crate::inference_trace::InferenceTrace;
use crate::parallel::in_parallel;
use crate::reach_outcome::ReachOutcome;
use crate::subject::Subject;
use crate::training::leave_one_out;
use coact_fields::Network;
use coact_joint_task::{NetworkPlan, Task};
use coact_perception::{Perception, PreshapeModel};
use coact_recordings::{Order, Reach};
use coact_robot::Robot;
use coact_world::{Replay, has_part_for};

/// What is evaluated.
#[derive(Debug, Clone, Copy)]
pub struct Evaluation<'a> {
    /// A task whose plan leaves several goals possible.
    pub task: &'a Task,
    /// The network that is made of it.
    pub plan: &'a NetworkPlan,
    /// The robot, which perception leaves out of what it sees.
    pub robot: &'a Robot,
    /// Model of preshaping, from other people than the recorded ones; `None`: leave one person out.
    pub model: Option<&'a PreshapeModel>,
    /// In which order a person's reaches are replayed.
    pub order: Order,
    /// Seed of the network's noise.
    pub seed: u64,
}

impl Evaluation<'_> {
    /// Everybody who reached for something that the task has a part of, each with a model that knows nothing of them.
    ///
    /// # Errors
    /// When no model can be made of the other people.
    pub fn subjects(&self, reaches: &[Reach]) -> anyhow::Result<Vec<Subject>> {
        let people = self.order.people(reaches);
        let models = match self.model {
            Some(model) => vec![model.clone(); people.len()],
            None => {
                let made = leave_one_out(self.task, self.robot, reaches, self.order)?;
                made.into_iter().map(|(_, model)| model).collect()
            }
        };
        let subject = |(person, model): (&Vec<&Reach>, PreshapeModel)| {
            let replay = Replay::new(self.task, self.robot, person, |reach| has_part_for(self.task, reach));
            Subject { participant: person[0].participant, model, replay }
        };
        let subjects = people.iter().zip(models).map(subject);
        Ok(subjects.filter(|subject| !subject.replay.reaches().is_empty()).collect())
    }

    /// Plays each subject's reaches through perception and the field network in lockstep, and judges what was decided:
    /// subject by subject, in the order of the replay.
    ///
    /// # Errors
    /// The network's parameters are refused.
    pub fn in_lockstep(&self, subjects: &[Subject]) -> anyhow::Result<Vec<ReachOutcome>> {
        let outcomes = in_parallel(subjects, |subject| {
            self.play(subject).map(|trace| trace.judge(self.task, &subject.replay))
        })?;
        Ok(outcomes.into_iter().flatten().collect())
    }

    fn play(&self, subject: &Subject) -> anyhow::Result<InferenceTrace> {
        let mut perception = Perception::new(self.task, &subject.model)?.with_robot(self.robot.clone());
        let mut network = Network::new(self.plan.clone(), self.task.fingerprint, self.seed)?;
        let (mut sample, mut truth) = (bytemuck::zeroed_box(), bytemuck::zeroed_box());
        let mut percept = bytemuck::zeroed_box();
        let (mut previous, mut next) = (bytemuck::zeroed_box(), bytemuck::zeroed_box());
        network.rest(&mut previous);
        let mut trace = InferenceTrace::default();
        let end = subject.replay.spans().last().map_or(0, |span| span.end);
        for tick in 1..end {
            subject.replay.step(tick, &mut sample, &mut truth);
            sample.header.cycle = tick;
            perception.step(tick, Some(&sample), &mut percept);
            percept.header.cycle = tick;
            network.step(tick, Some(&percept), &previous, &mut next);
            next.header.cycle = tick;
            trace.percept(&percept);
            trace.frame(self.plan, &next);
            std::mem::swap(&mut previous, &mut next);
        }
        Ok(trace)
    }
}
