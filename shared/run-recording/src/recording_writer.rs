use crate::message_kind::MessageKind;
use crate::{JsonSchema, Origin, Recorded, RecordingError};
use coact_messages::LAYOUT;
use mcap::records::{MessageHeader, Metadata};
use mcap::{Attachment, Compression, McapResult, WriteOptions, Writer};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};

/// Encoding of messages that are in the file as they are in memory, and of their descriptions.
pub(crate) const ENCODING: &str = "coact";
/// A chunk is closed when it holds so many bytes: some tenths of a second. A trade-off: larger ones would take more memory to read.
const CHUNK: u64 = 4 << 20;

/// Writes a recording. What was written before [`RecordingWriter::flush`] is in the file whatever becomes of this program.
pub struct RecordingWriter {
    path: PathBuf,
    writer: Writer<File>,
    channels: BTreeMap<String, u16>,
    clock_offset_ns: u64,
}

impl RecordingWriter {
    /// Name of the record that tells how a recording ended.
    pub(crate) const END: &str = "coact-end";

    /// A new file; one that is there already is not touched.
    ///
    /// # Errors
    /// [`RecordingError`]: it exists, or cannot be written.
    pub fn create(path: &Path, origin: &Origin) -> Result<Self, RecordingError> {
        let file = File::options().read(true).write(true).create_new(true).open(path);
        let refused = |cause| RecordingError::Write { path: path.to_owned(), cause };
        let file = file.map_err(|cause| refused(cause.into()))?;
        let writer = begin(file, origin).map_err(refused)?;
        let (channels, clock_offset_ns) = (BTreeMap::new(), origin.clock_offset_ns);
        Ok(Self { path: path.to_owned(), writer, channels, clock_offset_ns })
    }

    /// Adds a message of the run, at the time of its publication.
    ///
    /// # Errors
    /// [`RecordingError::Write`].
    pub fn message(&mut self, message: &Recorded) -> Result<(), RecordingError> {
        let (topic, header) = (message.topic(), message.header());
        let channel = match self.channels.get(&topic) {
            Some(channel) => Ok(*channel),
            None => self.message_channel(&topic),
        };
        let at_ns = header.published_ns;
        let written =
            channel.and_then(|channel| self.write(channel, header.sequence as u32, at_ns, message.bytes()));
        self.refusal(written)
    }

    /// Adds a message in JSON that other programs understand by its schema; `at_ns` is of `CLOCK_MONOTONIC`.
    ///
    /// # Errors
    /// [`RecordingError::Write`].
    pub fn json(
        &mut self,
        topic: &str,
        schema: &JsonSchema,
        at_ns: u64,
        message: &serde_json::Value,
    ) -> Result<(), RecordingError> {
        let channel = match self.channels.get(topic) {
            Some(channel) => Ok(*channel),
            None => self.json_channel(topic, schema),
        };
        let text = message.to_string();
        let written = channel.and_then(|channel| self.write(channel, 0, at_ns, text.as_bytes()));
        self.refusal(written)
    }

    /// What the file's times are more than those of `CLOCK_MONOTONIC`, ns.
    pub fn clock_offset_ns(&self) -> u64 {
        self.clock_offset_ns
    }

    /// Hands all that was written to the system: it outlives this program.
    ///
    /// # Errors
    /// [`RecordingError::Write`].
    pub fn flush(&mut self) -> Result<(), RecordingError> {
        let flushed = self.writer.flush();
        self.refusal(flushed)
    }

    /// Writes the end of the file: how many messages of each topic were lost, and the index.
    ///
    /// # Errors
    /// [`RecordingError::Write`].
    pub fn finish(mut self, lost: &BTreeMap<String, u64>) -> Result<(), RecordingError> {
        let metadata = lost.iter().map(|(topic, count)| (topic.clone(), count.to_string())).collect();
        let end = Metadata { name: Self::END.to_owned(), metadata };
        let finished = self.writer.write_metadata(&end).and_then(|()| self.writer.finish().map(drop));
        self.refusal(finished)
    }

    fn message_channel(&mut self, topic: &str) -> McapResult<u16> {
        let kind = MessageKind::of(topic);
        let kind = kind.ok_or_else(|| std::io::Error::other(format!("{topic} is not recorded")))?;
        let (name, layout) = (format!("coact.{}", kind.name), kind.description.to_string());
        let schema = self.writer.add_schema(&name, ENCODING, layout.as_bytes())?;
        let metadata = [("layout", LAYOUT.to_string()), ("size", kind.description.size().to_string())];
        let metadata = metadata.into_iter().map(|(key, value)| (key.to_owned(), value)).collect();
        let channel = self.writer.add_channel(schema, topic, ENCODING, &metadata)?;
        self.channels.insert(topic.to_owned(), channel);
        Ok(channel)
    }

    fn json_channel(&mut self, topic: &str, schema: &JsonSchema) -> McapResult<u16> {
        let schema = self.writer.add_schema(schema.name, "jsonschema", schema.text.as_bytes())?;
        let channel = self.writer.add_channel(schema, topic, "json", &BTreeMap::new())?;
        self.channels.insert(topic.to_owned(), channel);
        Ok(channel)
    }

    fn write(&mut self, channel_id: u16, sequence: u32, at_ns: u64, data: &[u8]) -> McapResult<()> {
        let log_time = at_ns + self.clock_offset_ns;
        let header = MessageHeader { channel_id, sequence, log_time, publish_time: log_time };
        self.writer.write_to_known_channel(&header, data)
    }

    fn refusal<T>(&self, outcome: McapResult<T>) -> Result<T, RecordingError> {
        outcome.map_err(|cause| RecordingError::Write { path: self.path.clone(), cause })
    }
}

/// The beginning of the file: what the run is made of.
fn begin(file: File, origin: &Origin) -> McapResult<Writer<File>> {
    // Chunks are written as a whole, and not begun in the file: what a killed program leaves ends with a whole one.
    let options =
        WriteOptions::new().compression(Some(Compression::Lz4)).chunk_size(Some(CHUNK)).disable_seeking(true);
    let mut writer = options.profile(ENCODING).create(file)?;
    let metadata = origin.to_metadata().map_err(std::io::Error::from)?;
    writer.write_metadata(&Metadata { name: Origin::NAME.to_owned(), metadata })?;
    for (path, contents) in origin.files.iter() {
        writer.attach(&Attachment {
            log_time: origin.start_ns + origin.clock_offset_ns,
            create_time: 0,
            name: path.to_string_lossy().into_owned(),
            media_type: "text/plain".to_owned(),
            data: Cow::Borrowed(contents),
        })?;
    }
    writer.flush()?;
    Ok(writer)
}
