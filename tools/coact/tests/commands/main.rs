//! `coact` as a program, and the client in Python beside it.

mod program;
mod shipped_recordings;
mod snapshots;
mod watch_layer;
