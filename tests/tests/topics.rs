//! The table of topics, from which the diagram of processes is drawn, agrees with what the processes of a set open.
#![allow(clippy::unwrap_used)]

use coact_messages::topic::{ALL, ANYONE, resume, state_of};
use coact_messages::{
    Command, FieldFrame, HandPoints, Percept, Pulse, SensorSample, Speech, StopState, TopicEntry, Truth,
    WorldState,
};
use coact_pipeline::Run;
use coact_tests::{Launched, wait_for};
use iceoryx2::identifiers::UniqueNodeId;
use iceoryx2::node::NodeView;
use iceoryx2::prelude::*;
use rustix::process::Signal;
use std::collections::{BTreeMap, BTreeSet};

/// Names of the processes that write a topic, and of those that read it.
#[derive(Debug, Default, PartialEq, Eq)]
struct Parties {
    writers: BTreeSet<String>,
    readers: BTreeSet<String>,
}

/// Looks into a run's shared memory as any client of iceoryx2 can.
struct Client {
    node: Node<ipc::Service>,
    /// Name of each node of the run; a process may have another one, which is called after it.
    processes: BTreeMap<UniqueNodeId, String>,
}

impl Client {
    fn of(run: &Run) -> Self {
        let file = run.directory().join("config/iceoryx2.toml");
        let file = FilePath::new(file.as_os_str().as_encoded_bytes()).unwrap();
        let config = Config::from_file(&file).unwrap();
        let mut processes = BTreeMap::new();
        Node::<ipc::Service>::list(&config, |state| {
            if let NodeState::Alive(node) = state
                && let Some(details) = node.details()
            {
                let name = details.name().as_str();
                // The supervisor's reservations take places for replacements; they are no parties.
                if !name.ends_with("-reservation") {
                    processes.insert(*node.id(), name.split('-').next().unwrap().to_owned());
                }
            }
            CallbackProgression::Continue
        })
        .unwrap();
        let node = NodeBuilder::new().config(&config).create::<ipc::Service>().unwrap();
        Self { node, processes }
    }

    /// Who has ports of `topic`, whose messages are of the type with this name.
    fn parties(&self, topic: &str, message: &str) -> Parties {
        match message {
            "Command" => self.of_type::<Command>(topic),
            "FieldFrame" => self.of_type::<FieldFrame>(topic),
            "HandPoints" => self.of_type::<HandPoints>(topic),
            "Percept" => self.of_type::<Percept>(topic),
            "Pulse" => self.of_type::<Pulse>(topic),
            "SensorSample" => self.of_type::<SensorSample>(topic),
            "Speech" => self.of_type::<Speech>(topic),
            "StopState" => self.of_type::<StopState>(topic),
            "Truth" => self.of_type::<Truth>(topic),
            "WorldState" => self.of_type::<WorldState>(topic),
            _ => panic!("{topic}: the type {message} is not in this list yet"),
        }
    }

    fn of_type<T: ZeroCopySend + std::fmt::Debug>(&self, topic: &str) -> Parties {
        let name = ServiceName::new(topic).unwrap();
        let service = self.node.service_builder(&name).publish_subscribe::<T>().open().unwrap();
        let mut parties = Parties::default();
        let name = |node: &UniqueNodeId| self.processes.get(node).cloned();
        service.dynamic_config().list_publishers(|port| {
            parties.writers.extend(name(&port.node_id));
            CallbackProgression::Continue
        });
        service.dynamic_config().list_subscribers(|port| {
            parties.readers.extend(name(&port.node_id));
            CallbackProgression::Continue
        });
        parties
    }
}

fn set(names: &[&str]) -> BTreeSet<String> {
    names.iter().filter(|name| **name != ANYONE).map(|name| (*name).to_owned()).collect()
}

/// The topics of an entry, with the name of their messages' type and the parties that the table names.
fn expected(entry: &TopicEntry) -> Vec<(String, &'static str, Parties)> {
    match entry.name.split_once('*') {
        None => {
            let parties = Parties { writers: set(entry.writers), readers: set(entry.readers) };
            vec![(entry.name.to_owned(), entry.message, parties)]
        }
        Some((begin, "")) => {
            let pulse = |stage: &&str| {
                let parties = Parties { writers: set(&[stage]), readers: set(entry.readers) };
                (format!("{begin}{stage}"), entry.message, parties)
            };
            entry.writers.iter().map(pulse).collect()
        }
        // The checkpoint of a process is read by its replacement alone, while that starts.
        Some(_) => {
            let checkpoint = |stage: &&str| {
                let topic = state_of(stage).unwrap();
                let message = coact_messages::topic::find(topic).unwrap().message;
                let parties = Parties { writers: set(entry.writers), ..Parties::default() };
                (resume(topic), message, parties)
            };
            entry.readers.iter().map(checkpoint).collect()
        }
    }
}

#[test]
fn processes_open_the_topics_that_the_table_names() {
    let mut launched = Launched::start(&["--world", "kinematic", "--console", "--partner", "hand"]);
    let run = launched.when_started();
    let topics: Vec<_> = ALL.iter().flat_map(expected).collect();
    assert_eq!(topics.len(), 10 + 4 + 4);
    let found = || {
        let client = Client::of(&run);
        topics.iter().find(|(topic, message, parties)| client.parties(topic, message) != *parties)
    };
    // The supervisor opens its own readers when all others have started.
    let mut differs = None;
    let mut looks = 0;
    wait_for("the supervisor's ports", || {
        (differs, looks) = (found(), looks + 1);
        (differs.is_none() || looks == 200).then_some(())
    });
    if let Some((topic, message, parties)) = differs {
        panic!(
            "{topic}: the table says {parties:?}, open are {:?}",
            Client::of(&run).parties(topic, message)
        );
    }
    launched.signal(Signal::TERM);
    launched.finish();
}
