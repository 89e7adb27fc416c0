//! The chapter's figures, drawn from runs that are made on the spot.
//!
//! A [`RunTrace`] has what happened in a run in lockstep: input and activity of every layer, what the person did, when
//! which peak stood. A [`Figure`] makes a [`Sheet`](coact_drawing::Sheet) of it, which is written as SVG and as PNG.
//! [`Gallery`] does it all.

mod field_curves;
mod figure;
mod figure_error;
mod gallery;
mod heat_map;
mod index;
mod interval;
mod interval_tracker;
mod layer_page;
mod line_style;
mod page;
mod prediction;
mod run_trace;
mod scenario;
mod single_field;
mod surface;
mod table_view;

pub use figure::Figure;
pub use figure_error::FigureError;
pub use gallery::{Gallery, Step};
pub use index::{FigureEntry, Index, IntervalEntry, PeakEntry, RunEntry};
pub use interval::Interval;
pub use run_trace::{Peak, Quantity, RunTrace};
pub use scenario::Scenario;
pub use surface::Surface;
