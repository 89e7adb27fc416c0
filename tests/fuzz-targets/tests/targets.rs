//! Every target takes any bytes: for `COACT_FUZZ_SECONDS` each, one if that is not set.
#![allow(clippy::unwrap_used)]

use coact_fuzz_targets::{Bounds, Input, TARGETS, Target, checkout, exercise, find, seeds};
use rustix::time::{ClockId, Timespec, clock_gettime};
use std::io::Write;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// How long each target is exercised, s, if nothing else is said.
const SECONDS: f64 = 1.0;
/// So many targets at a time.
const THREADS: usize = 2;
/// A single input that takes longer than this hangs; the processor's time tells sooner of one that computes. Chosen by hand, for a
/// machine that is busy with other tests.
const HUNG: Duration = Duration::from_secs(120);

/// The variable's number of seconds.
fn asked() -> Option<f64> {
    std::env::var("COACT_FUZZ_SECONDS")
        .ok()
        .map(|text| text.parse().expect("COACT_FUZZ_SECONDS: expected seconds"))
}

/// Says at once what a program that an overflowing stack or an impossible allocation ends cannot say any more.
fn say(words: &str) {
    let _ = writeln!(std::io::stderr(), "{words}");
}

/// Exercises targets one after the other until none is left; what failed is kept where it can be added to the corpus.
fn work(left: &Mutex<Vec<&'static Target>>, bounds: &Bounds, failures: &Mutex<Vec<String>>) {
    loop {
        let Some(target) = left.lock().unwrap().pop() else { return };
        let begin = Instant::now();
        say(&format!("{} ...", target.name));
        match exercise(target, bounds) {
            Ok(seen) => say(&format!(
                "{:22}{:8} inputs, {:3.0} % taken in, {:4} MiB and {:4.0} ms at most, {:.1} s",
                target.name,
                seen.inputs,
                100.0 * seen.taken as f64 / seen.inputs as f64,
                seen.memory >> 20,
                1e3 * seen.processor,
                begin.elapsed().as_secs_f64()
            )),
            Err(failure) => {
                let file =
                    std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("failed-{}", target.name));
                std::fs::write(&file, &failure.input).unwrap();
                failures.lock().unwrap().push(format!("{failure}\n  kept as {}", file.display()));
            }
        }
    }
}

#[test]
fn no_input_makes_a_reader_panic_hang_or_take_much_memory() {
    let only = std::env::var("COACT_FUZZ_ONLY").ok();
    let chosen =
        TARGETS.iter().filter(|target| only.as_deref().is_none_or(|only| target.name.starts_with(only)));
    let left: Vec<&'static Target> = chosen.filter_map(|target| find(target.name)).collect();
    let bounds = Bounds { seconds: asked().unwrap_or(SECONDS), ..Bounds::default() };
    let at_most = HUNG + Duration::from_secs_f64(bounds.seconds * left.len() as f64);
    let (left, failures) = (Mutex::new(left), Mutex::new(Vec::new()));
    let begin = Instant::now();
    std::thread::scope(|scope| {
        let workers: Vec<_> = (0..THREADS).map(|_| scope.spawn(|| work(&left, &bounds, &failures))).collect();
        while workers.iter().any(|worker| !worker.is_finished()) {
            std::thread::sleep(Duration::from_millis(20));
            if begin.elapsed() > at_most {
                say("a target hangs: one of those that are not named above");
                std::process::abort();
            }
        }
    });
    let failures = failures.into_inner().unwrap();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// The seed of the bad targets.
const SEED: &[u8] = include_bytes!("../../../rt-config/verdict.toml");

const fn bad(run: fn(&[u8]) -> bool) -> Target {
    Target { name: "bad", input: Input::Text, seeds: &["rt-config/verdict.toml"], run }
}

/// What is found of a target that does what none may do.
fn found(run: fn(&[u8]) -> bool) -> String {
    exercise(&bad(run), &Bounds { processor: 0.2, ..Bounds::default() }).unwrap_err().to_string()
}

#[test]
fn a_target_that_panics_hangs_eats_memory_or_refuses_its_seed_is_found() {
    let panics = |bytes: &[u8]| bytes.is_empty() || bytes == SEED || panic!("at last");
    assert!(found(panics).contains("at last"));
    assert!(found(|bytes| vec![1_u8; 300 << 20].len() > bytes.len()).contains("takes 300 MiB"));
    let spins = |_: &[u8]| {
        // Time of this thread, not of the wall: on a busy machine it gets a part of that.
        let used = || clock_gettime(ClockId::ThreadCPUTime);
        let begin = used();
        while used() - begin < Timespec::try_from(Duration::from_millis(400)).unwrap() {}
        true
    };
    assert!(found(spins).contains("of the processor"));
    assert!(found(|_| false).contains("refuses its own seed"));
}

#[test]
fn every_target_has_a_seed_that_it_takes_in_and_a_name_of_its_own() {
    for (index, target) in TARGETS.iter().enumerate() {
        assert!(
            TARGETS[..index].iter().all(|other| other.name != target.name),
            "{} is there twice",
            target.name
        );
        assert!(seeds(target).iter().any(|seed| seed.good), "{}: no good seed", target.name);
    }
}

/// Names of the entries of a folder, without their endings.
fn names(folder: &str) -> Vec<String> {
    let entries = std::fs::read_dir(checkout().join(folder)).unwrap();
    let mut names: Vec<_> = entries
        .map(|entry| entry.unwrap().path().file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    names.sort();
    names
}

#[test]
fn every_kept_seed_belongs_to_a_target_and_cargo_fuzz_has_all_targets() {
    let mut targets: Vec<_> = TARGETS.iter().map(|target| target.name.to_owned()).collect();
    targets.sort();
    assert_eq!(names("fuzz/fuzz_targets"), targets, "one file for each target");
    let manifest = std::fs::read_to_string(checkout().join("fuzz/Cargo.toml")).unwrap();
    for target in &targets {
        assert!(
            manifest.contains(&format!("path = \"fuzz_targets/{target}.rs\"")),
            "{target} is not in the manifest"
        );
        let wrapper =
            std::fs::read_to_string(checkout().join(format!("fuzz/fuzz_targets/{target}.rs"))).unwrap();
        assert!(wrapper.contains(&format!("run(\"{target}\", bytes)")), "{target}: {wrapper}");
    }
    for folder in names("tests/fuzz-targets/corpus") {
        assert!(targets.contains(&folder), "corpus/{folder} belongs to no target");
    }
}
