//! What is in a chunk of a recording, taken out of it without trusting it.

use mcap::records::ChunkHeader;
use std::io::Read;

/// No chunk and no record of a recording is longer, bytes: eight times what is written.
pub(crate) const LONGEST: usize = 32 << 20;

/// A record: its kind, and its bytes.
pub(crate) type RawRecord<'a> = (u8, &'a [u8]);

/// Decompresses a chunk, and checks it.
///
/// # Errors
/// What is wrong with it, in words.
pub(crate) fn decompress(header: &ChunkHeader, data: &[u8]) -> Result<Vec<u8>, String> {
    let compression = header.compression.as_str();
    let mut records = Vec::new();
    let read = match compression {
        "" => data.take(LONGEST as u64 + 1).read_to_end(&mut records),
        "lz4" => lz4::Decoder::new(data)
            .and_then(|decoder| decoder.take(LONGEST as u64 + 1).read_to_end(&mut records)),
        _ => return Err(format!("a chunk is compressed by \"{compression}\"; expected lz4")),
    };
    read.map_err(|error| format!("a chunk is damaged: {error}"))?;
    if records.len() > LONGEST {
        return Err(format!("a chunk holds more than {LONGEST} bytes"));
    }
    if header.uncompressed_crc != 0 && crc32fast::hash(&records) != header.uncompressed_crc {
        return Err("a chunk is damaged: its checksum is another one".to_owned());
    }
    Ok(records)
}

/// Takes the first record off.
///
/// # Errors
/// It ends in the middle.
pub(crate) fn split_record(bytes: &[u8]) -> Result<(RawRecord<'_>, &[u8]), String> {
    let split = || {
        let (kind, rest) = bytes.split_first()?;
        let (length, rest) = rest.split_first_chunk::<8>()?;
        let (body, rest) = rest.split_at_checked(usize::try_from(u64::from_le_bytes(*length)).ok()?)?;
        Some(((*kind, body), rest))
    };
    split().ok_or_else(|| "a chunk ends in the middle of a record".to_owned())
}
