//! Pictures of arm, person and table, and a run's snapshots on one sheet.

mod contact_sheet;
mod face;
mod limb_capsules;
mod view;

pub use contact_sheet::{ContactSheet, ContactSheetError};
pub use view::{ARM, HAND, Silhouette, THINGS, View, paint};
