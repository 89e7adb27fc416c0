use crate::reach_outcome::{FRACTIONS, GoalDecision, ReachOutcome};
use coact_joint_task::{NetworkPlan, Task};
use coact_messages::{FieldFrame, LayerKind, Percept};
use coact_period::CYCLES_PER_SECOND;
use coact_recordings::Reach;
use coact_world::{Replay, Span};

/// Widths that differ by less are the same, m: far above rounding, far below what tells two cubes apart.
const SAME_WIDTH: f64 = 1e-6;

/// What perception and the fields inferred from a person's reaches, while they were played.
#[derive(Debug, Clone, Default)]
pub struct InferenceTrace {
    /// Each change of the goal whose peak stands in IL: the cycle, and the goal from then on.
    goals: Vec<(u64, Option<InferredGoal>)>,
    /// Cycle at which perception noticed a movement, and of the onset that it gives it.
    onsets: Vec<(u64, u64)>,
    reaching: bool,
}

/// A goal whose peak stands: kind of part, and cycle at which the peak crossed threshold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct InferredGoal {
    kind: usize,
    since: u64,
}

impl InferenceTrace {
    /// Records a percept.
    pub fn percept(&mut self, percept: &Percept) {
        let (cycle, reaching) = (percept.header.cycle, percept.hand.reaching == 1);
        if reaching && !self.reaching {
            self.onsets.push((cycle, cycle.saturating_sub(percept.hand.since_onset)));
        }
        self.reaching = reaching;
    }

    /// Records a frame of the network that `plan` describes.
    pub fn frame(&mut self, plan: &NetworkPlan, frame: &FieldFrame) {
        let goal = inferred_goal(plan, frame);
        if self.goals.last().is_none_or(|(_, last)| *last != goal) {
            self.goals.push((frame.header.cycle, goal));
        }
    }

    /// Compares what was decided with the labels, reach by reach.
    pub fn judge(&self, task: &Task, replay: &Replay) -> Vec<ReachOutcome> {
        let pairs = replay.reaches().iter().zip(replay.spans());
        pairs.map(|(reach, span)| self.judge_one(task, reach, span)).collect()
    }

    fn judge_one(&self, task: &Task, reach: &Reach, span: &Span) -> ReachOutcome {
        let width = |goal: InferredGoal| task.kinds[goal.kind].width;
        let is_right = |goal: InferredGoal| (width(goal) - reach.size.width()).abs() < SAME_WIDTH;
        let at = |fraction: f64| {
            let elapsed = (fraction * reach.movement_time * CYCLES_PER_SECOND as f64).round() as u64;
            self.goal_at(span.onset + elapsed)
        };
        let decision = at(1.0).filter(|goal| goal.since < span.contact);
        ReachOutcome {
            participant: reach.participant,
            trial: reach.trial,
            width: reach.size.width(),
            movement_ms: (span.contact - span.onset) as i64,
            onset_ms: self.onset_in(span).map(|onset| onset as i64 - span.onset as i64),
            right_during_reach: FRACTIONS.map(|fraction| at(fraction).map(is_right)),
            decision: decision.map(|goal| GoalDecision {
                right: is_right(goal),
                lead_ms: (span.contact - goal.since) as i64,
                width: width(goal),
            }),
        }
    }

    fn goal_at(&self, cycle: u64) -> Option<InferredGoal> {
        let changes = self.goals.partition_point(|(at, _)| *at <= cycle);
        self.goals[..changes].last().and_then(|(_, goal)| *goal)
    }

    /// The first onset that perception gives a movement of this span.
    fn onset_in(&self, span: &Span) -> Option<u64> {
        let first = self.onsets.partition_point(|(noticed, _)| *noticed < span.begin);
        self.onsets.get(first).map(|(_, onset)| *onset).filter(|onset| *onset < span.contact)
    }
}

/// The goal whose peak stands in IL.
fn inferred_goal(plan: &NetworkPlan, frame: &FieldFrame) -> Option<InferredGoal> {
    let layer = plan.layer(LayerKind::Intention);
    let mut peaks = layer.populations.clone().filter(|index| frame.since[*index] > 0);
    let index = peaks.next()?;
    let kind = plan.populations[index].kind?;
    Some(InferredGoal { kind, since: frame.since[index] })
}
