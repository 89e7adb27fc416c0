use crate::chunk::Chunk;
use mcap::records::op;
use std::collections::BTreeMap;

/// A record of the file, as far as recordings of runs need it. Lengths in it are held against what is there before anything is
/// taken: the library's own parser takes memory for whatever a length says.
pub(crate) enum Record<'a> {
    Schema { id: u16, text: &'a [u8] },
    Channel { id: u16, schema: u16, topic: &'a str, encoding: &'a str },
    Message { channel: u16, data: &'a [u8] },
    Chunk(Chunk<'a>),
    Attachment { name: &'a str, contents: &'a [u8] },
    Metadata { name: &'a str, entries: BTreeMap<String, String> },
    Other,
}

impl<'a> Record<'a> {
    /// A record of this kind; `None` when it is not as long as it says, or holds text that is none.
    pub fn parse(kind: u8, body: &'a [u8]) -> Option<Self> {
        let mut rest = Rest(body);
        match kind {
            op::SCHEMA => schema(&mut rest),
            op::CHANNEL => channel(&mut rest),
            op::MESSAGE => message(&mut rest),
            op::CHUNK => chunk(&mut rest),
            op::ATTACHMENT => attachment(&mut rest),
            op::METADATA => metadata(&mut rest),
            _ => Some(Self::Other),
        }
    }
}

fn schema<'a>(rest: &mut Rest<'a>) -> Option<Record<'a>> {
    let (id, _name, _encoding) = (rest.u16()?, rest.text()?, rest.text()?);
    let length = rest.u32()?;
    Some(Record::Schema { id, text: rest.bytes(length.into())? })
}

fn channel<'a>(rest: &mut Rest<'a>) -> Option<Record<'a>> {
    let (id, schema) = (rest.u16()?, rest.u16()?);
    Some(Record::Channel { id, schema, topic: rest.text()?, encoding: rest.text()? })
}

fn message<'a>(rest: &mut Rest<'a>) -> Option<Record<'a>> {
    let (channel, _sequence, _logged, _published) = (rest.u16()?, rest.u32()?, rest.u64()?, rest.u64()?);
    Some(Record::Message { channel, data: rest.0 })
}

fn chunk<'a>(rest: &mut Rest<'a>) -> Option<Record<'a>> {
    let (_first, _last, _size, checksum) = (rest.u64()?, rest.u64()?, rest.u64()?, rest.u32()?);
    let (compression, length) = (rest.text()?, rest.u64()?);
    Some(Record::Chunk(Chunk { checksum, compression, data: rest.bytes(length)? }))
}

fn attachment<'a>(rest: &mut Rest<'a>) -> Option<Record<'a>> {
    let whole = rest.0;
    let (_logged, _created, name, _media_type) = (rest.u64()?, rest.u64()?, rest.text()?, rest.text()?);
    let length = rest.u64()?;
    let contents = rest.bytes(length)?;
    let summed = &whole[..whole.len() - rest.0.len()];
    let checksum = rest.u32()?;
    (checksum == 0 || checksum == crc32fast::hash(summed)).then_some(Record::Attachment { name, contents })
}

fn metadata<'a>(rest: &mut Rest<'a>) -> Option<Record<'a>> {
    let (name, length) = (rest.text()?, rest.u32()?);
    let mut pairs = Rest(rest.bytes(length.into())?);
    let mut entries = BTreeMap::new();
    while !pairs.0.is_empty() {
        entries.insert(pairs.text()?.to_owned(), pairs.text()?.to_owned());
    }
    Some(Record::Metadata { name, entries })
}

/// What of a record is still to be read.
struct Rest<'a>(&'a [u8]);

impl<'a> Rest<'a> {
    fn bytes(&mut self, length: u64) -> Option<&'a [u8]> {
        let (bytes, rest) = self.0.split_at_checked(usize::try_from(length).ok()?)?;
        self.0 = rest;
        Some(bytes)
    }

    fn number<const SIZE: usize>(&mut self) -> Option<[u8; SIZE]> {
        let (number, rest) = self.0.split_first_chunk()?;
        self.0 = rest;
        Some(*number)
    }

    fn u16(&mut self) -> Option<u16> {
        self.number().map(u16::from_le_bytes)
    }

    fn u32(&mut self) -> Option<u32> {
        self.number().map(u32::from_le_bytes)
    }

    fn u64(&mut self) -> Option<u64> {
        self.number().map(u64::from_le_bytes)
    }

    fn text(&mut self) -> Option<&'a str> {
        let length = self.u32()?;
        std::str::from_utf8(self.bytes(length.into())?).ok()
    }
}
