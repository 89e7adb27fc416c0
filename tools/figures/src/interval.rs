use coact_joint_task::Task;
use coact_messages::{PartnerPhase, Truth};

/// A rest that is shorter belongs to what the person did before, ms: so long the person waits while the robot inserts a part.
const SHORTEST_REST: f64 = 4000.0;

/// A time in which the person does one thing.
#[derive(Debug, Clone, PartialEq)]
pub struct Interval {
    /// The chapter's name of the instant at which it begins: T1, T2, ...
    pub name: String,
    /// What the person does.
    pub doing: String,
    /// Begin, ms from the start of the run.
    pub from_ms: f64,
    /// End, ms.
    pub to_ms: f64,
}

/// Follows what the person really does, tick by tick.
#[derive(Debug, Default)]
pub(crate) struct Observer {
    begun: Vec<(f64, Doing)>,
}

/// What the person does: an action (which chain, and the how-manieth action it is), or none.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Doing {
    Rest,
    Chain { index: usize, nth: u32 },
}

impl Observer {
    pub fn observe(&mut self, ms: f64, truth: &Truth) {
        let acts = [PartnerPhase::Reach, PartnerPhase::Transport, PartnerPhase::Act];
        let doing = match acts.iter().any(|&phase| phase as u32 == truth.phase) {
            true => Doing::Chain { index: truth.chain as usize, nth: truth.actions },
            false => Doing::Rest,
        };
        if self.begun.last().is_none_or(|(_, before)| *before != doing) {
            self.begun.push((ms, doing));
        }
    }

    /// The intervals of a run that ended at `end_ms`, named from T`first` on.
    pub fn intervals(&self, task: &Task, first: usize, end_ms: f64) -> Vec<Interval> {
        let ends = self.begun.iter().skip(1).map(|(ms, _)| *ms).chain([end_ms]);
        let lasting = self
            .begun
            .iter()
            .zip(ends)
            .filter(|((begin, doing), end)| *doing != Doing::Rest || end - begin >= SHORTEST_REST);
        let kept: Vec<&(f64, Doing)> = lasting.map(|(begun, _)| begun).collect();
        let ends = kept.iter().skip(1).map(|(ms, _)| *ms).chain([end_ms]);
        let interval = |((nth, (from_ms, doing)), to_ms): ((usize, &&(f64, Doing)), f64)| Interval {
            name: format!("T{}", first + nth),
            doing: doing.words(task),
            from_ms: *from_ms,
            to_ms,
        };
        kept.iter().enumerate().zip(ends).map(interval).collect()
    }
}

impl Doing {
    fn words(self, task: &Task) -> String {
        let Self::Chain { index, .. } = self else { return "idle".into() };
        let chain = &task.chains[index];
        format!("{}: {}", chain.name, task.kinds[chain.kind].name)
    }
}
