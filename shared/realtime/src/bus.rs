use crate::any_topic::message_type;
use crate::port::{Reader, Writer};
use crate::run_node::RunNode;
use crate::run_view::RunView;
use crate::zero_copy_reader::ZeroCopyReader;
use crate::zero_copy_writer::ZeroCopyWriter;
use crate::{Input, Message, Output, PortError, Refusals};
use coact_messages::{Header, LAYOUT, topic};
use coact_pipeline::Run;
use iceoryx2::service::static_config::message_type_details::TypeDetail;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// How often a replacement looks for its checkpoint. A trade-off: less often would lengthen the recovery by a fraction of
/// a period, more often would take time from the processes that live on.
const CHECKPOINT_POLL: Duration = Duration::from_micros(200);

/// Opens ports on one run's topics: a process's iceoryx2 node, kept apart from other runs by the run's prefix.
#[derive(Debug)]
pub struct Bus {
    node: RunNode,
    generation: u32,
    run: Arc<RunView>,
    refusals: Arc<Refusals>,
}

impl Bus {
    /// Joins `run` as `process`, in its `generation`-th restart.
    ///
    /// # Errors
    /// [`PortError::Join`].
    pub fn open(run: &Run, process: &str, generation: u32) -> Result<Self, PortError> {
        let node = RunNode::open(run, process)?;
        let (run, refusals) = (Arc::new(RunView::new(run)), Arc::default());
        Ok(Self { node, generation, run, refusals })
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
        let process = self.process();
        tracing::warn!("{process} begins anew: its checkpoint of cycle {cycle} is damaged: {flaw}");
        None
    }

    /// Frees what dead processes left in shared memory; returns how many were cleaned up.
    ///
    /// Takes 1 to 9 ms for each: never to be called on a real-time thread.
    pub fn clean_dead(&self) -> u64 {
        self.node.clean_dead()
    }

    /// Name of the process.
    pub fn process(&self) -> &str {
        self.node.process()
    }

    /// Its part in the run's shared memory.
    pub(crate) fn node(&self) -> &RunNode {
        &self.node
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
        Ok(Box::new(ZeroCopyReader::open(&self.node, topic, kind, waits)?))
    }

    fn writer(&self, topic: &str, kind: &TypeDetail) -> Result<Box<dyn Writer>, PortError> {
        Ok(Box::new(ZeroCopyWriter::open(&self.node, topic, kind)?))
    }

    fn may_read(&self, topic: &str) -> Result<(), PortError> {
        match topic::may_read(topic, self.process()) {
            true => Ok(()),
            false => Err(PortError::closed(topic, self.process())),
        }
    }
}
