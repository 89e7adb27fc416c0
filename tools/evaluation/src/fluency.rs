use coact_monitor::ActiveAgents;
use serde::Serialize;

/// How fluently two agents work together, after Hoffman (2019), "Evaluating fluency in human-robot collaboration", IEEE
/// Transactions on Human-Machine Systems 49 (3): all are fractions of the task time.
///
/// Whoever can do nothing but wait for the other is idle.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Fluency {
    /// H-IDLE: the person is not active.
    pub human_idle: f64,
    /// R-IDLE: the robot is not active.
    pub robot_idle: f64,
    /// C-ACT: both are.
    pub concurrent: f64,
    /// F-DEL: sum of the times between the end of one agent's action and the beginning of the other's next one. It
    /// counts where the turn passes from one to the other, and is negative where the other began before that end.
    pub functional_delay: f64,
    /// Part of H-IDLE in which the person, in the middle of an action, waits for the robot.
    pub human_waits: f64,
}

/// Adds up who was active when.
#[derive(Debug, Clone, Default)]
pub(crate) struct FluencyCounter {
    ticks: u64,
    human_idle: u64,
    robot_idle: u64,
    concurrent: u64,
    human_waits: u64,
    delay: i64,
    /// Since when each is active, by [`coact_joint_task::Agent::index`].
    since: [Option<u64>; 2],
    /// Whose turn it is, and since when.
    turn: Option<(usize, u64)>,
}

impl FluencyCounter {
    pub fn tick(&mut self, agents: ActiveAgents) {
        let ActiveAgents { active, waits: [_, person_waits] } = agents;
        let now = self.ticks;
        self.ticks += 1;
        self.robot_idle += u64::from(!active[0]);
        self.human_idle += u64::from(!active[1]);
        self.concurrent += u64::from(active[0] && active[1]);
        self.human_waits += u64::from(person_waits);
        for agent in [0, 1] {
            match (self.since[agent], active[agent]) {
                (None, true) => self.begin(agent, now),
                (Some(since), false) => self.end(agent, since, now),
                _ => {}
            }
        }
    }

    fn begin(&mut self, agent: usize, now: u64) {
        self.since[agent] = Some(now);
        if let Some((_, end)) = self.turn.take().filter(|(whose, _)| *whose == agent) {
            self.delay += (now - end) as i64;
        }
    }

    fn end(&mut self, agent: usize, since: u64, now: u64) {
        self.since[agent] = None;
        let other = 1 - agent;
        match self.since[other] {
            None => self.turn = Some((other, now)),
            Some(began) if began > since => self.delay -= (now - began) as i64,
            Some(_) => {}
        }
    }

    pub fn fluency(&self) -> Fluency {
        let fraction = |ticks: f64| ticks / self.ticks.max(1) as f64;
        Fluency {
            human_idle: fraction(self.human_idle as f64),
            robot_idle: fraction(self.robot_idle as f64),
            concurrent: fraction(self.concurrent as f64),
            functional_delay: fraction(self.delay as f64),
            human_waits: fraction(self.human_waits as f64),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Fluency of two rows of activity, a letter a tick: `#` is active.
    fn fluency(robot: &str, person: &str) -> Fluency {
        let mut counter = FluencyCounter::default();
        for (robot, person) in robot.chars().zip(person.chars()) {
            counter.tick(ActiveAgents { active: [robot == '#', person == '#'], waits: [false; 2] });
        }
        counter.fluency()
    }

    #[test]
    fn turns_with_pauses_cost_their_pauses() {
        let found = fluency("......###.", "###.......");
        assert_eq!((found.human_idle, found.robot_idle, found.concurrent), (0.7, 0.7, 0.0));
        assert_eq!(found.functional_delay, 0.3);
    }

    #[test]
    fn whoever_begins_before_the_other_ends_gains_the_overlap() {
        let found = fluency("..####....", "####......");
        assert_eq!((found.concurrent, found.functional_delay), (0.2, -0.2));
    }

    #[test]
    fn two_actions_of_one_are_no_change_of_turns() {
        assert_eq!(fluency("..........", "##..##....").functional_delay, 0.0);
        assert_eq!(fluency("........##", "##..##....").functional_delay, 0.2);
    }

    #[test]
    fn an_action_within_another_delays_nobody() {
        assert_eq!(fluency("##########", "..###.....").functional_delay, 0.0);
    }
}
