//! The chapter's figures, drawn from runs that are made then and there.
//!
//! A [`Recording`] holds what a run in lockstep showed: input and activity of every layer, what the person did, when
//! which peak stood. A [`Figure`] makes a [`Sheet`] of it, which is written as SVG and as PNG. [`Gallery`] does it all.

mod colours;
mod curves;
mod figure;
mod figure_error;
mod gallery;
mod heat_map;
mod index;
mod interval;
mod layer_page;
mod lettering;
mod page;
mod prediction;
mod recording;
mod scenario;
mod sheet;
mod single_field;
mod surface;
mod table_view;

pub use colours::TELLING;
pub use figure::Figure;
pub use figure_error::FigureError;
pub use gallery::{Gallery, Step};
pub use index::{Done, Entry, Index, Run, Stretch};
pub use interval::Interval;
pub use lettering::Lettering;
pub use recording::{Peak, Quantity, Recording};
pub use scenario::Scenario;
pub use sheet::{Anchor, Mark, Place, Sheet, Text};
pub use surface::Surface;
