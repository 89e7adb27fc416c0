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
    goals: PeakTrace,
    answers: PeakTrace,
    /// Cycle at which perception noticed a movement, and of the onset that it gives it.
    onsets: Vec<(u64, u64)>,
    reaching: bool,
}

/// Each change of the peak that stands in one layer: the cycle, and the peak from then on.
#[derive(Debug, Clone, Default)]
struct PeakTrace(Vec<(u64, Option<Peak>)>);

/// A peak: the kind of part that it is about, and the cycle at which it crossed threshold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Peak {
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
        self.goals.record(frame.header.cycle, peak(LayerKind::Intention, plan, frame));
        self.answers.record(frame.header.cycle, peak(LayerKind::ActionExecution, plan, frame));
    }

    /// Compares what was decided with the labels, reach by reach.
    pub fn judge(&self, task: &Task, replay: &Replay) -> Vec<ReachOutcome> {
        let pairs = replay.reaches().iter().zip(replay.spans());
        pairs.map(|(reach, span)| self.judge_one(task, reach, span)).collect()
    }

    fn judge_one(&self, task: &Task, reach: &Reach, span: &Span) -> ReachOutcome {
        let width = |peak: Peak| task.kinds[peak.kind].width;
        let is_right = |peak: Peak| (width(peak) - reach.size.width()).abs() < SAME_WIDTH;
        let at = |fraction: f64| {
            let elapsed = (fraction * reach.movement_time * CYCLES_PER_SECOND as f64).round() as u64;
            self.goals.at(span.onset + elapsed)
        };
        let before_contact = |peak: Option<Peak>| {
            peak.filter(|peak| peak.since < span.contact).map(|peak| GoalDecision {
                right: is_right(peak),
                lead_ms: (span.contact - peak.since) as i64,
                width: width(peak),
            })
        };
        ReachOutcome {
            participant: reach.participant,
            trial: reach.trial,
            width: reach.size.width(),
            movement_ms: (span.contact - span.onset) as i64,
            onset_ms: self.onset_in(span).map(|onset| onset as i64 - span.onset as i64),
            right_during_reach: FRACTIONS.map(|fraction| at(fraction).map(is_right)),
            decision: before_contact(at(1.0)),
            answer: before_contact(self.answers.at(span.contact)),
        }
    }

    /// The first onset that perception gives a movement of this span.
    fn onset_in(&self, span: &Span) -> Option<u64> {
        let first = self.onsets.partition_point(|(noticed, _)| *noticed < span.begin);
        self.onsets.get(first).map(|(_, onset)| *onset).filter(|onset| *onset < span.contact)
    }
}

impl PeakTrace {
    fn record(&mut self, cycle: u64, peak: Option<Peak>) {
        if self.0.last().is_none_or(|(_, last)| *last != peak) {
            self.0.push((cycle, peak));
        }
    }

    fn at(&self, cycle: u64) -> Option<Peak> {
        let changes = self.0.partition_point(|(at, _)| *at <= cycle);
        self.0[..changes].last().and_then(|(_, peak)| *peak)
    }
}

/// The peak that stands in a layer.
fn peak(layer: LayerKind, plan: &NetworkPlan, frame: &FieldFrame) -> Option<Peak> {
    let mut peaks = plan.layer(layer).populations.clone().filter(|index| frame.since[*index] > 0);
    let index = peaks.next()?;
    let kind = plan.populations[index].kind?;
    Some(Peak { kind, since: frame.since[index] })
}
