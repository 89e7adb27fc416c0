//! Messages and topics.

mod drawing;
mod plausibility;
mod processes;
