use crate::any_topic::{AnyTopic, Bytes, NoHeader, header_type, message_type};
use crate::port::{Reader, Writer};
use crate::run_view::RunView;
use crate::zero_copy_reader::ZeroCopyReader;
use crate::zero_copy_writer::ZeroCopyWriter;
use crate::{Input, Message, Output, PortError, Refusals, places};
use coact_messages::{Header, LAYOUT, topic};
use coact_pipeline::Run;
use iceoryx2::prelude::*;
use iceoryx2::service::port_factory::event;
use iceoryx2::service::static_config::message_type_details::TypeDetail;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Writers of one topic: the living one and its standby, and dead ones until the supervisor has cleaned up after them. It does
/// so before each restart but the first, so there are two dead ones of each at most; one more is reserve.
pub(crate) const MAX_WRITERS: usize = 7;
/// Processes that may have one topic open: the set (9 with the supervisor), the reservations for their replacements (8),
/// the dead until they are cleaned up after, and operators' tools. Chosen by hand; more would only cost shared memory.
const MAX_NODES: usize = 32;
/// How often a replacement looks for its checkpoint. A trade-off: less often would lengthen the recovery by a fraction of
/// a period, more often would take time from the processes that live on.
const CHECKPOINT_POLL: Duration = Duration::from_micros(200);

/// Opens ports on one run's topics: a process's iceoryx2 node, kept apart from other runs by the run's prefix.
#[derive(Debug)]
pub struct Bus {
    node: Box<dyn Joined>,
    process: String,
    generation: u32,
    run: Arc<RunView>,
    refusals: Arc<Refusals>,
}

/// A node behind a trait, for the same reason as ports: who drops a bus need not compile iceoryx2.
trait Joined: std::fmt::Debug {
    fn node(&self) -> &Node<ipc::Service>;
}

impl Joined for Node<ipc::Service> {
    fn node(&self) -> &Node<ipc::Service> {
        self
    }
}

impl Bus {
    /// Joins `run` as `process`, in its `generation`-th restart.
    ///
    /// # Errors
    /// [`PortError::Join`].
    pub fn open(run: &Run, process: &str, generation: u32) -> Result<Self, PortError> {
        set_log_level_from_env_or(LogLevel::Fatal);
        // iceoryx2 makes files, sockets and shared memory: nobody else may open them, whatever umask the process was given.
        rustix::process::umask(rustix::fs::Mode::RWXG | rustix::fs::Mode::RWXO);
        let refused = |problem: String| PortError::Join { process: process.to_owned(), problem };
        let config = config(run).map_err(refused)?;
        let name = NodeName::new(process).map_err(|error| refused(format!("{error:?}")))?;
        let node = NodeBuilder::new()
            .name(&name)
            .config(&config)
            .signal_handling_mode(SignalHandlingMode::Disabled)
            .create::<ipc::Service>()
            .map_err(|error| refused(format!("{error:?}")))?;
        // Its count of nodes iceoryx2 opens to everyone, whatever the umask.
        run.close_to_others().map_err(|error| refused(error.to_string()))?;
        let (run, refusals) = (Arc::new(RunView::new(run)), Arc::default());
        Ok(Self { node: Box::new(node), process: process.to_owned(), generation, run, refusals })
    }

    /// Counts what its inputs ignore in `refusals`, too: for a thread of a process that has a bus of its own.
    #[must_use]
    pub fn counting_in(mut self, refusals: Arc<Refusals>) -> Self {
        self.refusals = refusals;
        self
    }

    /// What its inputs have ignored.
    pub fn refusals(&self) -> &Arc<Refusals> {
        &self.refusals
    }

    /// The run's clock has been started.
    pub(crate) fn start(&self, start_ns: u64) {
        self.run.start(start_ns);
    }

    /// A writer of `topic`. It announces each message by an event if [`topic::announces`] says so.
    ///
    /// # Errors
    /// [`PortError::Refused`].
    pub fn output<T: Message>(&self, topic: &str) -> Result<Output<T>, PortError> {
        Ok(Output::new(topic, self.writer(topic, &message_type::<T>())?, self.generation))
    }

    /// A reader of `topic`.
    ///
    /// # Errors
    /// [`PortError::Refused`], or [`PortError::Closed`].
    pub fn input<T: Message>(&self, topic: &str) -> Result<Input<T>, PortError> {
        self.reader(topic, false)
    }

    /// A reader of `topic` that can wait for its messages.
    ///
    /// # Errors
    /// As [`Bus::input`].
    pub fn trigger<T: Message>(&self, topic: &str) -> Result<Input<T>, PortError> {
        self.reader(topic, true)
    }

    /// The checkpoint of a killed predecessor: its newest message on `topic`, as the supervisor's
    /// [`CheckpointStore`](crate::CheckpointStore) publishes it.
    ///
    /// `None` when the predecessor left nothing, or when nobody publishes anything `within` this time.
    ///
    /// # Errors
    /// [`PortError::Refused`].
    pub fn checkpoint<T: Message>(&self, topic: &str, within: Duration) -> Result<Option<Box<T>>, PortError> {
        let topic = topic::resume(topic);
        let mut port = self.port(&topic, &message_type::<T>(), false)?;
        let since = Instant::now();
        while since.elapsed() < within {
            port.receive(&mut |_, origin| self.run.is_supervisor(origin))?;
            match port.newest().map(bytemuck::try_from_bytes) {
                Some(message) => return Ok(message.ok().and_then(|message| self.usable(message))),
                None => std::thread::sleep(CHECKPOINT_POLL),
            }
        }
        Ok(None)
    }

    /// The checkpoint that the supervisor's message holds, if it is one and is not damaged.
    fn usable<T: Message>(&self, message: &T) -> Option<Box<T>> {
        let Header { layout, cycle, .. } = *message.header();
        // The supervisor says that there is no checkpoint by a header of zeros.
        if layout == 0 {
            return None;
        }
        let flaw = match message.check() {
            _ if layout != LAYOUT => format!("its layout is {layout}, expected {LAYOUT}"),
            Err(flaw) => flaw.to_string(),
            Ok(()) => return Some(Box::new(*message)),
        };
        tracing::warn!("{} begins anew: its checkpoint of cycle {cycle} is damaged: {flaw}", self.process);
        None
    }

    /// Frees what dead processes left in shared memory; returns how many were cleaned up.
    ///
    /// Takes 1 to 9 ms for each: never to be called on a real-time thread.
    pub fn clean_dead(&self) -> u64 {
        self.node.node().try_cleanup_dead_nodes().cleanups
    }

    /// Name of the process.
    pub fn process(&self) -> &str {
        &self.process
    }

    fn reader<T: Message>(&self, topic: &str, waits: bool) -> Result<Input<T>, PortError> {
        self.may_read(topic)?;
        let port = self.port(topic, &message_type::<T>(), waits)?;
        Ok(Input::new(topic, port, self.run.clone(), self.refusals.clone()))
    }

    /// A reader of messages of `kind` on `topic`; one that `waits` hears the topic's event.
    pub(crate) fn port(
        &self,
        topic: &str,
        kind: &TypeDetail,
        waits: bool,
    ) -> Result<Box<dyn Reader>, PortError> {
        Ok(Box::new(ZeroCopyReader::open(self, topic, kind, waits)?))
    }

    fn writer(&self, topic: &str, kind: &TypeDetail) -> Result<Box<dyn Writer>, PortError> {
        Ok(Box::new(ZeroCopyWriter::open(self, topic, kind)?))
    }

    fn may_read(&self, topic: &str) -> Result<(), PortError> {
        match topic::may_read(topic, &self.process) {
            true => Ok(()),
            false => Err(PortError::closed(topic, &self.process)),
        }
    }

    /// The topic itself; every process asks for the same properties.
    pub(crate) fn service(&self, topic: &str, kind: &TypeDetail) -> Result<AnyTopic, PortError> {
        let builder = self.node.node().service_builder(&service_name(topic)?);
        let builder = builder.publish_subscribe::<Bytes>().user_header::<NoHeader>();
        // SAFETY: both details come from types of plain memory, and whoever opens the topic by other ones is refused; so what
        // arrives has the size and alignment that are told here.
        let builder = unsafe {
            builder
                .__internal_set_payload_type_details(kind)
                .__internal_set_user_header_type_details(&header_type())
        };
        builder
            // A reader that hangs loses old messages; it never delays the writer.
            .enable_safe_overflow(true)
            .history_size(1)
            .subscriber_max_buffer_size(topic::depth(topic))
            // The one that the stage reads, and the newer one that replaces it.
            .subscriber_max_borrowed_samples(2)
            .max_subscribers(places::readers(topic))
            .max_publishers(MAX_WRITERS)
            .max_nodes(MAX_NODES)
            .open_or_create()
            .map_err(|error| PortError::refused(topic, "opening", error))
    }

    /// The event that announces the topic's messages.
    pub(crate) fn event(&self, topic: &str) -> Result<event::PortFactory<ipc::Service>, PortError> {
        self.node
            .node()
            .service_builder(&service_name(topic)?)
            .event()
            .max_listeners(places::readers(topic))
            .max_notifiers(MAX_WRITERS)
            .max_nodes(MAX_NODES)
            .event_id_max_value(1)
            .open_or_create()
            .map_err(|error| PortError::refused(topic, "opening its event", error))
    }
}

fn service_name(topic: &str) -> Result<ServiceName, PortError> {
    ServiceName::new(topic).map_err(|error| PortError::refused(topic, "naming", error))
}

fn config(run: &Run) -> Result<Config, String> {
    let mut config = Config::default();
    let prefix = run.prefix();
    let root = run.iceoryx2_root();
    config.global.prefix =
        FileName::new(prefix.as_bytes()).map_err(|error| format!("{prefix}: {error:?}"))?;
    let root_bytes = root.as_os_str().as_encoded_bytes();
    let path = Path::new(root_bytes).map_err(|error| format!("{}: {error:?}", root.display()))?;
    config.global.set_root_path(&path);
    // Scanning for the dead takes milliseconds; only the supervisor does it, by `Bus::clean_dead`.
    config.global.service.cleanup_dead_nodes_on_open = false;
    config.global.node.cleanup_dead_nodes_on_creation = false;
    config.global.node.cleanup_dead_nodes_on_destruction = false;
    Ok(config)
}
