use crate::fluency::FluencyCounter;
use crate::hidden_goals::hidden_goals;
use crate::movement_times::MovementTimes;
use crate::nearest_angle::nearest_angle;
use crate::open_action::{Meant, OpenAction, is_reach, meant};
use crate::skill_times::SkillTimes;
use crate::trial::{Alarm, Detection, DoublePeak, Inference, PartnerAction, Trial};
use crate::{HesitantReach, TurnedReach};
use coact_joint_task::{NetworkPlan, Role, Task};
use coact_lockstep::Lockstep;
use coact_messages::{ArmSide, FieldFrame, LayerKind, PartnerError, PartnerPhase, Truth};
use coact_monitor::{ActiveAgents, Anticipation, Intentions, Timeline, Tracking};
use coact_run_records::{Event, SeparationReport, TrackingReport};
use coact_seen_parts::SeenParts;
use coact_separation::SeparationMeter;

/// Layers in which at most one peak may stand.
const DECISIONS: [LayerKind; 4] = [
    LayerKind::ActionSimulation,
    LayerKind::Intention,
    LayerKind::ErrorMonitoring,
    LayerKind::ActionExecution,
];
/// Signal above which a peak has formed: half of what a full peak gives. Two lower ones are a change from one decision to
/// the next.
const FORMED: f64 = 0.5;
/// Signal above which a population is named in a trial. Chosen by hand, above the noise of a field at rest; for reading only.
const SHOWN: f64 = 0.05;

/// How a trial ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ending {
    /// All its assemblies are complete.
    Completed,
    /// Nothing was achieved for too long.
    Stalled,
    /// Something was, again and again, but nothing came of it.
    TooLong,
}

/// Records one trial, tick by tick.
#[derive(Debug)]
pub(crate) struct TrialRecorder<'a> {
    task: &'a Task,
    plan: &'a NetworkPlan,
    anticipation: Anticipation,
    fluency: FluencyCounter,
    separation: SeparationMeter,
    timeline: Timeline,
    skills: SkillTimes,
    movements: MovementTimes,
    tracking: Tracking,
    /// What the camera has shown of the parts.
    parts: SeenParts,
    trial: Trial,
    open: Option<OpenAction>,
    /// Populations of EML whose peaks stand.
    alarmed: Vec<bool>,
    /// Reaches for a part that the person has completed.
    reaches: u32,
}

impl<'a> TrialRecorder<'a> {
    pub fn new(task: &'a Task, plan: &'a NetworkPlan, separation: SeparationMeter, seed: u64) -> Self {
        Self {
            anticipation: Anticipation::new(task, Intentions::from(plan)),
            fluency: FluencyCounter::default(),
            separation,
            timeline: Timeline::new(task),
            skills: SkillTimes::default(),
            movements: MovementTimes::default(),
            tracking: Tracking::new(),
            parts: SeenParts::none(),
            trial: Trial {
                task: task.name.clone(),
                seed,
                completed_ms: None,
                ended_ms: 0,
                stalled: false,
                last_fields: Vec::new(),
                achieved: Vec::new(),
                actions: Vec::new(),
                false_alarms: Vec::new(),
                double_peaks: 0,
                first_double: None,
                fluency: crate::Fluency::default(),
                separation: SeparationReport::default(),
                timeline: Vec::new(),
                skills: Vec::new(),
                movements: Vec::new(),
                tracking: TrackingReport::default(),
            },
            open: None,
            alarmed: vec![false; plan.populations.len()],
            reaches: 0,
            task,
            plan,
        }
    }

    /// Adds one tick.
    pub fn tick(&mut self, stages: &Lockstep) {
        let (truth, frame) = (&*stages.truth, &*stages.frame);
        self.fluency.tick(ActiveAgents::now(self.task, truth, &stages.command));
        self.separation.tick(truth, &stages.command);
        self.timeline.tick(truth, &stages.command, &mut self.trial.timeline);
        self.skills.tick(self.task, &frame.decision, &stages.command, truth);
        self.movements.tick(&stages.command.path, truth.header.cycle);
        self.tracking.command(&stages.command);
        self.parts.see(&stages.sample.scene, self.task);
        let mut events = Vec::new();
        self.anticipation.observe(truth, frame, &mut events);
        self.add_answers(&events);
        self.follow_action(stages);
        self.look_for_alarms(truth, frame);
        self.look_for_doubles(frame);
    }

    /// The record of the trial, which ends now.
    pub fn finish(mut self, stages: &Lockstep, ending: Ending) -> Trial {
        let mut events = Vec::new();
        self.anticipation.finish(&mut events);
        self.add_answers(&events);
        self.close();
        self.timeline.finish(stages.truth.header.cycle, &mut self.trial.timeline);
        let achieved = stages.truth.achieved;
        let done = |goal: &usize| achieved & (1 << goal) != 0;
        let names =
            (0..self.task.subgoals.len()).filter(done).map(|goal| self.task.subgoals[goal].name.clone());
        let achieved: Vec<_> = names.collect();
        let complete = ending == Ending::Completed;
        let last_fields = if complete { Vec::new() } else { self.shown(&stages.frame) };
        Trial {
            completed_ms: complete.then_some(stages.ticks()),
            ended_ms: stages.ticks(),
            stalled: ending == Ending::Stalled,
            last_fields,
            achieved,
            fluency: self.fluency.fluency(),
            separation: self.separation.report().clone(),
            skills: self.skills.finish(),
            movements: self.movements.finish(),
            tracking: self.tracking.report(),
            ..self.trial
        }
    }

    /// Adds how actions were answered.
    fn add_answers(&mut self, events: &[Event]) {
        for answer in events.iter().filter_map(Event::as_action) {
            let own = self.trial.actions.iter_mut().find(|own| own.number == answer.action);
            if let Some(own) = own {
                own.lead_ms = answer.lead_ms.filter(|_| answer.correct && own.error.is_none());
                own.decided.clone_from(&answer.decided);
                own.answered = answer.correct;
            }
        }
    }

    fn follow_action(&mut self, stages: &Lockstep) {
        let (truth, frame) = (&*stages.truth, &*stages.frame);
        let last = self.trial.actions.last().map_or(0, |action| action.number);
        if truth.actions != last {
            self.close();
            self.begin(stages);
        } else if truth.phase == PartnerPhase::Idle as u32 {
            self.close();
        }
        let inferred = self.highest(LayerKind::Intention, frame);
        self.follow_turn(truth, frame, inferred);
        self.follow_hesitation(truth, inferred);
        let Some(open) = &mut self.open else { return };
        // What has stood since before the hand set out is of the action before, or predicted.
        let new = inferred.filter(|&goal| frame.since[goal] > truth.onset_cycle);
        open.first.see(frame.header.cycle, new);
        let (goal, first, reaches) = (open.goal, open.first.goal().or(inferred), open.reaches);
        let judged = |inferred: Option<usize>| match inferred {
            None => Inference::Absent,
            Some(_) if inferred == goal => Inference::Right,
            Some(_) => Inference::Wrong,
        };
        let rose = open.errors.iter().map(|&error| frame.since[error]).filter(|&since| since > 0).min();
        let grasped =
            self.trial.actions.last().is_some_and(|own| own.grasp_ms.is_none()) && truth.grasp_cycle > 0;
        let fields = if grasped { self.shown(frame) } else { Vec::new() };
        let Some(action) = self.trial.actions.last_mut() else { return };
        action.detected_ms = action.detected_ms.or(rose.map(|since| since.max(action.onset_ms)));
        if grasped {
            if action.hidden {
                let scene = &stages.sample.scene;
                action.hidden_goals = Some(hidden_goals(self.task, self.plan, truth, &self.parts, scene));
            }
            // A step whose turn came during the reach is no error any more.
            action.error = action.error.filter(|_| truth.error != PartnerError::None as u32);
            action.grasp_ms = Some(truth.grasp_cycle);
            action.inference = Some(judged(inferred));
            action.first_inference = Some(judged(first));
            action.first_inferred = first.map(|goal| self.plan.populations[goal].label.clone());
            action.inferred = inferred.map(|goal| self.plan.populations[goal].label.clone());
            action.fields = fields;
            self.reaches += u32::from(reaches);
        }
    }

    /// The hand may turn to another part, which the action then is about; until the grasp it is seen since when its goal stands.
    fn follow_turn(&mut self, truth: &Truth, frame: &FieldFrame, inferred: Option<usize>) {
        let (Some(open), Some(action)) = (&mut self.open, self.trial.actions.last_mut()) else { return };
        if truth.turn_cycle == 0 || action.grasp_ms.is_some() {
            return;
        }
        if action.turn.is_none() {
            let decided = frame.decision.action as usize;
            action.turn = Some(TurnedReach {
                turned_ms: truth.turn_cycle,
                headed_ms: None,
                chain_before: action.chain.clone(),
                subgoal_before: action.subgoal.clone(),
                inferred_before: inferred.is_some() && inferred == open.goal,
                decided_before: open.answer == Some(decided),
                followed_ms: None,
            });
            let Some(meant) = meant(self.task, self.plan, truth) else { return };
            (action.chain, action.subgoal, action.error) = (meant.chain, meant.subgoal, meant.error);
            *open = meant.open;
        }
        let stands = inferred.is_some() && inferred == open.goal;
        open.stands_since = stands.then(|| open.stands_since.unwrap_or(truth.header.cycle));
        if let Some(turn) = &mut action.turn {
            turn.headed_ms = Some(truth.heading_cycle).filter(|cycle| *cycle > 0);
            turn.followed_ms = open.stands_since;
        }
    }

    /// The hand may stop on its way: from then on it is seen whether the goal stands until the grasp.
    fn follow_hesitation(&mut self, truth: &Truth, inferred: Option<usize>) {
        let (Some(open), Some(action)) = (&self.open, self.trial.actions.last_mut()) else { return };
        if truth.hesitation_cycle == 0 || action.grasp_ms.is_some() {
            return;
        }
        let stands = inferred.is_some() && inferred == open.goal;
        let hesitation = action.hesitation.get_or_insert(HesitantReach::new(truth.hesitation_cycle));
        hesitation.see(stands, truth.header.cycle);
    }

    fn begin(&mut self, stages: &Lockstep) {
        let truth = &*stages.truth;
        let Some(Meant { open, chain, subgoal, error }) = meant(self.task, self.plan, truth) else { return };
        self.open = Some(open);
        self.trial.actions.push(PartnerAction {
            number: truth.actions,
            chain,
            subgoal,
            error,
            hidden: truth.hidden != 0,
            earlier_reaches: self.reaches,
            left_hand: truth.side == ArmSide::Left as u32,
            hidden_goals: None,
            onset_ms: truth.onset_cycle,
            grasp_ms: None,
            inferred: None,
            inference: None,
            first_inferred: None,
            first_inference: None,
            nearest_deg: self.nearest_deg(stages),
            lead_ms: None,
            decided: None,
            answered: false,
            detected_ms: None,
            detection: None,
            fields: Vec::new(),
            turn: None,
            hesitation: None,
        });
    }

    /// How near another part is to the way of the reach that begins.
    fn nearest_deg(&self, stages: &Lockstep) -> Option<f64> {
        let chain = &self.task.chains[stages.truth.chain as usize];
        let [_, _, wrist, _] = stages.truth.arms[stages.truth.side as usize];
        nearest_angle(self.task, &stages.sample, chain.kind, wrist).filter(|_| is_reach(chain))
    }

    fn close(&mut self) {
        let (Some(_), Some(action)) = (self.open.take(), self.trial.actions.last_mut()) else { return };
        let Some(grasp) = action.grasp_ms.filter(|_| action.error.is_some()) else { return };
        action.detection = Some(match action.detected_ms {
            Some(detected) if detected <= grasp => Detection::InTime,
            Some(_) => Detection::Late,
            None => Detection::Missed,
        });
    }

    /// A peak in EML that rises while the person does nothing wrong; a part that the robot lost is no error of the person's.
    fn look_for_alarms(&mut self, truth: &Truth, frame: &FieldFrame) {
        let row = self.plan.layer(LayerKind::ErrorMonitoring).populations.clone();
        for index in row.filter(|&index| self.plan.populations[index].role != Role::Loss) {
            let stands = frame.since[index] != 0;
            let rises = stands && !std::mem::replace(&mut self.alarmed[index], stands);
            let action = self.open.as_ref().and(self.trial.actions.last());
            if rises && action.is_none_or(|action| action.error.is_none()) {
                let (error, action) =
                    (self.plan.populations[index].label.clone(), action.map(|own| own.number));
                let (at_ms, fields) = (truth.header.cycle, self.shown(frame));
                self.trial.false_alarms.push(Alarm { at_ms, error, action, fields });
            }
        }
    }

    fn look_for_doubles(&mut self, frame: &FieldFrame) {
        for layer in DECISIONS {
            let formed = |index: &usize| frame.signal[*index] > FORMED;
            if self.plan.layer(layer).populations.clone().filter(formed).count() < 2 {
                continue;
            }
            self.trial.double_peaks += 1;
            if self.trial.first_double.is_none() {
                let peaks = self.plan.layer(layer).populations.clone().filter(formed);
                self.trial.first_double = Some(DoublePeak {
                    at_ms: frame.header.cycle,
                    layer: layer.name().into(),
                    peaks: peaks.map(|index| self.plan.populations[index].label.clone()).collect(),
                });
            }
        }
    }

    /// The population of `layer` with the highest peak.
    fn highest(&self, layer: LayerKind, frame: &FieldFrame) -> Option<usize> {
        let peaks = self.plan.layer(layer).populations.clone().filter(|&index| frame.since[index] != 0);
        peaks.max_by(|&one, &other| frame.signal[one].total_cmp(&frame.signal[other]))
    }

    /// All populations that are active: layer, name, signal.
    fn shown(&self, frame: &FieldFrame) -> Vec<String> {
        let active_of = |layer: &coact_joint_task::LayerPlan| {
            let (name, row) = (layer.kind.name(), layer.populations.clone());
            let active = row.filter(|&index| frame.signal[index] > SHOWN);
            let described = |index: usize| {
                format!("{name} {} {:.2}", self.plan.populations[index].label, frame.signal[index])
            };
            active.map(described).collect::<Vec<_>>()
        };
        self.plan.layers.iter().flat_map(active_of).collect()
    }
}
