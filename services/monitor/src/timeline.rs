use crate::ActiveAgents;
use coact_joint_task::{ActionType, Agent, Task};
use coact_messages::{ARM_JOINTS, Command, MotionPhase, PartnerPhase, PersonWait, Truth};
use coact_run_records::{Occupation, TimelineSpan, Waiting};

/// Follows what robot and person do, tick by tick, and who waits for whom.
#[derive(Debug)]
pub struct Timeline {
    task: Task,
    /// By [`Agent::index`].
    open: [Option<Doing>; 2],
}

/// What an agent does at the moment.
#[derive(Debug, Clone, Copy)]
struct Doing {
    occupation: Occupation,
    /// The robot's action; the person's chain and subgoal.
    about: [u32; 2],
    from_ms: u64,
}

/// An arm whose joints are all slower than this stands, rad/s.
const STILL: f64 = 1e-3;
/// An arm that is slower than this fraction of its planned speed is held back. Chosen by hand: the guard lets an arm beside a person
/// become faster little by little.
const HELD_BACK: f64 = 0.95;

impl Timeline {
    /// For a task.
    pub fn new(task: &Task) -> Self {
        Self { task: task.clone(), open: [None; 2] }
    }

    /// What is true in a cycle, and what the arm is commanded; what is over is appended to `spans`.
    pub fn tick(&mut self, truth: &Truth, command: &Command, spans: &mut Vec<TimelineSpan>) {
        let at_ms = truth.header.cycle;
        let robot = occupation_of_robot(&self.task, truth, command);
        spans.extend(
            self.follow(
                Agent::Robot,
                Doing { occupation: robot, about: [command.action; 2], from_ms: at_ms },
            ),
        );
        let about = [truth.chain, truth.subgoal];
        spans.extend(
            self.follow(
                Agent::Person,
                Doing { occupation: occupation_of_person(truth), about, from_ms: at_ms },
            ),
        );
    }

    /// The run is over at `end_ms`, and with it what is still done.
    pub fn finish(&mut self, end_ms: u64, spans: &mut Vec<TimelineSpan>) {
        spans.extend([Agent::Robot, Agent::Person].into_iter().filter_map(|agent| self.close(agent, end_ms)));
    }

    /// What is over when an agent does this.
    fn follow(&mut self, agent: Agent, now: Doing) -> Option<TimelineSpan> {
        let open = &self.open[agent.index()];
        let goes_on = |open: &Doing| open.occupation == now.occupation && open.about == now.about;
        if open.as_ref().is_some_and(goes_on) {
            return None;
        }
        let over = self.close(agent, now.from_ms);
        self.open[agent.index()] = Some(now);
        over
    }

    fn close(&mut self, agent: Agent, until_ms: u64) -> Option<TimelineSpan> {
        let Doing { occupation, about, from_ms } = self.open[agent.index()].take()?;
        let (who, what) = match agent {
            Agent::Robot => (Waiting::Robot, self.action(about[0])),
            Agent::Person => (Waiting::Person, self.meaning(about)),
        };
        Some(TimelineSpan { who, occupation, what, from_ms, until_ms })
    }

    fn action(&self, action: u32) -> String {
        self.task.actions.get(action as usize).map_or_else(String::new, |action| action.name.clone())
    }

    fn meaning(&self, [chain, subgoal]: [u32; 2]) -> String {
        let (chain, subgoal) =
            (self.task.chains.get(chain as usize), self.task.subgoals.get(subgoal as usize));
        match (chain, subgoal) {
            (Some(chain), Some(subgoal)) => format!("{}: {}", chain.name, subgoal.name),
            (Some(chain), None) => chain.name.clone(),
            (None, _) => String::new(),
        }
    }
}

fn occupation_of_person(truth: &Truth) -> Occupation {
    match truth.person_wait() {
        PersonWait::Steadying => Occupation::WaitsForSteadying,
        PersonWait::Receiving => Occupation::WaitsForReceiving,
        PersonWait::Part => Occupation::WaitsForPart,
        PersonWait::Release => Occupation::WaitsForRelease,
        PersonWait::Subgoal => Occupation::WaitsForSubgoal,
        PersonWait::Nothing => match truth.phase {
            phase if phase == PartnerPhase::Reach as u32 => Occupation::Reaches,
            phase if phase == PartnerPhase::Transport as u32 => Occupation::Carries,
            phase if phase == PartnerPhase::Act as u32 => Occupation::Handles,
            phase if phase == PartnerPhase::Withdraw as u32 => Occupation::Withdraws,
            _ => Occupation::Rests,
        },
    }
}

fn occupation_of_robot(task: &Task, truth: &Truth, command: &Command) -> Occupation {
    let is = |phase: MotionPhase| command.phase == phase as u32;
    if is(MotionPhase::Rest) {
        return Occupation::Rests;
    }
    if is(MotionPhase::Grasp) || is(MotionPhase::Release) {
        return Occupation::Handles;
    }
    if is(MotionPhase::Dwell) {
        let steadies = ActiveAgents::now(task, truth, command).active[Agent::Robot.index()];
        return if steadies { Occupation::Steadies } else { Occupation::Waits };
    }
    if is(MotionPhase::Brake) || command.speed_override < HELD_BACK {
        return Occupation::HeldBack;
    }
    if command.velocity[..ARM_JOINTS].iter().all(|velocity| velocity.abs() < STILL) {
        return Occupation::Plans;
    }
    let action = task.actions.get(command.action as usize).map(|action| action.action_type);
    if is(MotionPhase::Prepare) {
        return Occupation::Prepares;
    }
    match action {
        None | Some(ActionType::Speak | ActionType::Report) => Occupation::Withdraws,
        Some(_) if is(MotionPhase::Approach) => Occupation::Approaches,
        Some(_) if is(MotionPhase::Transport) => Occupation::Carries,
        Some(_) => Occupation::Reaches,
    }
}
