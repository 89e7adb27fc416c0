//! Holds the types and the schemas in `docs/schemas` together.
#![allow(clippy::unwrap_used)]

use crate::{Event, Record, Snapshot, Summary, SupervisorEvent};
use schemars::{JsonSchema, schema_for};
use std::path::{Path, PathBuf};

/// With this variable in the environment, the test writes the schemas instead of comparing them.
const WRITE: &str = "COACT_WRITE_SCHEMAS";

fn published(file: &str) -> PathBuf {
    let (name, _) = file.split_once('.').unwrap();
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../../docs/schemas/{name}.schema.json"))
}

fn compare_or_write<T: JsonSchema>(file: &str) {
    let schema = serde_json::to_string_pretty(&schema_for!(T)).unwrap() + "\n";
    let path = published(file);
    if std::env::var_os(WRITE).is_some() {
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, schema).unwrap();
        return;
    }
    let found = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(
        found == schema,
        "{} is not the schema of {file} any more; if the change is meant, tell users of the files about it and run\n  \
         {WRITE}=1 cargo test -p coact-run-records schemas",
        path.display()
    );
}

#[test]
fn each_published_schema_is_that_of_its_type() {
    compare_or_write::<Summary>(Summary::FILE);
    compare_or_write::<Event>(Event::FILE);
    compare_or_write::<SupervisorEvent>(SupervisorEvent::FILE);
    compare_or_write::<Snapshot>(Snapshot::FILE);
}
