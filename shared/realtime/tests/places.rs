//! Places on topics: viewers get what is left, and the replacements of the set's processes find theirs.
#![allow(clippy::unwrap_used)]

mod support;

use coact_messages::{FieldFrame, topic};
use coact_pipeline::{Pipeline, Run};
use coact_realtime::{Bus, Input, PortError, Reservation, TopicAnchors};
use iceoryx2::port::subscriber::Subscriber;
use iceoryx2::prelude::*;
use support::{TABLE, TestRun};

fn read(bus: &Bus) -> Result<Input<FieldFrame>, PortError> {
    bus.input(topic::FIELDS)
}

/// A program that knows nothing of reservations: takes every place that it gets.
struct Flood {
    _readers: Vec<Subscriber<ipc::Service, FieldFrame, ()>>,
    _node: Node<ipc::Service>,
}

impl Flood {
    fn of(run: &Run) -> Self {
        let mut config = Config::default();
        config.global.prefix = FileName::new(run.prefix().as_bytes()).unwrap();
        config.global.set_root_path(&Path::new(run.iceoryx2_root().as_os_str().as_encoded_bytes()).unwrap());
        let node = NodeBuilder::new().config(&config).create::<ipc::Service>().unwrap();
        let name = ServiceName::new(topic::FIELDS).unwrap();
        let service = node.service_builder(&name).publish_subscribe::<FieldFrame>().open().unwrap();
        let readers = std::iter::from_fn(|| service.subscriber_builder().create().ok()).collect();
        Self { _readers: readers, _node: node }
    }
}

#[test]
fn viewers_get_their_places_and_one_too_many_is_refused_in_clear_words() {
    let run = TestRun::new(TABLE);
    let supervisor = Bus::open(&run.0, "supervisor", 0).unwrap();
    let _anchor = read(&supervisor).unwrap();
    let viewer = Bus::open(&run.0, "viewer", 0).unwrap();
    let mut open: Vec<_> = (0..4).map(|_| read(&viewer).unwrap()).collect();
    let refusal = read(&viewer).unwrap_err();
    assert!(matches!(refusal, PortError::NoPlace { viewers: 4, .. }), "{refusal}");
    assert!(refusal.to_string().contains("coact/fields: 4 programs outside the set"), "{refusal}");
    let control = Bus::open(&run.0, "control", 0).unwrap();
    read(&control).unwrap();
    open.pop();
    read(&viewer).unwrap();
}

#[test]
fn a_flood_of_readers_leaves_the_reserved_place_to_the_replacement() {
    let run = TestRun::new(TABLE);
    let pipeline = Pipeline::load(&run.0.settings().pipeline).unwrap();
    let supervisor = Bus::open(&run.0, "supervisor", 0).unwrap();
    let anchors = TopicAnchors::new(&supervisor, &pipeline).unwrap();
    let predecessor = Bus::open(&run.0, "control", 0).unwrap();
    let _place_of_the_dead = read(&predecessor).unwrap();
    let reservation = Reservation::take(&run.0, &pipeline, "control").unwrap();
    let _flood = Flood::of(&run.0);
    let replacement = Bus::open(&run.0, "control", 1).unwrap();
    assert!(read(&replacement).is_err(), "the flood took every place that there was");
    let crowd = anchors.crowd("control").unwrap();
    assert!(crowd.starts_with("coact/fields has no place for another reader: "), "{crowd}");
    assert_eq!(anchors.crowd("world"), None, "it reads other topics");
    drop(reservation);
    assert_eq!(anchors.crowd("control"), None);
    read(&replacement).unwrap();
}
