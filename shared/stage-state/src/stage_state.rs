use crate::{Implausible, StateError};
use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};

/// A stage's state: of fixed layout, without gaps, made of 8-byte words.
pub trait StageState: CheckedBitPattern + NoUninit + Zeroable {
    /// Name of the stage.
    const STAGE: &'static str;

    /// Number of the layout: to be counted up whenever a field comes, goes, moves or changes its meaning.
    const LAYOUT: u32;

    /// Refuses fields that are not what they can be: numbers that are not finite, durations below zero.
    ///
    /// # Errors
    /// The first such field.
    fn check(&self) -> Result<(), Implausible>;

    /// Writes the mark, the state and its checksum into the words of a message; the words behind them become zero.
    ///
    /// That they have room for it is checked when this is compiled.
    fn store<const N: usize>(&self, words: &mut [f64; N]) {
        let end = const { end::<Self>(N) };
        let words: &mut [u64] = bytemuck::cast_slice_mut(words);
        words[0] = const { mark::<Self>() };
        bytemuck::cast_slice_mut(&mut words[1..end]).copy_from_slice(bytemuck::bytes_of(self));
        words[end] = checksum(&words[..end]);
        words[end + 1..].fill(0);
    }

    /// Makes the checksum that of the words as they are: for tests, of what is refused behind it.
    fn seal<const N: usize>(words: &mut [f64; N]) {
        let end = const { end::<Self>(N) };
        let words: &mut [u64] = bytemuck::cast_slice_mut(words);
        words[end] = checksum(&words[..end]);
    }

    /// Reads the state out of the words of a message.
    ///
    /// # Errors
    /// [`StateError::Mark`] when it is not this state that they hold, [`StateError::NoValue`] when a word is no value of
    /// its enum or flag, [`StateError::Implausible`] when [`StageState::check`] refuses a field, [`StateError::Checksum`] when
    /// words were changed to others that could be.
    fn load<const N: usize>(words: &[f64; N]) -> Result<Self, StateError> {
        let end = const { end::<Self>(N) };
        let (stage, layout) = (Self::STAGE, Self::LAYOUT);
        let words: &[u64] = bytemuck::cast_slice(words);
        let (found, expected) = (words[0], const { mark::<Self>() });
        if found != expected {
            return Err(StateError::Mark { stage, layout, found, expected });
        }
        let Some(state) = read::<Self>(&words[1..end]) else {
            let word = 1 + first_without_value::<Self, N>(&words[1..end]);
            return Err(StateError::NoValue { stage, word, found: words[word] });
        };
        state.check().map_err(|reason| StateError::Implausible { stage, reason })?;
        if words[end] != checksum(&words[..end]) {
            return Err(StateError::Checksum { stage });
        }
        Ok(state)
    }
}

/// Makes the checksum at `end`, behind a state of any stage, that of the words before it: as [`StageState::seal`], for tests of
/// what is refused behind the checksum.
///
/// # Panics
/// There is no such word.
pub fn seal_words(words: &mut [f64], end: usize) {
    let words: &mut [u64] = bytemuck::cast_slice_mut(words);
    words[end] = checksum(&words[..end]);
}

/// Refuses `numbers` when one of them is not finite.
///
/// # Errors
/// `field`, which holds them.
pub fn finite(field: &'static str, numbers: &[f64]) -> Result<(), Implausible> {
    ensure(numbers.iter().all(|number| number.is_finite()), field, "finite numbers")
}

/// Refuses `numbers` when one of them is farther from zero than `most`, or is none.
///
/// # Errors
/// `field`, which holds them.
pub fn bounded(field: &'static str, numbers: &[f64], most: f64) -> Result<(), Implausible> {
    ensure(numbers.iter().all(|number| number.abs() <= most), field, "numbers of a size that it can have")
}

/// Refuses `field` when `condition` does not hold.
///
/// # Errors
/// The field, and what was expected of it.
pub fn ensure(condition: bool, field: &'static str, expected: &'static str) -> Result<(), Implausible> {
    if condition { Ok(()) } else { Err(Implausible { field, expected }) }
}

/// Offset basis of FNV-1a with 64 bits.
const BASIS: u64 = 0xcbf2_9ce4_8422_2325;

/// Where the state ends among `count` words that begin with the mark.
const fn end<S>(count: usize) -> usize {
    assert!(size_of::<S>().is_multiple_of(8), "a state consists of 8-byte words");
    let end = 1 + size_of::<S>() / 8;
    assert!(end < count, "the state, its mark and its checksum outgrew the message's words");
    end
}

/// Marks words as the state of this stage, of this layout: FNV-1a over its name, the layout's number and the size.
const fn mark<S: StageState>() -> u64 {
    let name = S::STAGE.as_bytes();
    let mut hash = BASIS;
    let mut index = 0;
    while index < name.len() {
        hash = mixed(hash, name[index] as u64);
        index += 1;
    }
    mixed(mixed(hash, S::LAYOUT as u64), size_of::<S>() as u64)
}

/// CRC-32 of the words' bytes, by the processor's own instructions: a state of 2000 words is stored in each cycle.
pub fn checksum(words: &[u64]) -> u64 {
    u64::from(crc32fast::hash(bytemuck::cast_slice(words)))
}

const fn mixed(hash: u64, value: u64) -> u64 {
    let product = (hash ^ value).wrapping_mul(0x100_0000_01b3);
    // FNV alone carries a word's highest bit nowhere: two numbers whose signs change would hide each other.
    product ^ (product >> 32)
}

fn read<S: StageState>(words: &[u64]) -> Option<S> {
    bytemuck::checked::try_pod_read_unaligned(bytemuck::cast_slice(words)).ok()
}

/// Index of the word by which these, that are no state, cease to be one: zeros are a state, and the words before it too.
fn first_without_value<S: StageState, const N: usize>(words: &[u64]) -> usize {
    let mut tried = [0; N];
    let ceases = |index: &usize| {
        tried[*index] = words[*index];
        read::<S>(&tried[..words.len()]).is_none()
    };
    (0..words.len()).find(ceases).unwrap_or(0)
}
