//! The studies as programs: what they print, and what they refuse.

mod closed_pipe;
mod figures;
mod program;
mod separation;
mod shipped_recordings;
