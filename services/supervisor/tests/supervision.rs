//! The supervision of real processes, with shell scripts in place of services.
#![allow(clippy::unwrap_used)]

mod trial;

use coact_pipeline::{ProcessStat, Ready};
use coact_run_records::{RunLog, SupervisorEvent, SupervisorEventKind};
use coact_supervisor::{Checkpoints, Fault, InjectionRefusal, RunningChild};
use rustix::process::{Pid, Signal};
use std::time::{Duration, Instant};
use trial::{Crowd, READY_AND_RUN, RecordedCalls, Trial, exists};

#[test]
fn each_process_starts_when_those_before_it_are_ready() {
    use SupervisorEventKind::{Ready, Started};
    let slowly = "sleep 0.2; touch \"$READY\"; exec sleep 600";
    let mut trial =
        Trial::in_steps(&[("first", slowly), ("second", READY_AND_RUN), ("third", READY_AND_RUN)]);
    trial.run_until_ready();
    let expected = [
        (Started, "first"),
        (Ready, "first"),
        (Started, "second"),
        (Ready, "second"),
        (Started, "third"),
        (Ready, "third"),
    ];
    assert_eq!(trial.sequence(), expected);
}

#[test]
fn a_killed_process_is_replaced_after_its_checkpoint_was_published_and_the_others_run_on() {
    let mut trial = Trial::of(&[("a", READY_AND_RUN), ("b", READY_AND_RUN)]);
    trial.run_until_ready();
    let (a, b) = (trial.pid("a"), trial.pid("b"));
    trial.set.inject("a", Fault::Kill).unwrap();
    let mut calls = RecordedCalls::default();
    trial.until(&mut calls, |trial| trial.count(SupervisorEventKind::Ready, "a") == 2).unwrap();
    assert_eq!(calls.0, ["publish a", "recovered a"]);
    assert_eq!(trial.pid("b"), b);
    assert_ne!(trial.pid("a"), a);
    let died = trial.events.iter().find(|event| event.event == SupervisorEventKind::Died).unwrap();
    assert_eq!((died.pid, died.reason.as_deref()), (a, Some("killed by SIGKILL")));
    assert_eq!(died.fault.as_deref(), Some("kill"));
    let restarted = trial.events.iter().find(|event| event.event == SupervisorEventKind::Restarted).unwrap();
    assert_eq!((restarted.generation, restarted.pid), (1, trial.pid("a")));
}

#[test]
fn a_replacement_that_dies_of_its_checkpoint_is_followed_by_one_that_begins_anew() {
    // The first one is killed, the second takes up what it left and crashes, the third lives.
    let poisoned = "touch \"$READY\"; [ \"$COACT_GENERATION\" = 1 ] && exit 101; exec sleep 600";
    let mut trial = Trial::of(&[("a", poisoned)]);
    trial.run_until_ready();
    rustix::process::kill_process(
        rustix::process::Pid::from_raw(trial.pid("a") as i32).unwrap(),
        rustix::process::Signal::KILL,
    )
    .unwrap();
    let mut calls = RecordedCalls::default();
    let third = |trial: &Trial| {
        trial.events.iter().any(|event| event.event == SupervisorEventKind::Ready && event.generation == 2)
    };
    trial.until(&mut calls, third).unwrap();
    let calls: Vec<_> = calls.0.into_iter().filter(|call| !call.starts_with("recovered")).collect();
    assert_eq!(calls, ["publish a", "drop a", "publish a"]);
    let dropped = trial.events.iter().find(|event| event.event == SupervisorEventKind::StateDropped).unwrap();
    assert_eq!(dropped.reason.as_deref(), Some("its memory"));
}

#[test]
fn replacements_that_others_kill_keep_their_checkpoint() {
    let killed = "touch \"$READY\"; [ \"$COACT_GENERATION\" -lt 3 ] && kill -9 $$; exec sleep 600";
    let mut trial = Trial::of(&[("a", killed)]);
    let mut calls = RecordedCalls::default();
    let fourth = |trial: &Trial| {
        trial.events.iter().any(|event| event.event == SupervisorEventKind::Ready && event.generation == 3)
    };
    trial.until(&mut calls, fourth).unwrap();
    assert!(calls.0.iter().all(|call| !call.starts_with("drop")), "{:?}", calls.0);
}

#[test]
fn crash_on_start_kills_the_replacement_before_it_is_ready_and_the_next_one_lives() {
    let mut trial = Trial::of(&[("a", READY_AND_RUN)]);
    trial.run_until_ready();
    trial.set.inject("a", Fault::CrashOnStart).unwrap();
    trial.until(&mut (), |trial| trial.count(SupervisorEventKind::Ready, "a") == 2).unwrap();
    let ready = trial.events.iter().rfind(|event| event.event == SupervisorEventKind::Ready).unwrap();
    assert_eq!(ready.generation, 2);
    assert_eq!(trial.count(SupervisorEventKind::Died, "a"), 2);
}

#[test]
fn a_crash_loop_gives_the_set_up() {
    let mut trial = Trial::of(&[("a", READY_AND_RUN)]);
    trial.run_until_ready();
    trial.set.inject("a", Fault::CrashLoop).unwrap();
    let gave_up = trial.gives_up();
    assert!(gave_up.reason.starts_with("killed before it was ready, by an injected fault"), "{gave_up:?}");
    assert_eq!(trial.count(SupervisorEventKind::Ready, "a"), 1);
}

#[test]
fn a_crash_loop_gives_the_set_up_in_a_crowd_too() {
    let mut trial = Trial::of(&[("a", READY_AND_RUN)]);
    trial.run_until_ready();
    trial.set.inject("a", Fault::CrashLoop).unwrap();
    let gave_up = trial.until(&mut Crowd, |_| false).unwrap_err();
    assert!(gave_up.reason.starts_with("killed before it was ready, by an injected fault"), "{gave_up:?}");
}

#[test]
fn a_replacement_that_finds_no_place_is_tried_again_more_often_than_one_that_crashes() {
    let refused = "[ \"$COACT_GENERATION\" -gt 0 ] && exit 1; touch \"$READY\"; exec sleep 600";
    let mut trial = Trial::of(&[("a", refused)]);
    trial.run_until_ready();
    trial.set.inject("a", Fault::Kill).unwrap();
    let deaths = |trial: &Trial| trial.count(SupervisorEventKind::Died, "a");
    trial.until(&mut Crowd, |trial| deaths(trial) == 6).unwrap();
}

#[test]
fn a_replacement_that_stands_still_while_it_starts_is_killed_and_the_next_one_lives() {
    let mut trial = Trial::of(&[("a", &format!("sleep 0.05; {READY_AND_RUN}"))]);
    trial.run_until_ready();
    trial.set.inject("a", Fault::StuckOnStart).unwrap();
    trial.until(&mut (), |trial| trial.count(SupervisorEventKind::Ready, "a") == 2).unwrap();
    let died: Vec<_> = trial.events.iter().filter(|event| event.event == SupervisorEventKind::Died).collect();
    assert_eq!(died.len(), 2);
    assert!(
        died[1].reason.as_deref().is_some_and(|reason| reason.starts_with("not ready within")),
        "{died:?}"
    );
}

#[test]
fn a_process_that_aborts_is_started_again() {
    let mut trial = Trial::of(&[("a", READY_AND_RUN)]);
    trial.run_until_ready();
    trial.set.inject("a", Fault::Abort).unwrap();
    trial.until(&mut (), |trial| trial.count(SupervisorEventKind::Ready, "a") == 2).unwrap();
    let died = trial.events.iter().find(|event| event.event == SupervisorEventKind::Died).unwrap();
    assert_eq!((died.reason.as_deref(), died.fault.as_deref()), (Some("killed by SIGABRT"), Some("abort")));
}

#[test]
fn a_process_killed_while_it_starts_is_started_again() {
    let dies_once =
        "if mkdir \"$DIR/once\" 2>/dev/null; then kill -9 $$; fi; touch \"$READY\"; exec sleep 600";
    let mut trial = Trial::of(&[("a", dies_once), ("b", READY_AND_RUN)]);
    trial.run_until_ready();
    assert_eq!(trial.count(SupervisorEventKind::Died, "a"), 1);
    assert_eq!(trial.count(SupervisorEventKind::Restarted, "a"), 1);
    assert_eq!(trial.count(SupervisorEventKind::Started, "b"), 1);
}

#[test]
fn a_replacement_that_is_stuck_in_its_start_is_replaced_after_ten_times_the_usual() {
    let stuck_once =
        "[ $COACT_GENERATION = 1 ] && exec sleep 600; sleep 0.05; touch \"$READY\"; exec sleep 600";
    let mut trial = Trial::of(&[("a", stuck_once)]);
    trial.run_until_ready();
    trial.set.inject("a", Fault::Kill).unwrap();
    let begin = Instant::now();
    trial.until(&mut (), |trial| trial.count(SupervisorEventKind::Ready, "a") == 2).unwrap();
    assert!(begin.elapsed() > Duration::from_millis(500) && begin.elapsed() < Duration::from_secs(20));
    let died = trial.events.iter().rfind(|event| event.event == SupervisorEventKind::Died).unwrap();
    assert!(died.reason.as_deref().unwrap().starts_with("not ready within "), "{died:?}");
}

#[test]
fn a_process_that_refuses_to_start_is_not_started_again() {
    let mut trial = Trial::of(&[("a", "echo 'task.toml:3: no such kind' >&2; exit 1")]);
    let gave_up = trial.gives_up();
    assert!(gave_up.configuration);
    assert_eq!(gave_up.stderr_tail, ["task.toml:3: no such kind"]);
    assert_eq!(trial.count(SupervisorEventKind::Restarted, "a"), 0);
}

#[test]
fn a_process_that_dies_over_and_over_is_given_up_with_the_tail_of_its_stderr() {
    let mut trial = Trial::of(&[("a", "touch \"$READY\"; sleep 0.1; echo 'the arm is on fire' >&2; exit 1")]);
    let gave_up = trial.gives_up();
    assert!(!gave_up.configuration);
    assert_eq!(trial.count(SupervisorEventKind::Restarted, "a"), 3);
    assert_eq!(trial.count(SupervisorEventKind::GaveUp, "a"), 1);
    let text = gave_up.to_string();
    for part in ["exit status 1", "3 restarts within 600 s are allowed", "the arm is on fire"] {
        assert!(text.contains(part), "{text}");
    }
}

#[test]
fn what_is_not_needed_is_restarted_for_ever_and_keeps_nobody_waiting() {
    let mut trial =
        Trial::with(&[("a", READY_AND_RUN), ("extra", "echo 'no microphone' >&2; exit 1")], |spec| {
            spec.needed = spec.name == "a";
            spec.order = u32::from(spec.name == "a");
        });
    trial.until(&mut (), |trial| trial.set.may_begin()).unwrap();
    assert!(!trial.set.all_ready() && trial.count(SupervisorEventKind::Ready, "a") == 1);
    // Far more often than the policy has restarts.
    trial.until(&mut (), |trial| trial.count(SupervisorEventKind::Died, "extra") == 12).unwrap();
    assert_eq!(trial.count(SupervisorEventKind::GaveUp, "extra"), 0);
    assert_eq!(trial.count(SupervisorEventKind::Died, "a"), 0);
}

/// Topics on which others have taken all places, as long as this file does not exist.
struct Crowded(std::path::PathBuf);

impl Checkpoints for Crowded {
    fn publish(&mut self, _: &str) -> Option<String> {
        None
    }
    fn recovered(&mut self, _: &str) {}
    fn crowd(&self, process: &str) -> Option<String> {
        (!self.0.exists()).then(|| format!("no place for {process}"))
    }
}

#[test]
fn a_replacement_that_is_kept_out_by_others_is_started_until_there_is_a_place_and_the_set_is_not_given_up() {
    let needs_place =
        "[ $COACT_GENERATION = 0 ] || [ -e \"$DIR/place\" ] || exit 1; touch \"$READY\"; exec sleep 600";
    let mut trial = Trial::of(&[("a", needs_place), ("b", READY_AND_RUN)]);
    trial.run_until_ready();
    trial.set.inject("a", Fault::Kill).unwrap();
    let place = trial.folder.path().join("place");
    let mut crowded = Crowded(place.clone());
    // Far more often than the policy has restarts.
    trial.until(&mut crowded, |trial| trial.count(SupervisorEventKind::Died, "a") == 12).unwrap();
    let reason = trial.events.iter().rfind(|event| event.event == SupervisorEventKind::Died).unwrap();
    assert_eq!(reason.reason.as_deref(), Some("ended by itself with exit status 1; no place for a"));
    std::fs::write(place, "").unwrap();
    trial.until(&mut crowded, |trial| trial.set.all_ready()).unwrap();
    assert_eq!(trial.count(SupervisorEventKind::Died, "b"), 0);
}

#[test]
fn a_process_that_never_gets_ready_is_given_up_with_the_reason() {
    let mut trial = Trial::with(&[("a", "echo 'waiting for the camera' >&2; exec sleep 600")], |spec| {
        spec.ready_within = Duration::from_millis(200);
    });
    let gave_up = trial.gives_up();
    assert!(gave_up.configuration);
    assert_eq!(gave_up.reason, "not ready within 0.2 s");
    assert_eq!(gave_up.stderr_tail, ["waiting for the camera"]);
}

#[test]
fn a_program_that_does_not_exist_is_named() {
    let mut trial = Trial::with(&[("a", "")], |spec| spec.program = "/no/such/program".into());
    assert!(trial.gives_up().reason.contains("/no/such/program"));
}

#[test]
fn all_are_stopped_in_descending_order_and_one_that_ignores_the_signal_is_killed() {
    let ignores_signal = "trap '' TERM; touch \"$READY\"; while :; do sleep 0.01; done";
    let mut trial = Trial::in_steps(&[
        ("first", READY_AND_RUN),
        ("a", READY_AND_RUN),
        ("ignores-signal", ignores_signal),
        ("z", READY_AND_RUN),
    ]);
    trial.run_until_ready();
    let pids: Vec<u32> = trial.set.pids().map(|(_, pid)| pid).collect();
    trial.events.clear();
    trial.set.stop(|| {});
    trial.events.extend(trial.set.take_events());
    let requested = trial.events.extract_if(.., |event| event.event == SupervisorEventKind::StopRequested);
    assert_eq!(requested.count(), pids.len());
    let order: Vec<&str> = trial.sequence().iter().map(|(_, name)| *name).collect();
    assert_eq!(order, ["z", "ignores-signal", "a", "first"]);
    assert!(trial.events.iter().all(|event| event.event == SupervisorEventKind::Stopped));
    assert!(
        trial.events[1].reason.as_deref().unwrap().starts_with("killed: it did not"),
        "{:?}",
        trial.events
    );
    assert!(pids.into_iter().all(|pid| !exists(pid)));
}

#[test]
fn one_that_dies_before_its_turn_to_stop_is_reaped_and_the_others_are_waited_for_without_haste() {
    let takes_its_time = "trap 'sleep 0.3; exit' TERM; touch \"$READY\"; while :; do sleep 0.01; done";
    let mut trial = Trial::in_steps(&[("first", READY_AND_RUN), ("last", takes_its_time)]);
    trial.run_until_ready();
    let first = Pid::from_raw(trial.pid("first") as i32).unwrap();
    rustix::process::kill_process(first, Signal::KILL).unwrap();
    let (mut looks, begin) = (0, Instant::now());
    trial.set.stop(|| looks += 1);
    let most = begin.elapsed().as_millis() as u32 / 3 + 10;
    assert!(looks <= most, "looked {looks} times, at most {most} expected: it kept its core from the others");
    trial.events.extend(trial.set.take_events());
    assert_eq!(trial.count(SupervisorEventKind::Died, "first"), 1);
    assert_eq!(trial.count(SupervisorEventKind::Stopped, "last"), 1);
}

#[test]
fn those_of_the_same_order_start_and_stop_together() {
    let waits_for_other =
        "touch \"$DIR/$$\"; while [ $(ls \"$DIR\" | grep -cE '^[0-9]+$') -lt 2 ]; do sleep 0.01; done";
    let script = format!("{waits_for_other}; {READY_AND_RUN}");
    let mut trial = Trial::of(&[("a", &script), ("b", &script)]);
    trial.run_until_ready();
    trial.set.stop(|| {});
    assert_eq!(trial.set.pids().count(), 0);
}

#[test]
fn a_dropped_set_leaves_no_process_behind() {
    let mut trial = Trial::of(&[("a", READY_AND_RUN), ("b", READY_AND_RUN)]);
    trial.run_until_ready();
    let pids: Vec<u32> = trial.set.pids().map(|(_, pid)| pid).collect();
    assert!(pids.iter().all(|&pid| exists(pid)));
    drop(trial);
    assert!(pids.into_iter().all(|pid| !exists(pid)));
}

#[test]
fn an_unknown_process_is_refused_with_the_names_that_there_are() {
    let mut trial = Trial::of(&[("a", READY_AND_RUN), ("b", READY_AND_RUN)]);
    let refusal = trial.set.inject("c", Fault::Kill).unwrap_err();
    assert_eq!(refusal.to_string(), "unknown process 'c'; this set has: a, b");
    assert_eq!(trial.set.inject("a", Fault::Kill), Err(InjectionRefusal::NotRunning("a".into())));
}

#[test]
fn the_log_on_disk_holds_every_event() {
    let mut trial = Trial::of(&[("a", READY_AND_RUN)]);
    trial.run_until_ready();
    trial.set.inject("a", Fault::Kill).unwrap();
    trial.until(&mut (), |trial| trial.count(SupervisorEventKind::Ready, "a") == 2).unwrap();
    let logged = RunLog::<SupervisorEvent>::read(trial.folder.path()).unwrap();
    assert_eq!(logged, trial.events);
    assert!(logged.is_sorted_by_key(|event| event.at_ns));
}

#[test]
fn a_process_of_an_earlier_supervisor_is_known_by_its_start_is_heard_and_ends_when_it_is_dropped() {
    let mut command = std::process::Command::new("/bin/sh");
    command.args(["-c", "echo said >&2; exec sleep 600"]).stderr(std::process::Stdio::piped());
    let mut process = command.spawn().unwrap();
    let started = ProcessStat::of(process.id()).unwrap().started;
    let ready = Ready { pid: process.id(), started, ..Ready::default() };
    let other = Ready { started: started + 1, ..ready.clone() };
    assert!(RunningChild::adopt(&other, |_| {}).is_none(), "another process has its id now");
    assert!(process.try_wait().unwrap().is_none(), "and is not harmed");
    let (sender, lines) = std::sync::mpsc::channel();
    let adopted = RunningChild::adopt(&ready, move |line| sender.send(line.to_owned()).unwrap()).unwrap();
    assert_eq!(lines.recv_timeout(Duration::from_secs(60)).unwrap(), "said");
    assert!(!adopted.is_dead() && !adopted.is_stopped());
    adopted.signal(Signal::STOP);
    let begin = Instant::now();
    while !adopted.is_stopped() {
        assert!(begin.elapsed() < Duration::from_secs(60));
    }
    drop(adopted);
    assert!(RunningChild::adopt(&ready, |_| {}).is_none(), "it is dead, though nobody has reaped it");
    assert!(!process.wait().unwrap().success());
}

#[test]
fn a_supervisor_that_panics_kills_nobody_itself() {
    let mut trial = Trial::of(&[("a", READY_AND_RUN)]);
    trial.run_until_ready();
    let pid = trial.pid("a");
    let panicked = std::thread::spawn(move || {
        let _set = trial;
        panic!("as a supervisor would");
    });
    assert!(panicked.join().is_err());
    // What the kernel does to it when the supervisor's thread ends is another matter; this thread has started it.
    assert!(exists(pid));
    let process = Pid::from_raw(pid.cast_signed()).unwrap();
    rustix::process::kill_process(process, Signal::KILL).unwrap();
    rustix::process::waitpid(Some(process), rustix::process::WaitOptions::empty()).unwrap();
}
