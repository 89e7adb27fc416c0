//! Fields, against the figures of the chapter and in other units.

mod chapter_figures;
mod metric_fields;
