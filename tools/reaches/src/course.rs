use crate::outcome::{Decided, FRACTIONS, Outcome};
use coact_joint_task::{NetworkPlan, Task};
use coact_messages::{FieldFrame, LayerKind, Percept};
use coact_recordings::Reach;
use coact_world::{Replay, Span};

/// What perception and the fields made of a person's reaches, while they were played.
#[derive(Debug, Clone, Default)]
pub struct Course {
    /// Goal that stands in the intention layer, and since when this is so, cycles; where it changed.
    standings: Vec<(u64, Option<Standing>)>,
    /// Cycle at which perception took notice of a movement, and of the onset that it gives it.
    onsets: Vec<(u64, u64)>,
    reaching: bool,
}

/// The goal that stands at one cycle: kind of part, and cycle at which its peak crossed threshold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Standing {
    kind: usize,
    since: u64,
}

impl Course {
    /// Takes down a percept.
    pub fn percept(&mut self, percept: &Percept) {
        let (cycle, reaching) = (percept.header.cycle, percept.hand.reaching == 1);
        if reaching && !self.reaching {
            self.onsets.push((cycle, cycle.saturating_sub(percept.hand.since_onset)));
        }
        self.reaching = reaching;
    }

    /// Takes down a frame of the network that `plan` describes.
    pub fn frame(&mut self, plan: &NetworkPlan, frame: &FieldFrame) {
        let standing = standing(plan, frame);
        if self.standings.last().is_none_or(|(_, last)| *last != standing) {
            self.standings.push((frame.header.cycle, standing));
        }
    }

    /// Compares what was decided with the labels, reach by reach.
    pub fn judge(&self, task: &Task, replay: &Replay) -> Vec<Outcome> {
        let pairs = replay.reaches().iter().zip(replay.spans());
        pairs.map(|(reach, span)| self.judge_one(task, reach, span)).collect()
    }

    fn judge_one(&self, task: &Task, reach: &Reach, span: &Span) -> Outcome {
        let width = |standing: Standing| task.kinds[standing.kind].width;
        let is_right = |standing: Standing| (width(standing) - reach.size.width()).abs() < 1e-6;
        let at = |fraction: f64| {
            let elapsed = (fraction * reach.movement_time * 1000.0).round() as u64;
            self.standing_at(span.onset + elapsed)
        };
        let decision = at(1.0).filter(|standing| standing.since < span.contact);
        Outcome {
            participant: reach.participant,
            trial: reach.trial,
            width: reach.size.width(),
            movement_ms: (span.contact - span.onset) as i64,
            onset_ms: self.onset_in(span).map(|onset| onset as i64 - span.onset as i64),
            standing: FRACTIONS.map(|fraction| at(fraction).map(is_right)),
            decision: decision.map(|standing| Decided {
                right: is_right(standing),
                lead_ms: (span.contact - standing.since) as i64,
                width: width(standing),
            }),
        }
    }

    fn standing_at(&self, cycle: u64) -> Option<Standing> {
        let changes = self.standings.partition_point(|(at, _)| *at <= cycle);
        self.standings[..changes].last().and_then(|(_, standing)| *standing)
    }

    /// The first onset that perception gives a movement of this span.
    fn onset_in(&self, span: &Span) -> Option<u64> {
        let first = self.onsets.partition_point(|(noticed, _)| *noticed < span.begin);
        self.onsets.get(first).map(|(_, onset)| *onset).filter(|onset| *onset < span.contact)
    }
}

/// The goal whose peak stands in the intention layer.
fn standing(plan: &NetworkPlan, frame: &FieldFrame) -> Option<Standing> {
    let layer = plan.layer(LayerKind::Intention);
    let mut peaks = layer.populations.clone().filter(|index| frame.since[*index] > 0);
    let index = peaks.next()?;
    let kind = plan.populations[index].kind?;
    Some(Standing { kind, since: frame.since[index] })
}
