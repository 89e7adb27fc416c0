//! Who only looks at a set never prevents it from recovering.
#![allow(clippy::unwrap_used)]

use coact_messages::{FieldFrame, topic};
use coact_pipeline::Run;
use coact_run_records::SupervisorEventKind;
use coact_tests::{Launched, wait_for};
use iceoryx2::port::subscriber::Subscriber;
use iceoryx2::prelude::*;

/// Takes every place among the readers of the field frames, as a program can that knows nothing of reservations.
fn flood(run: &Run) -> (Vec<Subscriber<ipc::Service, FieldFrame, ()>>, Node<ipc::Service>) {
    let file = run.directory().join("config/iceoryx2.toml");
    let config = Config::from_file(&FilePath::new(file.as_os_str().as_encoded_bytes()).unwrap()).unwrap();
    let node = NodeBuilder::new().config(&config).create::<ipc::Service>().unwrap();
    let name = ServiceName::new(topic::FIELDS).unwrap();
    let service = node.service_builder(&name).publish_subscribe::<FieldFrame>().open().unwrap();
    (std::iter::from_fn(|| service.subscriber_builder().create().ok()).collect(), node)
}

#[test]
fn a_set_whose_fields_are_read_by_as_many_as_get_a_place_replaces_each_of_its_readers() {
    let killed = ["control", "fields", "voice"];
    let kills = ["--inject=control:kill@3s", "--inject=fields:kill@4s", "--inject=voice:kill@5s"];
    let mut arguments = vec!["--duration", "8", "--world", "kinematic"];
    arguments.extend(kills);
    let mut launched = Launched::start(&arguments);
    let run = launched.when_started();
    let (readers, _node) = flood(&run);
    assert!(readers.len() >= 4, "{} places are left to viewers", readers.len());
    for process in killed {
        wait_for("the replacement", || run.ready(process, 1).unwrap());
    }
    let finished = launched.finish();
    for process in killed {
        assert_eq!(finished.count(SupervisorEventKind::Died, process), 1, "{:?}", finished.supervisor);
        assert_eq!(finished.count(SupervisorEventKind::Ready, process), 2, "{:?}", finished.supervisor);
    }
    assert!(finished.cycles("control") > 6000, "{}", finished.stderr);
}
