//! Plots of a report, as SVG: one percentile curve for each histogram, and the timeline of anticipation.

mod curve;
mod gantt;
mod timeline;

pub use curve::percentile_curve;
pub use gantt::gantt;
pub use timeline::anticipation_timeline;

/// A picture could not be drawn or written.
#[derive(Debug, thiserror::Error)]
#[error("{path}: {cause}")]
pub struct PlotError {
    /// Of the picture.
    pub path: std::path::PathBuf,
    /// What the drawing library or the system said.
    pub cause: String,
}

impl PlotError {
    /// Of the picture at `path`; `cause` is what the drawing library or the system said.
    pub fn new(path: &std::path::Path, cause: impl std::fmt::Display) -> Self {
        Self { path: path.to_owned(), cause: cause.to_string() }
    }
}
