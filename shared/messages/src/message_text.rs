//! How a sentence lies in a message.

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
