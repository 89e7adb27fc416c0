use crate::Interval;
use coact_joint_task::Task;
use coact_messages::{PartnerPhase, Truth};

/// A rest that is shorter belongs to what the person did before, ms: the person rests for nearly as long while the robot
/// inserts a part.
const SHORTEST_REST_MS: f64 = 5500.0;

/// Follows what the person really does, tick by tick.
#[derive(Debug, Default)]
pub(crate) struct IntervalTracker {
    begun: Vec<(f64, PersonActivity)>,
}

/// What the person does: nothing, or an action, with its chain and its number in the run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PersonActivity {
    Rest,
    Chain { index: usize, nth: u32 },
}

impl IntervalTracker {
    pub fn observe(&mut self, ms: f64, truth: &Truth) {
        let acts = [PartnerPhase::Reach, PartnerPhase::Transport, PartnerPhase::Act];
        let activity = match acts.iter().any(|&phase| phase as u32 == truth.phase) {
            true => PersonActivity::Chain { index: truth.chain as usize, nth: truth.actions },
            false => PersonActivity::Rest,
        };
        if self.begun.last().is_none_or(|(_, before)| *before != activity) {
            self.begun.push((ms, activity));
        }
    }

    /// The intervals of a run that ended at `end_ms`, named from T`first` on.
    pub fn intervals(&self, task: &Task, first: usize, end_ms: f64) -> Vec<Interval> {
        let ends = self.begun.iter().skip(1).map(|(ms, _)| *ms).chain([end_ms]);
        let lasting = self.begun.iter().zip(ends).filter(|((begin, activity), end)| {
            *activity != PersonActivity::Rest || end - begin >= SHORTEST_REST_MS
        });
        let shown: Vec<&(f64, PersonActivity)> = lasting.map(|(begun, _)| begun).collect();
        let ends = shown.iter().skip(1).map(|(ms, _)| *ms).chain([end_ms]);
        let interval =
            |((nth, (from_ms, activity)), to_ms): ((usize, &&(f64, PersonActivity)), f64)| Interval {
                name: format!("T{}", first + nth),
                doing: activity.words(task),
                from_ms: *from_ms,
                to_ms,
            };
        shown.iter().enumerate().zip(ends).map(interval).collect()
    }
}

impl PersonActivity {
    fn words(self, task: &Task) -> String {
        let Self::Chain { index, .. } = self else { return "idle".into() };
        let chain = &task.chains[index];
        format!("{}: {}", chain.name, task.kinds[chain.kind].name)
    }
}
