//! Bytes as changes of a good message, so that few of them reach any field of a message of a quarter of a megabyte.

use bytemuck::Pod;

/// A place (4 bytes, in steps of 4 bytes, counted round and round) and what is written there (8 bytes).
const CHANGE: usize = 12;

/// Which of `count` good messages the bytes change: the first byte says so.
pub(crate) fn which(bytes: &[u8], count: usize) -> usize {
    usize::from(bytes.first().copied().unwrap_or_default()) % count
}

/// The message with the changes that the bytes behind the first one say.
pub(crate) fn patched<T: Pod>(message: &T, bytes: &[u8]) -> Box<T> {
    let mut patched: Box<T> = bytemuck::zeroed_box();
    *patched = *message;
    apply(bytemuck::bytes_of_mut(&mut *patched), bytes);
    patched
}

/// Writes the changes over bytes in their place.
pub(crate) fn apply(over: &mut [u8], bytes: &[u8]) {
    let (changes, _) = bytes.get(1..).unwrap_or_default().as_chunks::<CHANGE>();
    for change in changes {
        let place = u32::from_le_bytes([change[0], change[1], change[2], change[3]]) as usize;
        let at = 4 * (place % (over.len() / 4).max(1));
        let end = over.len().min(at + 8);
        over[at..end].copy_from_slice(&change[4..4 + end - at]);
    }
}
