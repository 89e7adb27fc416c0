use crate::Intentions;
use crate::expectation::Expectation;
use coact_joint_task::{ActionType, Agent, Task};
use coact_messages::{FieldFrame, PartnerPhase, Truth};
use coact_run_records::{ActionEvent, Event};

/// Finds for each of the partner's actions whether the right decision stood before the grasp was complete, and how long
/// before.
///
/// The first frame at or after grasp completion counts. A peak in it shows the cycle at which it crossed threshold, so
/// that frames may be missing, and a peak that rose and fell again does not count. A wrong peak counts only if it rose
/// during the reach; one that stood before belongs to what the robot was doing already. An action without an answer at
/// grasp completion may still be answered late, until the partner rests or reaches again. Where the partner takes the
/// part that the robot is giving, the robot cannot act on it, for its hand is full: there the inferred goal counts. Where
/// the partner changes the mind in mid-reach, what was meant at last counts.
#[derive(Debug)]
pub struct Anticipation {
    task: Task,
    intentions: Intentions,
    /// Number of the newest action that was seen.
    seen: u32,
    open: Option<OpenAction>,
}

/// An action of which it is not known yet how it is answered.
#[derive(Debug, Clone, Copy)]
struct OpenAction {
    number: u32,
    chain: usize,
    subgoal: usize,
    onset: u64,
    grasp: Option<u64>,
    /// What is wrong with it: [`Truth::error`].
    error: u32,
    expectation: Option<Expectation>,
    /// Nothing was decided at grasp completion.
    late: bool,
    /// No frame has been looked at since it was told.
    fresh: bool,
}

impl Anticipation {
    /// For a task; `intentions` serves the actions to which the task names no complementary one.
    pub fn new(task: &Task, intentions: Intentions) -> Self {
        Self { task: task.clone(), intentions, seen: 0, open: None }
    }

    /// Goes on after a restart: actions up to number `seen` are in the report already.
    pub fn resume(&mut self, seen: u32) {
        self.seen = self.seen.max(seen);
    }

    /// Both at once, as lockstep has them; see [`truth`](Self::truth) and [`frame`](Self::frame).
    pub fn observe(&mut self, truth: &Truth, frame: &FieldFrame, events: &mut Vec<Event>) {
        self.truth(truth, events);
        self.frame(frame, events);
    }

    /// Follows what the partner does; an action that ends unanswered is appended to `events`.
    pub fn truth(&mut self, truth: &Truth, events: &mut Vec<Event>) {
        let ended = self.open.filter(|open| {
            let rests = open.late && truth.phase == PartnerPhase::Idle as u32;
            truth.actions != open.number || rests
        });
        if let Some(open) = ended {
            self.close(open, None, events);
        }
        if truth.actions > self.seen {
            self.begin(truth);
        }
        let Some(mut open) = self.open.filter(|open| open.number == truth.actions) else { return };
        open.grasp = open.grasp.or(Some(truth.grasp_cycle).filter(|&cycle| cycle != 0));
        let turned = truth.phase == PartnerPhase::Reach as u32
            && (open.chain, open.subgoal) != (truth.chain as usize, truth.subgoal as usize);
        if turned {
            (open.chain, open.subgoal) = (truth.chain as usize, truth.subgoal as usize);
        }
        if turned || open.error != truth.error {
            // The hand has turned to another part, or its turn has come on the way.
            open.error = truth.error;
            open.expectation = self.expected(truth);
        }
        self.open = Some(open);
    }

    /// Looks at the fields; an action that is answered is appended to `events`.
    pub fn frame(&mut self, frame: &FieldFrame, events: &mut Vec<Event>) {
        let Some(mut open) = self.open else { return };
        // Of a hand that comes from outside an action is told only when its grasp is complete.
        if (open.grasp.is_none() || open.fresh) && self.is_served(&open, frame) {
            let goal = self.intentions.population(open.chain, open.subgoal);
            open.expectation = goal.map(Expectation::Intention).or(open.expectation);
        }
        open.fresh = false;
        self.open = Some(open);
        let Some(grasp) = open.grasp.filter(|&grasp| frame.header.cycle >= grasp) else { return };
        let Some(expectation) = open.expectation else { return self.close(open, None, events) };
        let right = expectation.since(frame).map(|since| (expectation, since));
        let answer = match right {
            Some((_, since)) if since <= grasp || open.late => right,
            _ if open.late => None,
            _ => expectation.rival(frame, open.onset, grasp),
        };
        match answer {
            Some(_) => self.close(open, answer, events),
            None => self.open = Some(OpenAction { late: true, ..open }),
        }
    }

    /// Ends the run: an action that is still unanswered stays so.
    pub fn finish(&mut self, events: &mut Vec<Event>) {
        if let Some(open) = self.open {
            self.close(open, None, events);
        }
    }

    /// Whether the robot is giving this part, or the one that the person's next step needs (chapter, section 5.2): its hand
    /// is full, so that it can understand the action, but not act on it.
    fn is_served(&self, open: &OpenAction, frame: &FieldFrame) -> bool {
        let action = self.task.actions.get(frame.decision.action as usize);
        let goal =
            action.filter(|action| action.action_type == ActionType::Give).and_then(|action| action.subgoal);
        let serves =
            |goal: usize| goal == open.subgoal || self.task.subgoals[goal].after.contains(&open.subgoal);
        goal.is_some_and(serves)
            && self.task.chains.get(open.chain).is_some_and(|chain| chain.from == Agent::Person)
    }

    fn begin(&mut self, truth: &Truth) {
        self.seen = truth.actions;
        self.open = Some(OpenAction {
            number: truth.actions,
            chain: truth.chain as usize,
            subgoal: truth.subgoal as usize,
            onset: truth.onset_cycle,
            grasp: None,
            error: truth.error,
            expectation: self.expected(truth),
            late: false,
            fresh: true,
        });
    }

    fn expected(&self, truth: &Truth) -> Option<Expectation> {
        let (chain, subgoal) = (truth.chain as usize, truth.subgoal as usize);
        Expectation::of_error(&self.task, truth.error, subgoal)
            .or_else(|| Expectation::new(&self.task, &self.intentions, chain, subgoal))
    }

    /// Forgets the open action; an action without grasp completion has no lead and gives no event.
    fn close(&mut self, open: OpenAction, answer: Option<(Expectation, u64)>, events: &mut Vec<Event>) {
        self.open = None;
        if let Some(grasp) = open.grasp {
            events.push(Event::Action(self.describe(open, grasp, answer)));
        }
    }

    fn describe(&self, open: OpenAction, grasp: u64, answer: Option<(Expectation, u64)>) -> ActionEvent {
        let Self { task, intentions, .. } = self;
        let name = |peak: Expectation| peak.name(task, intentions);
        let chain = task.chains.get(open.chain);
        ActionEvent {
            action: open.number,
            chain: chain.map(|chain| chain.name.clone()).unwrap_or_default(),
            kind: chain.map(|chain| task.kinds[chain.kind].name.clone()).unwrap_or_default(),
            subgoal: task.subgoals.get(open.subgoal).map(|goal| goal.name.clone()).unwrap_or_default(),
            onset_ms: open.onset,
            grasp_ms: grasp,
            decided_ms: answer.map(|(_, since)| since),
            lead_ms: answer.map(|(_, since)| grasp as i64 - since as i64),
            decided: answer.map(|(peak, _)| name(peak)),
            expected: open.expectation.map(name),
            correct: answer.is_some_and(|(peak, _)| Some(peak) == open.expectation),
        }
    }
}
