//! Histograms and counters: what is written is read back, a restart goes on, damage is found.
#![allow(clippy::unwrap_used)]

use crate::support::pulse;
use coact_monitor::metrics::{END_TO_END, execution_name, hop_name, wakeup_name};
use coact_monitor::{IntervalLog, Latencies, Metrics, PipelineNode};
use std::path::Path;
use std::time::{Duration, SystemTime};

fn open(folder: &Path) -> Latencies {
    let link = |process: &str, from: &str, last| PipelineNode {
        process: process.into(),
        input_from: Some(from.into()),
        last,
    };
    let nodes = vec![link("fields", "perception", false), link("control", "fields", true)];
    Latencies::open(folder, nodes, Duration::from_millis(50), SystemTime::now()).unwrap()
}

fn count(latencies: &Latencies, name: &str) -> u64 {
    latencies.metrics().histograms().get(name).map_or(0, |recorder| recorder.total().len())
}

#[test]
fn each_figure_is_recorded_as_it_is_defined() {
    let folder = tempfile::tempdir().unwrap();
    let mut latencies = open(folder.path());
    latencies.pulse("control", &pulse(0, 20_000));
    let value = |name: &str| latencies.metrics().histograms()[name].total().max();
    let close = |found: u64, wanted: u64| found.abs_diff(wanted) * 1000 <= wanted;
    assert!(close(value(&wakeup_name("control")), 20_000));
    assert!(close(value(&execution_name("control")), 100_000));
    assert!(close(value(&hop_name("fields", "control")), 30_000));
    assert!(close(value(END_TO_END), 170_000));
}

#[test]
fn a_stale_input_is_no_hop_and_only_the_last_process_ends_the_chain() {
    let folder = tempfile::tempdir().unwrap();
    let mut latencies = open(folder.path());
    let mut stale = pulse(0, 0);
    stale.input_received_ns = 0;
    latencies.pulse("fields", &stale);
    assert_eq!(count(&latencies, &hop_name("perception", "fields")), 0);
    assert_eq!(count(&latencies, END_TO_END), 0);
    assert_eq!(count(&latencies, &wakeup_name("fields")), 1);
}

#[test]
fn logs_hold_what_was_recorded_raw_and_corrected() {
    let folder = tempfile::tempdir().unwrap();
    let mut latencies = open(folder.path());
    for cycle in 0..500 {
        // One wake-up of 5 ms hides four more that would have been late.
        latencies.pulse("fields", &pulse(cycle, if cycle == 250 { 5_000_000 } else { 10_000 + cycle }));
        if cycle % 100 == 99 {
            latencies.write().unwrap();
        }
    }
    let recorder = &latencies.metrics().histograms()[&wakeup_name("fields")];
    let log = IntervalLog::read(&folder.path().join("wakeup.fields.hlog")).unwrap();
    assert_eq!(&log.raw, recorder.total());
    assert_eq!(log.corrected, recorder.corrected());
    assert_eq!((log.raw.len(), log.corrected.len()), (500, 504));
}

#[test]
fn a_restarted_monitor_goes_on_counting() {
    let folder = tempfile::tempdir().unwrap();
    let mut killed = open(folder.path());
    (0..100).for_each(|cycle| {
        killed.pulse("fields", &pulse(cycle, 10_000));
    });
    killed.write().unwrap();
    killed.pulse("fields", &pulse(100, 10_000)); // not on disk when it is killed
    drop(killed);

    let mut restarted = open(folder.path());
    restarted.pulse("fields", &pulse(99, 10_000)); // delivered once more to the reader that joins
    (101..200).for_each(|cycle| {
        restarted.pulse("fields", &pulse(cycle, 10_000));
    });
    assert_eq!(count(&restarted, &wakeup_name("fields")), 199);
    assert_eq!(restarted.metrics().counters()["fields"].cycles, 200);
    restarted.write().unwrap();
    let log = IntervalLog::read(&folder.path().join("wakeup.fields.hlog")).unwrap();
    assert_eq!(log.raw.len(), 199);
}

#[test]
fn a_line_that_was_torn_by_a_kill_is_cut_off() {
    let folder = tempfile::tempdir().unwrap();
    let mut killed = open(folder.path());
    killed.pulse("fields", &pulse(0, 10_000));
    killed.write().unwrap();
    let path = folder.path().join("wakeup.fields.hlog");
    let whole = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, format!("{whole}1.000,1.000,1000.0,HISTFAAAA")).unwrap();
    assert!(IntervalLog::read(&path).is_err());
    assert_eq!(count(&open(folder.path()), &wakeup_name("fields")), 1);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), whole);
}

#[test]
fn damage_is_named_with_its_place() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x.hlog");
    let error = |text: &str| {
        std::fs::write(&path, text).unwrap();
        IntervalLog::read(&path).unwrap_err().to_string()
    };
    assert!(error("hello\n").contains("x.hlog:1: not a line of an HdrHistogram interval log"));
    assert!(error("# fine\nhello\n").contains("x.hlog:2:"));
    assert!(error("# fine\n0.0,1.0,5.0,HISTFAAAA\n").contains("interval 1 is damaged"));
    let missing = IntervalLog::read(&folder.path().join("none.hlog")).unwrap_err().to_string();
    assert!(missing.contains("none.hlog"));
}

#[test]
fn logs_are_found_by_their_names() {
    let folder = tempfile::tempdir().unwrap();
    let mut latencies = open(folder.path());
    latencies.pulse("control", &pulse(0, 0));
    latencies.write().unwrap();
    let metrics = Metrics::load(folder.path()).unwrap();
    let names: Vec<_> = metrics.histograms().keys().collect();
    assert_eq!(names, ["end-to-end", "execution.control", "hop.fields.control", "wakeup.control"]);
    assert_eq!(metrics.counters(), latencies.metrics().counters());
}
