//! Pictures of arm, person and table: a look at them, and a run's snapshots on one sheet.

mod contact_sheet;
mod face;
mod person;
mod view;

pub use contact_sheet::{ContactSheet, ContactSheetError};
pub use view::{ARM, HAND, Stroke, THINGS, View, paint};
