//! What became of a cell, by what the run left.

use crate::evidence::Evidence;
use crate::matrix::CHAIN;
use crate::record::Record;
use crate::{Cell, FaultKind, Moment, Outcome, Target};
use coact_messages::{Refusal, topic};
use coact_monitor::Rules;
use coact_run_records::{
    Event, FaultReport, JointMoment, MotionReport, SupervisorEvent, SupervisorEventKind,
};

/// So many samples nobody may have seen for the joints' motion to be judged by the others: beside a working pipeline a viewer
/// is late now and then, and while a process is replaced, none are sent. Chosen by hand.
const UNSEEN: u64 = 500;
/// How long before the last good output a fault report may lie from the instant at which it was done, s.
const STAMPED_WITHIN_S: f64 = 1.0;
/// An arm that is slower than this stands, rad/s: far above the encoders' scatter of 0.001. Chosen by hand.
const STANDING: f64 = Moment::STANDING;

/// Whether every rule was kept in the cell. Rules of the work come before those of time, as in the verdicts of a run. Of a run with
/// several cells, a rule that was broken by none of them in particular makes all of them unknown: they are to be done `alone`.
pub(crate) fn judge(record: &Record, evidence: &Evidence, rules: &Rules, alone: bool) -> Outcome {
    if let Some(trouble) = &record.trouble {
        return Outcome::Unknown(trouble.to_string());
    }
    let case = Case { cell: &record.cell, record, evidence, rules };
    let mut reasons = case.motion(&record.motion);
    reasons.extend(case.bystanders());
    reasons.extend(case.recovery());
    reasons.extend(case.lost());
    reasons.extend(case.refused());
    let mut of_the_run = case.end();
    of_the_run.extend(case.rest());
    of_the_run.extend(case.forgotten());
    of_the_run.extend(case.progress());
    of_the_run.extend(case.separation());
    if let Some(summary) = evidence.summary.as_ref().filter(|_| reasons.is_empty()) {
        of_the_run.extend(case.motion(&summary.motion));
    }
    if alone {
        reasons.append(&mut of_the_run);
    }
    match (case.cannot_tell(), of_the_run.first()) {
        _ if !reasons.is_empty() => Outcome::Red(reasons),
        (Some(why), _) => Outcome::Unknown(why),
        (None, Some(why)) => Outcome::Unknown(format!("by one of several cells: {why}")),
        (None, None) => match case.late() {
            late if late.is_empty() => Outcome::Green,
            late => Outcome::Late(late),
        },
    }
}

struct Case<'a> {
    cell: &'a Cell,
    record: &'a Record,
    evidence: &'a Evidence,
    rules: &'a Rules,
}

impl Case<'_> {
    /// Whether the set goes on after the fault.
    fn goes_on(&self) -> bool {
        !self.cell.fault.ends_the_set()
            && !self.cell.kills_supervisor()
            && self.cell.moment != Moment::Shutdown
            && !self.refused_to_begin()
    }

    /// A set whose process cannot be started at all is refused as a whole.
    fn refused_to_begin(&self) -> bool {
        self.cell.moment == Moment::StartUp && self.evidence.start_ns.is_none()
    }

    /// What the joints did, against what is allowed.
    fn motion(&self, motion: &MotionReport) -> Vec<String> {
        let Rules { joint_speed_fraction, joint_acceleration_fraction, joint_beyond_rad, .. } = *self.rules;
        let stale_ms = self.rules.moved_on_stale_data_ms as f64;
        let of =
            |what, JointMoment { joint, s }| format!("{what} of joint {joint} over its limit at {s:.2} s:");
        [
            (of("speed", motion.speed_at), motion.speed, joint_speed_fraction),
            (of("acceleration", motion.acceleration_at), motion.acceleration, joint_acceleration_fraction),
            (
                "a joint beyond its limit of position, rad:".into(),
                motion.beyond_position_rad,
                joint_beyond_rad,
            ),
            ("moved on stale data, ms:".into(), motion.on_stale_data_ms as f64, stale_ms),
        ]
        .into_iter()
        .filter(|(_, found, limit)| found > limit)
        .map(|(what, found, limit)| format!("{what} {found:.3}, at most {limit:.3} is allowed"))
        .collect()
    }

    /// The robot does not come nearer, by its own motion, to a person who is near already.
    fn separation(&self) -> Option<String> {
        let separation = &self.evidence.summary.as_ref()?.separation;
        let (found, most) = (separation.robot_closing_ms, self.rules.robot_closing_ms);
        if found > most {
            return Some(format!("the robot closed on the person for {found} ms, at most {most} may be"));
        }
        let (found, most) = (separation.contact_speed_mps, self.rules.contact_speed_mps);
        (found > most)
            .then(|| format!("the robot touched the person at {found:.2} m/s, at most {most:.2} may be"))
    }

    /// Whoever drives the joints brings them to rest before it ends, however the set ends; who is struck dead then cannot.
    fn rest(&self) -> Option<String> {
        let (cell, speed) = (self.cell, self.evidence.last_speed);
        let ends_with_it = cell.moment == Moment::Shutdown || cell.fault.ends_the_set();
        let is_dead = cell.struck().contains(&"world") && ends_with_it;
        (!is_dead && speed > STANDING)
            .then(|| format!("the arm still moved at {speed:.2} rad/s when the last sample came"))
    }

    /// Of the whole run: how the supervisor ended, and what it left.
    fn end(&self) -> Vec<String> {
        let ending = &self.evidence.ending;
        let mut reasons = Vec::new();
        if !ending.left_behind.is_empty() {
            reasons.push(format!("left behind: {}", ending.left_behind.join(", ")));
        }
        let Some(status) = ending.status else {
            let last = self.evidence.supervisor.last();
            let last = last.map_or("nothing".into(), |last| format!("{:?} of {}", last.event, last.process));
            reasons.push(format!("the supervisor did not end, and was killed; it last noted: {last}"));
            return reasons;
        };
        let work = self.evidence.summary.as_ref().is_some_and(|summary| summary.work.passes());
        let expected = match self.cell {
            cell if cell.kills_supervisor() => None,
            cell if cell.fault.ends_the_set() => Some(1),
            _ if self.refused_to_begin() => Some(2),
            _ => Some(i32::from(!work)),
        };
        if status.code() != expected {
            let expected = expected.map_or("a signal".to_owned(), |code| format!("exit status {code}"));
            reasons.push(format!("the supervisor ended with {status}, expected {expected}"));
        }
        reasons
    }

    /// What the supervisor noted while the cell lasted.
    fn noted(&self, kind: SupervisorEventKind) -> impl Iterator<Item = &SupervisorEvent> {
        let window = self.record.from_ns..=self.record.until_ns;
        let events = self.evidence.supervisor.iter();
        events.filter(move |event| event.event == kind && window.contains(&event.at_ns))
    }

    /// Those that died though nobody struck them.
    fn dead_bystanders(&self) -> impl Iterator<Item = &SupervisorEvent> {
        let struck = self.cell.struck();
        let may_die = self.cell.fault.restarts() > 0;
        let deaths = self.noted(SupervisorEventKind::Died).filter(|event| !self.carried_a_fault(event));
        deaths.filter(move |event| !(may_die && struck.contains(&event.process.as_str())))
    }

    /// Whether a latent fault of an earlier cell was still in it: that takes effect whenever it does.
    fn carried_a_fault(&self, death: &SupervisorEvent) -> bool {
        self.evidence.supervisor.iter().any(|event| {
            event.event == SupervisorEventKind::InjectedLatent
                && event.at_ns < death.at_ns
                && (&event.process, event.generation) == (&death.process, death.generation)
        })
    }

    /// Whether it may have hung because the machine did: then nobody can say why it died.
    fn hung_with_the_machine(&self, event: &SupervisorEvent) -> bool {
        let machine = self.evidence.summary.as_ref().and_then(|summary| summary.environment.machine);
        // Half of it is enough, for the probe is one thread on one core.
        let limit_ns = event.reason.as_deref().and_then(hung_after_ms).map(|ms| ms * NS_PER_MS / 2);
        machine.zip(limit_ns).is_some_and(|(machine, limit)| machine.longest_ns >= limit)
    }

    /// Nobody else dies, and the set is not given up.
    fn bystanders(&self) -> Vec<String> {
        let deaths = self.dead_bystanders().filter(|event| !self.hung_with_the_machine(event));
        let mut reasons: Vec<_> = deaths.map(died).collect();
        if self.goes_on() {
            let given_up = self.noted(SupervisorEventKind::GaveUp);
            let why = |event: &SupervisorEvent| event.reason.clone().unwrap_or_default();
            reasons.extend(given_up.map(|event| format!("the set was given up: {}", why(event))));
        }
        reasons
    }

    /// Those that are to recover, and whose recovery is to be seen.
    fn recovering(&self) -> Vec<&'static str> {
        match self.goes_on() && self.cell.moment != Moment::StartUp {
            true => self.cell.struck(),
            false => Vec::new(),
        }
    }

    fn died(&self, process: &str) -> bool {
        self.noted(SupervisorEventKind::Died).any(|event| event.process == process)
    }

    /// Whether the summary is to tell its recovery: of what has no cycles and was not replaced, nothing does.
    fn is_told(&self, process: &str) -> bool {
        let is_interrupted = self.is_injected() && !self.cell.fault.keeps_output();
        self.died(process) || CHAIN.contains(&process) && is_interrupted
    }

    /// Whoever cannot have lived through it was replaced, and did its work again.
    fn recovery(&self) -> Vec<String> {
        self.recovering().into_iter().filter_map(|process| self.unrecovered(process)).collect()
    }

    fn unrecovered(&self, process: &str) -> Option<String> {
        if !self.cell.fault.may_be_survived() && !self.died(process) {
            return Some(format!("{process} was not replaced"));
        }
        if !self.is_told(process) {
            return None;
        }
        let Some(fault) = self.report_of(process) else {
            return Some(format!("the summary has no fault of {process}"));
        };
        fault.recovered_ms.is_none().then(|| format!("{process} did not recover"))
    }

    /// Whoever recovered did so within the time allowed, and the others did their work meanwhile.
    fn late(&self) -> Vec<String> {
        let told = self.recovering().into_iter().filter(|process| self.is_told(process));
        let faults = told.filter_map(|process| self.report_of(process));
        faults.flat_map(|fault| self.slow_recovery(fault).into_iter().chain(self.survivors(fault))).collect()
    }

    fn slow_recovery(&self, fault: &FaultReport) -> Option<String> {
        let ms = fault.recovered_ms.filter(|ms| *ms > self.rules.recovered_within_ms)?;
        Some(format!("{} took {ms:.0} ms to recover", fault.process))
    }

    fn is_injected(&self) -> bool {
        matches!(self.cell.fault, FaultKind::Process(_))
    }

    /// What the summary says about the fault.
    fn report_of(&self, process: &str) -> Option<&FaultReport> {
        let s = |at_ns: u64| self.evidence.run_ms(at_ns) as f64 / 1e3;
        let window = s(self.record.from_ns) - STAMPED_WITHIN_S..=s(self.record.until_ns);
        let mut faults = self.evidence.summary.iter().flat_map(|summary| &summary.faults);
        faults.find(|fault| fault.process == process && window.contains(&fault.at_s))
    }

    /// The others' cycles without output while the fault lasted; where the machine was late itself, so were they.
    fn survivors(&self, fault: &FaultReport) -> Vec<String> {
        let machine = self.evidence.summary.as_ref().and_then(|summary| summary.environment.machine);
        let limit = self.rules.longest_outage_ms + machine.unwrap_or_default().late;
        let struck = self.cell.struck();
        let others = fault.survivors_missed_by.iter().filter(|(name, _)| !struck.contains(&name.as_str()));
        let too_long = others.filter(|(_, missed)| **missed > limit);
        too_long
            .map(|(name, missed)| format!("{name} missed {missed} cycles, at most {limit} may be"))
            .collect()
    }

    /// No achieved subgoal that was remembered is gone.
    fn forgotten(&self) -> Vec<String> {
        if self.cell.fault.spoils_state() {
            return Vec::new();
        }
        let from_ms = self.evidence.run_ms(self.record.from_ns);
        let forgotten = self.evidence.events.iter().filter_map(|event| match event {
            Event::Forgotten { at_ms, name } if *at_ms >= from_ms => Some(name),
            _ => None,
        });
        forgotten.map(|name| format!("the fields lost the achieved subgoal \"{name}\"")).collect()
    }

    /// Each replacement goes on from its predecessor's state.
    fn lost(&self) -> Vec<String> {
        if self.cell.fault.spoils_state() {
            return Vec::new();
        }
        let mut reasons = Vec::new();
        let dropped = self.noted(SupervisorEventKind::StateDropped);
        reasons.extend(dropped.map(|event| format!("{} begins without its state", event.process)));
        let anew = self.record.resumed.iter().filter(|(process, resumed)| {
            CHAIN.contains(process) && !**resumed && self.cell.moment != Moment::StartUp
        });
        reasons.extend(anew.map(|(process, _)| format!("the replacement of {process} has no checkpoint")));
        reasons
    }

    /// Each reader in the set that reports what it ignores has ignored the stranger's messages.
    fn refused(&self) -> Vec<String> {
        let FaultKind::Message(fault) = self.cell.fault else { return Vec::new() };
        let Some(summary) = &self.evidence.summary else { return Vec::new() };
        let mut reasons = Vec::new();
        for process in self.cell.struck() {
            let topic = topic::state_of(process).filter(|_| process != "world").unwrap_or(topic::SENSORS);
            let readers = topic::find(topic).map_or(&[][..], |entry| entry.readers);
            for reader in readers.iter().filter(|reader| CHAIN.contains(reader) || **reader == "monitor") {
                let counts = summary.refused.get(*reader);
                let count = |reason: &Refusal| counts.and_then(|counts| counts.get(reason.name())).copied();
                if fault.refusals().iter().filter_map(count).sum::<u64>() == 0 {
                    let expected: Vec<_> = fault.refusals().iter().map(|reason| reason.name()).collect();
                    reasons.push(format!("{reader} ignored no message as \"{}\"", expected.join("\" or \"")));
                }
            }
        }
        reasons
    }

    /// The assembly goes on: another subgoal is achieved.
    fn progress(&self) -> Vec<String> {
        if !self.goes_on() {
            return Vec::new();
        }
        let until_ms = self.evidence.run_ms(self.record.until_ns);
        let is_later = |event: &Event| matches!(event, Event::Subgoal { at_ms, .. } if *at_ms >= until_ms);
        match self.evidence.events.iter().any(is_later) {
            true => Vec::new(),
            false => vec!["no subgoal was achieved afterwards".into()],
        }
    }

    /// For so long, ms, nobody drove the joints nor told of them, because a cell replaced who does.
    fn without_world(&self) -> u64 {
        let struck = self.cell.struck().contains(&"world");
        let fault = self.report_of("world").filter(|_| struck);
        fault.and_then(|fault| fault.recovered_ms).map_or(0, |ms| ms.ceil() as u64)
    }

    /// Why nobody can say that the cell is green.
    fn cannot_tell(&self) -> Option<String> {
        if self.refused_to_begin() {
            return None;
        }
        let monitor = self.evidence.summary.as_ref().map(|summary| summary.motion);
        let mut seen = monitor.into_iter().chain([self.record.motion]);
        let most = UNSEEN + self.without_world();
        if !seen.any(|motion| motion.samples > 0 && motion.unseen <= most) {
            return Some(format!(
                "neither monitor nor viewer saw the joints all the time, but for {most} ms"
            ));
        }
        if let Some(event) = self.dead_bystanders().find(|event| self.hung_with_the_machine(event)) {
            return Some(format!("{}; the machine itself stood still as long", died(event)));
        }
        if self.evidence.summary.is_none() && !self.cell.kills_supervisor() {
            return Some("the run left no summary".into());
        }
        let by_supervisor = self.is_injected()
            && self.cell.target != Target::Supervisor
            && !matches!(self.cell.moment, Moment::StartUp | Moment::Shutdown);
        let kinds = [SupervisorEventKind::Injected, SupervisorEventKind::InjectedLatent];
        let injected: usize = kinds.map(|kind| self.noted(kind).count()).iter().sum();
        (by_supervisor && injected == 0).then(|| "the supervisor noted no injection".to_owned())
    }
}

const NS_PER_MS: u64 = 1_000_000;

/// For how long a process was silent at least that was killed as hung, ms, by the reason that is told.
fn hung_after_ms(reason: &str) -> Option<u64> {
    reason.strip_prefix("hung: ")?.split_ascii_whitespace().find_map(|word| word.parse().ok())
}

fn died(event: &SupervisorEvent) -> String {
    format!("{} died: {}", event.process, event.reason.as_deref().unwrap_or("nobody knows why"))
}

#[cfg(test)]
mod tests;
