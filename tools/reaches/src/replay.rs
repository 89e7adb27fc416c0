use crate::outcome::{Decided, FRACTIONS, Outcome};
use crate::playback::Playback;
use coact_fields::Network;
use coact_joint_task::{NetworkPlan, Task};
use coact_messages::{FieldFrame, LayerKind, Percept};
use coact_recordings::Reach;

/// The goal that stands at one cycle: kind of part, and cycle at which its peak crossed threshold.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Standing {
    kind: usize,
    since: u64,
}

/// Replays reaches of one person through perception and the field network, in lockstep.
pub(crate) struct Replay<'a> {
    task: &'a Task,
    plan: &'a NetworkPlan,
    network: Network,
    playback: Playback<'a>,
    frames: [Box<FieldFrame>; 2],
}

impl<'a> Replay<'a> {
    pub fn new(task: &'a Task, plan: &'a NetworkPlan, network: Network, playback: Playback<'a>) -> Self {
        Self { task, plan, network, playback, frames: [bytemuck::zeroed_box(), bytemuck::zeroed_box()] }
    }

    /// Replays one reach. The fields begin at rest; what perception has learned of the person stays.
    pub fn replay(&mut self, reach: &Reach) -> Outcome {
        let (network, plan) = (&mut self.network, self.plan);
        let [previous, next] = &mut self.frames;
        network.rest(previous);
        let mut course: Vec<(u64, Option<Standing>)> = Vec::new();
        let mut onset = None;
        let zero = self.playback.play(reach, |tick, percept: &Percept| {
            network.step(tick, Some(percept), previous, next);
            next.header.cycle = tick;
            course.push((tick, standing(plan, next)));
            if percept.hand.reaching == 1 && onset.is_none() {
                onset = Some(tick - percept.hand.since_onset);
            }
            std::mem::swap(previous, next);
        });
        self.judge(reach, zero, onset, &course)
    }

    /// Compares what was decided with the labels.
    fn judge(
        &self,
        reach: &Reach,
        zero: u64,
        onset: Option<u64>,
        course: &[(u64, Option<Standing>)],
    ) -> Outcome {
        let first = course.first().map_or(0, |(tick, _)| *tick);
        let at = |fraction: f64| {
            let tick = zero + (fraction * reach.movement_time * 1000.0).round() as u64;
            let entry = course.get((tick - first) as usize);
            (tick, entry.and_then(|(_, standing)| *standing))
        };
        let width = |standing: Standing| self.task.kinds[standing.kind].width;
        let is_right = |standing: Standing| (width(standing) - reach.size.width()).abs() < 1e-6;
        let (contact, last) = at(1.0);
        Outcome {
            participant: reach.participant,
            trial: reach.trial,
            width: reach.size.width(),
            movement_ms: (contact - zero) as i64,
            onset_ms: onset.filter(|onset| *onset < contact).map(|onset| onset as i64 - zero as i64),
            standing: FRACTIONS.map(|fraction| at(fraction).1.map(is_right)),
            decision: last.filter(|standing| standing.since < contact).map(|standing| Decided {
                right: is_right(standing),
                lead_ms: (contact - standing.since) as i64,
                width: width(standing),
            }),
        }
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
