//! The table of topics holds together, and the diagram of processes and topics is drawn from it.
#![allow(clippy::unwrap_used)]

use crate::drawing::drawing;
use coact_messages::topic::{ALL, announces, depth, find, may_read, pulse, resume, state_of};
use std::path::Path;

#[test]
fn every_topic_has_one_entry() {
    for entry in &ALL {
        let name = entry.name.replace('*', "world");
        let covering: Vec<_> = ALL.iter().filter(|other| other.covers(&name)).collect();
        assert_eq!(covering, [entry], "{name}");
        assert!(!entry.writers.is_empty() && !entry.readers.is_empty(), "{name}");
    }
    assert_eq!(find(&pulse("world")).unwrap().message, "Pulse");
    assert_eq!(find(&resume("coact/fields")).unwrap().writers, ["supervisor"]);
    assert_eq!(find("coact/my-own"), None);
}

#[test]
fn a_topic_of_one_s_own_is_plain_and_open() {
    assert_eq!((announces("coact/my-own"), depth("coact/my-own")), (false, 2));
    assert!(may_read("coact/my-own", "anything"));
}

#[test]
fn each_stage_has_one_checkpoint_which_the_supervisor_reads() {
    for stage in ["world", "perception", "fields", "control"] {
        let entry = find(state_of(stage).unwrap()).unwrap();
        assert!(entry.checkpoint && entry.writers == [stage] && entry.readers.contains(&"supervisor"));
    }
    assert_eq!((state_of("monitor"), state_of("voice")), (None, None));
}

/// `COACT_WRITE_DIAGRAM=1 cargo test -p coact-messages --test messages processes` draws it anew.
#[test]
fn diagram_in_the_documents_is_the_one_that_the_table_draws() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/processes.svg");
    if std::env::var_os("COACT_WRITE_DIAGRAM").is_some() {
        std::fs::write(&file, drawing()).unwrap();
    }
    let found = std::fs::read_to_string(&file).unwrap_or_default();
    let how = "COACT_WRITE_DIAGRAM=1 cargo test -p coact-messages --test messages processes";
    assert!(found == drawing(), "docs/processes.svg is not what the table of topics draws: {how}");
}
