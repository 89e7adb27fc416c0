use crate::chunk::{LONGEST, split_record};
use crate::message_kind::MessageKind;
use crate::record::Record;
use crate::recording_writer::{ENCODING, RecordingWriter};
use crate::{Origin, Recorded, RecordingError};
use coact_input_file::Files;
use mcap::McapError;
use mcap::sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

/// All files of a run together are no longer, bytes.
const LONGEST_FILES: usize = 64 << 20;
/// Topics and processes of a run are far fewer.
const MOST_CHANNELS: usize = 1000;

/// A recording that is read from its beginning to its end, a chunk at a time.
///
/// Nothing in it is trusted: sizes are bounded, and what is damaged is refused. A file that ends in the middle, because its
/// recorder was killed, is read up to there.
pub struct Recording {
    path: PathBuf,
    file: File,
    reader: LinearReader,
    origin: Origin,
    /// Records of the present chunk, and how much of them was read.
    chunk: Vec<u8>,
    read: usize,
    schemas: BTreeMap<u16, Vec<u8>>,
    /// Topics of our own messages.
    channels: BTreeMap<u16, String>,
    end: Option<BTreeMap<String, u64>>,
    is_truncated: bool,
}

/// What came next in the file.
enum Next {
    Record(u8, Vec<u8>),
    /// Nothing more, or not the rest of the record that has begun.
    End,
}

impl Recording {
    /// Opens a recording, and reads what it was made of.
    ///
    /// # Errors
    /// [`RecordingError`]: there is no such file, or it is none, or does not say what it was made of.
    pub fn open(path: &Path) -> Result<Self, RecordingError> {
        let failed = |cause| RecordingError::File { path: path.to_owned(), cause };
        let file = coact_input_file::open(path).map_err(failed)?;
        let options = LinearReaderOptions::default().with_emit_chunks(true).with_record_length_limit(LONGEST);
        let mut recording = Self {
            path: path.to_owned(),
            file,
            reader: LinearReader::new_with_options(options),
            origin: Origin::default(),
            chunk: Vec::new(),
            read: 0,
            schemas: BTreeMap::new(),
            channels: BTreeMap::new(),
            end: None,
            is_truncated: false,
        };
        recording.begin()?;
        Ok(recording)
    }

    /// What it was made of.
    pub fn origin(&self) -> &Origin {
        &self.origin
    }

    /// True once it turned out that the file ends in the middle: its recorder was killed.
    pub fn is_truncated(&self) -> bool {
        self.is_truncated
    }

    /// How many messages of each topic the recorder has lost; known once the end of a whole file was read.
    pub fn lost(&self) -> Option<&BTreeMap<String, u64>> {
        self.end.as_ref()
    }

    /// The next message, in the order in which they were recorded; `None` at the end.
    ///
    /// # Errors
    /// [`RecordingError`]: the file is damaged, or its messages have another layout.
    pub fn next_message(&mut self) -> Result<Option<Recorded>, RecordingError> {
        loop {
            if self.read < self.chunk.len() {
                if let Some(message) = self.in_chunk()? {
                    return Ok(Some(message));
                }
                continue;
            }
            match self.next_record()? {
                Next::Record(kind, body) => self.outside_chunk(kind, &body)?,
                Next::End => return Ok(None),
            }
        }
    }

    /// Reads up to the first chunk.
    fn begin(&mut self) -> Result<(), RecordingError> {
        let mut has_settings = false;
        while let Next::Record(kind, body) = self.next_record()? {
            match self.parse(kind, &body)? {
                Record::Metadata { name: Origin::NAME, entries } => {
                    let origin = Origin::from_metadata(&entries);
                    self.origin =
                        origin.map_err(|key| self.malformed(format!("says no {key} of its run")))?;
                    has_settings = true;
                }
                Record::Attachment { name, contents } => self.attach(name, contents)?,
                Record::Chunk(chunk) => {
                    self.chunk = chunk.decompress().map_err(|problem| self.malformed(problem))?;
                    break;
                }
                _ => {}
            }
        }
        match has_settings {
            true => Ok(()),
            false => Err(self.malformed("does not say what run it is of")),
        }
    }

    fn attach(&mut self, name: &str, contents: &[u8]) -> Result<(), RecordingError> {
        let files: &mut Files = &mut self.origin.files;
        let total: usize = files.iter().map(|(_, contents)| contents.len()).sum();
        if total + contents.len() > LONGEST_FILES {
            return Err(self.malformed(format!("its files are longer than {LONGEST_FILES} bytes")));
        }
        files.insert(Path::new(name), contents.to_vec());
        Ok(())
    }

    fn outside_chunk(&mut self, kind: u8, body: &[u8]) -> Result<(), RecordingError> {
        match self.parse(kind, body)? {
            Record::Chunk(chunk) => {
                self.chunk = chunk.decompress().map_err(|problem| self.malformed(problem))?;
                self.read = 0;
            }
            Record::Metadata { name: RecordingWriter::END, entries } => {
                let count = |(topic, count): (String, String)| Some((topic, count.parse().ok()?));
                self.end = entries.into_iter().map(count).collect();
            }
            _ => {}
        }
        Ok(())
    }

    /// The next record of the chunk, if it is one of our messages.
    fn in_chunk(&mut self) -> Result<Option<Recorded>, RecordingError> {
        let split = split_record(&self.chunk[self.read..]);
        let ((kind, body), rest) = split.map_err(|problem| self.malformed(problem))?;
        let left = rest.len();
        let record = self.parse(kind, body)?;
        let mut message = None;
        match record {
            Record::Schema { id, text } if self.schemas.len() < MOST_CHANNELS => {
                self.schemas.entry(id).or_insert_with(|| text.to_vec());
            }
            Record::Channel { id, schema, topic, encoding: ENCODING } if self.is_new_channel(id) => {
                self.expect_layout(topic, schema)?;
                self.channels.insert(id, topic.to_owned());
            }
            Record::Message { channel, data } => {
                if let Some(topic) = self.channels.get(&channel) {
                    let read = Recorded::read(topic, data);
                    let wrong = || self.malformed(format!("a message of {topic} has {} bytes", data.len()));
                    message = Some(read.ok_or_else(wrong)?);
                }
            }
            _ => {}
        }
        self.read = self.chunk.len() - left;
        Ok(message)
    }

    /// Whether a channel is to be looked at: a file may tell of each several times, but of no more than a run can have.
    fn is_new_channel(&self, id: u16) -> bool {
        !self.channels.contains_key(&id) && self.channels.len() < MOST_CHANNELS
    }

    /// Messages are taken as they are: only those that lie in memory as they do here.
    fn expect_layout(&self, topic: &str, schema: u16) -> Result<(), RecordingError> {
        let Some(kind) = MessageKind::of(topic) else {
            return Err(self.malformed(format!("holds a topic that no run has: {topic}")));
        };
        let expected = kind.description.to_string();
        let found = self.schemas.get(&schema).map_or("", |text| std::str::from_utf8(text).unwrap_or(""));
        if found == expected {
            return Ok(());
        }
        // The descriptions are long: what tells them apart begins at the first difference.
        let same = found.bytes().zip(expected.bytes()).take_while(|(one, other)| one == other).count();
        let part = |text: &str| text.get(same.saturating_sub(20)..).unwrap_or("").chars().take(60).collect();
        let (found, expected) = (part(found), part(&expected));
        Err(RecordingError::Layout {
            path: self.path.clone(),
            message: kind.name.to_owned(),
            found,
            expected,
        })
    }

    fn next_record(&mut self) -> Result<Next, RecordingError> {
        let Self { path, file, reader, is_truncated, .. } = self;
        let malformed = |problem| RecordingError::Malformed { path: path.clone(), problem };
        if *is_truncated {
            return Ok(Next::End);
        }
        while let Some(event) = reader.next_event() {
            match event {
                Ok(LinearReadEvent::ReadRequest(wanted)) => {
                    let into = reader.insert(wanted);
                    let read = file.read(into);
                    let read = read.map_err(|cause| RecordingError::File { path: path.clone(), cause })?;
                    reader.notify_read(read);
                }
                Ok(LinearReadEvent::Record { opcode, data }) => {
                    return Ok(Next::Record(opcode, data.to_vec()));
                }
                Err(McapError::UnexpectedEof) => {
                    *is_truncated = true;
                    return Ok(Next::End);
                }
                Err(McapError::BadMagic) => return Err(malformed("is no MCAP file".to_owned())),
                Err(error) => return Err(malformed(error.to_string())),
            }
        }
        Ok(Next::End)
    }

    fn parse<'a>(&self, kind: u8, body: &'a [u8]) -> Result<Record<'a>, RecordingError> {
        Record::parse(kind, body).ok_or_else(|| self.malformed(format!("a record of kind {kind} is damaged")))
    }

    fn malformed(&self, problem: impl Into<String>) -> RecordingError {
        RecordingError::Malformed { path: self.path.clone(), problem: problem.into() }
    }
}
