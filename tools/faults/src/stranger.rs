use crate::{MessageFault, Trouble};
use bytemuck::Pod;
use coact_messages::{Command, FieldFrame, Header, Percept, SensorSample, topic};
use coact_pipeline::Run;
use coact_realtime::now;
use iceoryx2::port::publisher::Publisher;
use iceoryx2::port::subscriber::Subscriber;
use iceoryx2::prelude::*;
use std::error::Error;
use std::fmt::Debug;

/// A program of the same user that joins a run and knows none of its rules.
#[derive(Debug)]
pub(crate) struct Stranger {
    node: Node<ipc::Service>,
}

/// Places among the readers of a topic, taken for as long as this lives.
pub(crate) type Flood = Vec<Subscriber<ipc::Service, FieldFrame, ()>>;

/// Sends one message in the given cycle.
pub(crate) type Sender = Box<dyn FnMut(u64) -> Result<(), Trouble>>;

/// A message that is good by its length only.
trait Spoofed: Pod + Debug + ZeroCopySend {}
impl<T: Pod + Debug + ZeroCopySend> Spoofed for T {}

impl Stranger {
    pub(crate) fn join(run: &Run) -> Result<Self, Trouble> {
        let open = || -> Result<_, Box<dyn Error>> {
            let file = run.directory().join("config/iceoryx2.toml");
            let config = Config::from_file(&FilePath::new(file.as_os_str().as_encoded_bytes())?)?;
            Ok(NodeBuilder::new().config(&config).create::<ipc::Service>()?)
        };
        Ok(Self { node: open().map_err(|error| Trouble::because("no stranger can join")(&*error))? })
    }

    /// What sends messages with this fault on the topic of `process`, once for each call with the present cycle.
    pub(crate) fn spoofs(&self, process: &str, fault: MessageFault) -> Result<Sender, Trouble> {
        match process {
            "world" => self.spoofs_on::<SensorSample>(topic::SENSORS, fault),
            "perception" => self.spoofs_on::<Percept>(topic::PERCEPT, fault),
            "fields" => self.spoofs_on::<FieldFrame>(topic::FIELDS, fault),
            "control" => self.spoofs_on::<Command>(topic::COMMAND, fault),
            other => Err(Trouble(format!("{other} has no topic that anybody needs"))),
        }
    }

    fn spoofs_on<T: Spoofed>(&self, topic: &str, fault: MessageFault) -> Result<Sender, Trouble> {
        let open = || -> Result<_, Box<dyn Error>> {
            let service =
                self.node.service_builder(&ServiceName::new(topic)?).publish_subscribe::<T>().open()?;
            let builder =
                service.publisher_builder().backpressure_strategy(BackpressureStrategy::DiscardData);
            Ok(builder.create()?)
        };
        let publisher = open().map_err(|error| Trouble::because("a stranger found no place")(&*error))?;
        Ok(Box::new(move |tick| send(&publisher, fault, tick)))
    }

    /// Takes every place among the readers of the field frames.
    pub(crate) fn flood(&self) -> Result<Flood, Trouble> {
        let open = || -> Result<_, Box<dyn Error>> {
            let name = ServiceName::new(topic::FIELDS)?;
            Ok(self.node.service_builder(&name).publish_subscribe::<FieldFrame>().open()?)
        };
        let service = open().map_err(|error| Trouble::because("the viewers cannot join")(&*error))?;
        Ok(std::iter::from_fn(|| service.subscriber_builder().create().ok()).collect())
    }
}

fn send<T: Spoofed>(
    publisher: &Publisher<ipc::Service, T, ()>,
    fault: MessageFault,
    tick: u64,
) -> Result<(), Trouble> {
    let mut message: Box<T> = bytemuck::zeroed_box();
    let bytes = bytemuck::bytes_of_mut(&mut *message);
    bytes.fill(fault.fill());
    bytes[..size_of::<Header>()].copy_from_slice(bytemuck::bytes_of(&fault.header(tick, now())));
    let sample =
        publisher.loan_uninit().map_err(|error| Trouble::because("a message was not sent")(&error))?;
    let sent = sample.write_payload(*message).send();
    sent.map(|_| ()).map_err(|error| Trouble::because("a message was not sent")(&error))
}
