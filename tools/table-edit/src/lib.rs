//! A process table with some values changed, in another folder: what studies and tests run sets by that are not as shipped.
//!
//! ```
//! use coact_table_edit::TableEdit;
//!
//! let shipped = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
//! let folder = tempfile::tempdir()?;
//! let table = TableEdit::of(&shipped)?.with("restart", "intensity", 99)?.with_standby(&["fields"])?.write(folder.path())?;
//! assert!(std::fs::read_to_string(table)?.contains("intensity = 99 "));
//! assert!(TableEdit::of(&shipped)?.with("restart", "intensty", 99).is_err(), "no such key");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod table_edit;
mod table_edit_error;

pub use table_edit::TableEdit;
pub use table_edit_error::TableEditError;
