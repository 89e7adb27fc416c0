//! The recorder: all that a run's processes say, in one file that replays and that Foxglove opens.
//!
//! It follows the run at its own pace, in the ordinary class, and the task never needs it. One thread listens: it looks every
//! 2 ms, long before the buffers of the topics are full, and puts what has come into a queue. Another one writes, and may wait for
//! the disk. What was lost all the same is counted by the messages' sequences ([`Gaps`]), and said in the file.

mod foxglove;
mod gaps;
mod queue;
mod recorder;
mod recorder_settings;
mod recording_files;
mod sources;
mod storage;
mod topics;

pub use gaps::Gaps;
pub use recorder::Recorder;
pub use recorder_settings::{RecorderSettings, SettingsError};
pub use recording_files::{recording_file, remove_recordings};
pub use sources::Sources;
pub use topics::Topics;
