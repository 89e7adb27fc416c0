//! What is in a chunk of a recording, taken out of it without trusting it.

use std::io::Read;

/// No chunk and no record of a recording is longer, bytes: eight times what is written.
pub(crate) const LONGEST: usize = 32 << 20;

/// A record: its kind, and its bytes.
pub(crate) type RawRecord<'a> = (u8, &'a [u8]);

/// A chunk, as it stands in the file.
pub(crate) struct Chunk<'a> {
    /// Of what it holds; 0: none.
    pub checksum: u32,
    pub compression: &'a str,
    pub data: &'a [u8],
}

impl Chunk<'_> {
    /// What it holds, checked.
    ///
    /// # Errors
    /// What is wrong with it, in words.
    pub fn decompress(&self) -> Result<Vec<u8>, String> {
        let Self { checksum, compression, data } = *self;
        let (mut records, most) = (Vec::new(), LONGEST as u64 + 1);
        let read = match compression {
            "" => data.take(most).read_to_end(&mut records),
            "lz4" => lz4::Decoder::new(data).and_then(|decoder| decoder.take(most).read_to_end(&mut records)),
            _ => return Err(format!("a chunk is compressed by \"{compression}\"; expected lz4")),
        };
        read.map_err(|error| format!("a chunk is damaged: {error}"))?;
        if records.len() > LONGEST {
            return Err(format!("a chunk holds more than {LONGEST} bytes"));
        }
        if checksum != 0 && crc32fast::hash(&records) != checksum {
            return Err("a chunk is damaged: its checksum is another one".to_owned());
        }
        Ok(records)
    }
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
