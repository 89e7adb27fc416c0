//! A run in one file, `run.mcap`: all that its processes said, with the bits that it had, and what it was made of.
//!
//! The format is [MCAP](https://mcap.dev): chunks of messages, each with its time, compressed. Our own messages are in it as they
//! are in memory; their schema is their [`Description`](coact_messages::Description), so that other programs can take them
//! apart. Beside them stand messages in JSON that Foxglove knows by name ([`JsonSchema`]).
//!
//! ```
//! use coact_messages::{Percept, LAYOUT};
//! use coact_run_recording::{Origin, Recorded, Recording, RecordingWriter};
//!
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("run.mcap");
//! let mut writer = RecordingWriter::create(&path, &Origin::default())?;
//! let mut percept: Box<Percept> = bytemuck::zeroed_box();
//! (percept.header.layout, percept.header.cycle, percept.act[3]) = (LAYOUT, 17, 0.5);
//! writer.message(&Recorded::Percept(percept))?;
//! writer.finish(&[("coact/percept".to_owned(), 2)].into())?;
//!
//! let mut recording = Recording::open(&path)?;
//! let Some(Recorded::Percept(percept)) = recording.next_message()? else { panic!("no percept") };
//! assert_eq!((percept.header.cycle, percept.act[3]), (17, 0.5));
//! assert!(recording.next_message()?.is_none() && !recording.is_truncated());
//! assert_eq!(recording.lost().and_then(|lost| lost.get("coact/percept")), Some(&2));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod chunk;
mod json_schema;
mod message_kind;
mod origin;
mod record;
mod recorded;
mod recording;
mod recording_error;
mod recording_writer;

pub use json_schema::JsonSchema;
pub use origin::Origin;
pub use recorded::Recorded;
pub use recording::Recording;
pub use recording_error::RecordingError;
pub use recording_writer::RecordingWriter;
