use axum::body::Bytes;

/// All that a page draws of one instant, as it is sent: little endian, 16 bytes of head, then 32-bit floating-point numbers.
///
/// Head: 1 for a live picture, 2 for one of the past (u32); how many numbers at the end are the activity of single sites (u32); the
/// cycle (f64). [`PictureMaker`](crate::PictureMaker) says what the numbers are; where one is not known it is none (NaN).
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// The cycle that it shows.
    pub cycle: u64,
    /// What is sent: shared by all who send it.
    pub bytes: Bytes,
}

/// What the head begins with.
const LIVE: u32 = 1;
const PAST: u32 = 2;
/// Bytes of the head.
const HEAD: usize = 16;

impl Picture {
    /// A live picture of these numbers, the activity of single sites behind them.
    pub fn new(cycle: u64, numbers: &[f32], sites: &[f32]) -> Self {
        let mut bytes = head(LIVE, sites.len(), cycle);
        bytes.extend(numbers.iter().chain(sites).flat_map(|number| number.to_le_bytes()));
        Self { cycle, bytes: bytes.into() }
    }

    /// The same as one of the past, without the activity of single sites.
    #[must_use]
    pub fn of_the_past(&self) -> Self {
        let count = u32::from_le_bytes([self.bytes[4], self.bytes[5], self.bytes[6], self.bytes[7]]) as usize;
        let mut bytes = head(PAST, 0, self.cycle);
        bytes.extend(&self.bytes[HEAD..self.bytes.len() - count * size_of::<f32>()]);
        Self { cycle: self.cycle, bytes: bytes.into() }
    }
}

fn head(when: u32, sites: usize, cycle: u64) -> Vec<u8> {
    let mut head = Vec::with_capacity(HEAD);
    head.extend(when.to_le_bytes());
    head.extend((sites as u32).to_le_bytes());
    head.extend((cycle as f64).to_le_bytes());
    head
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_of_the_past_is_a_live_one_without_sites() {
        let live = Picture::new(12_345, &[1.5, f32::NAN, -2.0], &[9.0; 7]);
        assert_eq!(live.bytes.len(), 16 + 4 * 10);
        let past = live.of_the_past();
        assert_eq!(past.bytes[..8], [2, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(past.bytes[8..16], 12_345_f64.to_le_bytes());
        assert_eq!(past.bytes[16..], live.bytes[16..28]);
        assert_eq!(past.of_the_past(), past);
    }
}
