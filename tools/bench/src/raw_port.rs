use crate::BenchError;
use coact_messages::{Header, SensorSample};
use coact_pipeline::ProcessEntry;
use coact_realtime::{SchedulingClass, now};
use iceoryx2::port::{listener::Listener, notifier::Notifier, publisher::Publisher, subscriber::Subscriber};
use iceoryx2::prelude::*;
use rustix::thread::{CpuSet, sched_setaffinity};
use std::path::Path;
use std::time::Duration;

type Service = ipc::Service;

/// One end of the raw hop: iceoryx2 as its own examples use it, with the payload of the topic that it is compared with.
#[derive(Debug)]
pub(crate) enum RawPort {
    Sender {
        publisher: Publisher<Service, SensorSample, ()>,
        notifier: Notifier<Service>,
        _node: Node<Service>,
    },
    Receiver {
        subscriber: Subscriber<Service, SensorSample, ()>,
        listener: Listener<Service>,
        _node: Node<Service>,
    },
}

/// What the names of the shared memory begin with that belongs to this folder.
pub(crate) fn prefix(folder: &Path) -> String {
    format!("{}_", folder.file_name().unwrap_or_default().to_string_lossy())
}

/// Gives the calling thread what the process has, as far as the machine grants it.
pub(crate) fn become_like(entry: Option<&ProcessEntry>) {
    let Some(entry) = entry else { return };
    if let Some(core) = entry.core.filter(|core| *core < CpuSet::MAX_CPU) {
        let mut cores = CpuSet::new();
        cores.set(core);
        // Refused, it runs where the process that was refused the same does.
        let _ = sched_setaffinity(None, &cores);
    }
    let _ = SchedulingClass::Fifo(entry.priority).apply();
}

fn refused(error: impl std::fmt::Debug) -> BenchError {
    BenchError::Port(format!("{error:?}"))
}

impl RawPort {
    /// Opens an end below a folder of its own.
    pub(crate) fn open(folder: &Path, sends: bool) -> Result<Self, BenchError> {
        let mut config = Config::default();
        config.global.prefix = FileName::new(prefix(folder).as_bytes()).map_err(refused)?;
        let root = iceoryx2::prelude::Path::new(folder.as_os_str().as_encoded_bytes()).map_err(refused)?;
        config.global.set_root_path(&root);
        let node = NodeBuilder::new().config(&config).signal_handling_mode(SignalHandlingMode::Disabled);
        let node = node.create::<Service>().map_err(refused)?;
        let name = ServiceName::new("hop").map_err(refused)?;
        let messages = node.service_builder(&name).publish_subscribe::<SensorSample>();
        let messages = messages.enable_safe_overflow(true).subscriber_max_buffer_size(2);
        let messages = messages.open_or_create().map_err(refused)?;
        let event = node.service_builder(&name).event().open_or_create().map_err(refused)?;
        if sends {
            let publisher = messages.publisher_builder().create().map_err(refused)?;
            let notifier = event.notifier_builder().create().map_err(refused)?;
            return Ok(Self::Sender { publisher, notifier, _node: node });
        }
        let subscriber = messages.subscriber_builder().create().map_err(refused)?;
        let listener = event.listener_builder().create().map_err(refused)?;
        Ok(Self::Receiver { subscriber, listener, _node: node })
    }

    /// Sends a message that says when.
    pub(crate) fn send(&self) -> Result<(), BenchError> {
        let Self::Sender { publisher, notifier, .. } = self else { return Ok(()) };
        let mut sample = publisher.loan_uninit().map_err(refused)?;
        let message = sample.payload_mut().as_mut_ptr();
        // SAFETY: the loaned memory is this message's alone, and large and aligned enough for it.
        unsafe { (&raw mut (*message).header).write(Header { published_ns: now(), ..Header::default() }) };
        // SAFETY: every byte is initialised: the kernel filled the segment with zeros, and only such messages are written to it.
        let sample = unsafe { sample.assume_init() };
        sample.send().map_err(refused)?;
        notifier.notify().map_err(refused)?;
        Ok(())
    }

    /// Waits for a message, and says how long ago it was sent, ns; none when none came in time.
    pub(crate) fn receive(&self, within: Duration) -> Result<Option<u64>, BenchError> {
        let Self::Receiver { subscriber, listener, .. } = self else { return Ok(None) };
        listener.timed_wait(|_| {}, within).map_err(refused)?;
        let mut newest = None;
        while let Some(sample) = subscriber.receive().map_err(refused)? {
            newest = Some(now().saturating_sub(sample.header.published_ns));
        }
        Ok(newest)
    }
}
