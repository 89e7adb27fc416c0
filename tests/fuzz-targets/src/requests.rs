//! What is asked of a run: on its socket, on the command line, on a page.

use crate::configuration::{taken, task};
use coact_person::HandModel;
use coact_supervisor::{Injection, read_request};
use coact_world::Partner;

pub(crate) fn control_request(bytes: &[u8]) -> bool {
    std::str::from_utf8(bytes).is_ok_and(|line| taken(read_request(line)).is_some())
}

pub(crate) fn injection(bytes: &[u8]) -> bool {
    std::str::from_utf8(bytes).is_ok_and(|text| taken(text.parse::<Injection>()).is_some())
}

/// A line of `coact hand`.
pub(crate) fn hand_line(bytes: &[u8]) -> bool {
    let Ok(line) = std::str::from_utf8(bytes) else { return false };
    taken(coact::hand::keypoints(line, &HandModel::new(&task().scene))).is_some()
}

/// What a page of the console sends.
pub(crate) fn page_request(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    taken(coact_console::Request::read(text)).is_some()
}

/// Only the words: which files are read, this target must not choose.
pub(crate) fn partner(bytes: &[u8]) -> bool {
    let Ok(text) = std::str::from_utf8(bytes) else { return false };
    taken(Partner::load(&format!("random:{text}"), task(), 1)).is_some()
}
