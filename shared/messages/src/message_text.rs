//! How a sentence lies in a message.

use crate::{Flaw, plausible};

/// Writes `sentence` into `text`, cut off where it does not fit, and returns how many bytes are valid.
pub(crate) fn write(sentence: &str, text: &mut [u8; 256]) -> u64 {
    let sentence = &sentence[..sentence.floor_char_boundary(text.len())];
    text.fill(0);
    text[..sentence.len()].copy_from_slice(sentence.as_bytes());
    sentence.len() as u64
}

/// The sentence; empty for bytes that are no text.
pub(crate) fn read(text: &[u8; 256], length: u64) -> &str {
    let length = (length as usize).min(text.len());
    std::str::from_utf8(&text[..length]).unwrap_or_default()
}

/// Refuses bytes that are no text, and more of them than there are.
pub(crate) fn check(field: &'static str, text: &[u8; 256], length: u64) -> Result<(), Flaw> {
    let valid = usize::try_from(length).ok().and_then(|length| text.get(..length));
    let is_text = valid.is_some_and(|bytes| std::str::from_utf8(bytes).is_ok());
    plausible::ensure(is_text, field, "a sentence of at most 256 bytes of UTF-8")
}
