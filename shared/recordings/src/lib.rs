//! Recordings of people's reaches: a folder of CSV files, one for each person, compressed with gzip or not.
//!
//! ```
//! use coact_recordings::{Order, read_folder};
//! use std::path::Path;
//!
//! # let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../data/reaches"));
//! let reaches = read_folder(folder)?;
//! let people = Order::Trial { seed: 1 }.people(&reaches);
//! for person in &people {
//!     let times: f64 = person.iter().map(|reach| reach.movement_time).sum();
//!     let mean = times / person.len() as f64;
//!     println!("participant {}: {} reaches of {mean:.2} s", person[0].participant, person.len());
//! }
//! assert_eq!((people.len(), reaches.len()), (6, 537));
//! # Ok::<(), coact_recordings::RecordingError>(())
//! ```
//!
//! Columns: `participant`, `size` (S, M, L), `trial`, `t_rel_onset_s` (0 = reach onset), `mt_s` (onset to grasp end),
//! `rtg` (1 within the reach), then `x`, `y` (pixels) and `p` (the detector's confidence, 0 = joint lost) of each of
//! [`JOINTS`]. Rows of one reach stand together, in the order of time. Size, `mt_s` and `rtg` are labels: truth.
//!
//! Beside them, whole arms by motion capture: [`ArmRecording`], one arm of a file; [`arm_files`] finds those of a folder.
//! [`BodyRecording`] has both hands against the body. What was made of them: [`read_ways`] reads the ways of hands that
//! carried, gave and withdrew.
//!
//! A file is read whole or refused: every row ends up in a [`Reach`], or an error names file and line.

mod arm_files;
mod arm_recording;
mod body_recording;
mod error;
mod order;
mod place_columns;
mod reach;
mod read;
mod way;
mod way_kind;
mod ways_file;

pub use arm_files::arm_files;
pub use arm_recording::{ArmRecording, ArmSample};
pub use body_recording::{BodyFrame, BodyRecording};
pub use coact_messages::ArmSide;
pub use error::RecordingError;
pub use order::Order;
pub use reach::{Frame, ImagePoint, Reach, Size, forearm};
pub use read::{JOINTS, read_file, read_folder};
pub use way::Way;
pub use way_kind::WayKind;
pub use ways_file::{read_ways, ways_text};
