//! The next one of a process, started ahead, with shell scripts in place of services.
#![allow(clippy::unwrap_used)]

mod trial;

use coact_pipeline::ProcessStat;
use coact_run_records::SupervisorEventKind;
use coact_supervisor::Fault;
use rustix::process::{Pid, Signal, kill_process};
use std::time::{Duration, Instant};
use trial::{Trial, exists};

/// As a service does: a spare says who it is, and waits for a byte.
const WITH_SPARE: &str = "if [ \"$0\" = --spare ]; then echo $$ > \"$DIR/spare\"; \
    [ $(head -c 1 | wc -c) = 1 ] || exit 0; fi; touch \"$READY\"; exec sleep 600";

fn trial() -> Trial {
    let mut trial = Trial::with(&[("a", WITH_SPARE)], |spec| spec.spare = true);
    trial.run_until_ready();
    trial.set.expect_pulses(Duration::ZERO);
    trial
}

/// Waits for one that is not `before`.
fn spare(trial: &mut Trial, before: Option<u32>) -> u32 {
    let file = trial.folder.path().join("spare");
    let told = || std::fs::read_to_string(&file).ok()?.trim().parse::<u32>().ok();
    trial.until(&mut (), |_| told().is_some_and(|spare| Some(spare) != before)).unwrap();
    told().unwrap()
}

#[test]
fn a_spare_takes_the_place_of_one_that_died_and_gets_one_itself() {
    let mut trial = trial();
    let first = spare(&mut trial, None);
    assert_eq!(trial.count(SupervisorEventKind::Started, "a"), 1, "it is no process of the set yet");
    trial.set.inject("a", Fault::Kill).unwrap();
    trial.until(&mut (), |trial| trial.count(SupervisorEventKind::Ready, "a") == 2).unwrap();
    assert_eq!(trial.pid("a"), first);
    let restarted = trial.events.iter().find(|event| event.event == SupervisorEventKind::Restarted).unwrap();
    assert_eq!((restarted.generation, restarted.pid), (1, first));
    let second = spare(&mut trial, Some(first));
    trial.set.inject("a", Fault::Kill).unwrap();
    trial.until(&mut (), |trial| trial.count(SupervisorEventKind::Ready, "a") == 3).unwrap();
    assert_eq!(trial.pid("a"), second);
}

#[test]
fn a_spare_that_died_is_replaced_and_none_is_waited_for() {
    let mut trial = trial();
    let first = spare(&mut trial, None);
    kill_process(Pid::from_raw(first as i32).unwrap(), Signal::KILL).unwrap();
    let second = spare(&mut trial, Some(first));
    assert!(exists(second));
    kill_process(Pid::from_raw(second as i32).unwrap(), Signal::KILL).unwrap();
    // One whose death was not noticed yet would still take the place of the process, and die there.
    trial.until(&mut (), |_| !exists(second)).unwrap();
    trial.set.inject("a", Fault::Kill).unwrap();
    trial.until(&mut (), |trial| trial.count(SupervisorEventKind::Ready, "a") == 2).unwrap();
    assert!(![first, second].contains(&trial.pid("a")), "it was started anew");
    assert_eq!(trial.count(SupervisorEventKind::Died, "a"), 1, "a spare's death is no death of the process");
}

#[test]
fn no_spare_outlives_its_set() {
    let mut trial = trial();
    let spare = spare(&mut trial, None);
    trial.set.stop(|| ());
    drop(trial);
    let begin = Instant::now();
    // Whoever killed it may still have to reap it.
    while ProcessStat::of(spare).is_ok_and(|stat| stat.exit_code == 0) {
        assert!(begin.elapsed() < Duration::from_secs(10), "the spare lives");
        std::thread::sleep(Duration::from_millis(5));
    }
}
