use crate::any_topic::{AnyTopic, Bytes, NoHeader, header_type};
use crate::{PortError, places};
use coact_messages::topic;
use coact_pipeline::Run;
use iceoryx2::prelude::*;
use iceoryx2::service::port_factory::event;
use iceoryx2::service::static_config::message_type_details::TypeDetail;
use std::time::Duration;

/// Writers of one topic: the living one and its standby, and dead ones until the supervisor has cleaned up after them. It does
/// so before each restart but the first, so there are two dead ones of each at most; one more is reserve.
pub(crate) const MAX_WRITERS: usize = 7;
/// Processes that may have one topic open: the set (9 with the supervisor), the reservations for their replacements (8),
/// the dead until they are cleaned up after, and operators' tools. Chosen by hand; more would only cost shared memory.
const MAX_NODES: usize = 32;

/// So long it is waited for what another process is making: a connection, some microseconds of work. By default it is a second,
/// and whoever was killed while it joined a topic kept every stage that writes or reads it from its cycles for as long. Chosen by
/// hand: far above what a joining process that is held up needs, and short beside the watchdog's limits.
const HALF_MADE_FOR: Duration = Duration::from_millis(20);

/// A process's iceoryx2 node in one run: opens the run's topics and events.
#[derive(Debug)]
pub(crate) struct RunNode {
    node: Box<dyn Joined>,
    process: String,
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

impl RunNode {
    /// Joins `run` as `process`.
    ///
    /// # Errors
    /// [`PortError::Join`].
    pub(crate) fn open(run: &Run, process: &str) -> Result<Self, PortError> {
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
        Ok(Self { node: Box::new(node), process: process.to_owned() })
    }

    /// Name of the process.
    pub(crate) fn process(&self) -> &str {
        &self.process
    }

    /// Frees what dead processes left in shared memory; returns how many were cleaned up.
    pub(crate) fn clean_dead(&self) -> u64 {
        self.node.node().try_cleanup_dead_nodes().cleanups
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
    config.global.creation_timeout = HALF_MADE_FOR;
    // Scanning for the dead takes milliseconds; only the supervisor does it, by `Bus::clean_dead`.
    config.global.service.cleanup_dead_nodes_on_open = false;
    config.global.node.cleanup_dead_nodes_on_creation = false;
    config.global.node.cleanup_dead_nodes_on_destruction = false;
    Ok(config)
}
