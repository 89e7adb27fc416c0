use crate::{Bounds, Input, Seed};
use rand::{RngExt, SeedableRng, seq::IndexedRandom};
use rand_pcg::Pcg64Mcg;

/// Changes seeds at random, the same way for the same random seed.
///
/// Stable engines of published crates make inputs of nothing, or wait for a compiler that counts branches; of nothing no
/// configuration is made that a parser reads to its end. So this one knows lines, words and numbers.
pub(crate) struct Mutator {
    input: Input,
    seeds: Vec<Vec<u8>>,
    longest: usize,
    random: Pcg64Mcg,
}

/// Numbers and words at which readers stumble.
const WORDS: [&str; 28] = [
    "0",
    "-1",
    "1",
    "-0.0",
    "nan",
    "-nan",
    "inf",
    "-inf",
    "1e308",
    "-1e308",
    "1e-308",
    "1e999",
    "255",
    "256",
    "65536",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "-9223372036854775808",
    "18446744073709551615",
    "99999999999999999999999",
    "true",
    "\"\"",
    "null",
    "[]",
    "{}",
    "\u{0}",
    "é",
];
/// What opens, closes and separates.
const SIGNS: [&str; 20] = [
    "[", "]", "[[", "]]", "{", "}", "\"", "'''", "\"\"\"", "<", "</", "/>", ">", "=", ",", ":", "#", "\n",
    "\r\n", "<!--",
];
/// Eight bytes at which messages stumble.
const NUMBERS: [u64; 14] = [
    0,
    1,
    u64::MAX,
    u32::MAX as u64,
    (u32::MAX as u64) << 32,
    i64::MIN as u64,
    i64::MAX as u64,
    0x7ff8_0000_0000_0000,
    0x7ff0_0000_0000_0000,
    0xfff0_0000_0000_0000,
    0x3ff0_0000_0000_0000,
    0xbff0_0000_0000_0000,
    0x7fef_ffff_ffff_ffff,
    0x408f_4000_0000_0000,
];
/// Most changes of one input.
const CHANGES: u32 = 6;
/// Once in so many changes of text a piece is repeated until the input is as long as it may be: deep nesting, long lists.
const RARELY: u32 = 400;

impl Mutator {
    pub(crate) fn new(input: Input, seeds: Vec<Seed>, bounds: &Bounds) -> Self {
        let mut seeds: Vec<_> = seeds.into_iter().map(|seed| seed.bytes).collect();
        if seeds.is_empty() {
            seeds.push(Vec::new());
        }
        Self { input, seeds, longest: bounds.longest, random: Pcg64Mcg::seed_from_u64(bounds.seed) }
    }

    /// The next input.
    pub(crate) fn next(&mut self) -> Vec<u8> {
        let mut bytes = self.seed();
        for _ in 0..self.random.random_range(1..=CHANGES) {
            match self.input {
                Input::Text if self.random.random_bool(0.8) => self.change_text(&mut bytes),
                Input::Patch if self.random.random_bool(0.8) => self.patch(&mut bytes),
                _ => self.change_bytes(&mut bytes),
            }
        }
        bytes.truncate(self.longest);
        bytes
    }

    fn seed(&mut self) -> Vec<u8> {
        self.seeds.choose(&mut self.random).cloned().unwrap_or_default()
    }

    fn change_text(&mut self, bytes: &mut Vec<u8>) {
        match self.random.random_range(0..6) {
            0 | 1 => self.replace_number(bytes),
            2 => self.change_lines(bytes),
            3 => self.replace_piece(bytes),
            4 => {
                let sign = *SIGNS.choose(&mut self.random).unwrap_or(&"[");
                insert(bytes, self.place(bytes.len()), sign.as_bytes());
            }
            _ if self.random.random_ratio(1, RARELY) => self.repeat(bytes),
            _ => self.replace_number(bytes),
        }
    }

    /// Puts a word in the place of a number.
    fn replace_number(&mut self, bytes: &mut Vec<u8>) {
        let is_number = |byte: &u8| byte.is_ascii_digit() || b"+-.eE_".contains(byte);
        let begins = |at: &usize| bytes[*at].is_ascii_digit() && (*at == 0 || !is_number(&bytes[at - 1]));
        let numbers: Vec<usize> = (0..bytes.len()).filter(begins).collect();
        let Some(&begin) = numbers.choose(&mut self.random) else { return };
        let end = bytes[begin..]
            .iter()
            .position(|byte| !is_number(byte))
            .map_or(bytes.len(), |length| begin + length);
        let word = WORDS.choose(&mut self.random).map_or("0".to_owned(), |word| (*word).to_owned());
        let word =
            if self.random.random_bool(0.3) { self.random.random_range(-1e3..1e3).to_string() } else { word };
        bytes.splice(begin..end, word.bytes());
    }

    /// Leaves out, repeats or moves a line, or takes one of another seed.
    fn change_lines(&mut self, bytes: &mut Vec<u8>) {
        let mut lines: Vec<Vec<u8>> =
            bytes.split_inclusive(|&byte| byte == b'\n').map(<[u8]>::to_vec).collect();
        if lines.is_empty() {
            return;
        }
        let (from, to) = (self.random.random_range(0..lines.len()), self.random.random_range(0..lines.len()));
        match self.random.random_range(0..4) {
            0 => drop(lines.remove(from)),
            1 => lines.insert(to, lines[from].clone()),
            2 => lines.swap(from, to),
            _ => {
                let other = self.seed();
                let others: Vec<_> = other.split_inclusive(|&byte| byte == b'\n').collect();
                lines.insert(
                    to,
                    others.choose(&mut self.random).map(|line| line.to_vec()).unwrap_or_default(),
                );
            }
        }
        *bytes = lines.concat();
    }

    /// Puts a piece of some seed in the place of another one.
    fn replace_piece(&mut self, bytes: &mut Vec<u8>) {
        let other = self.seed();
        let (from, into) = (self.range(other.len()), self.range(bytes.len()));
        bytes.splice(into, other[from].iter().copied());
    }

    /// Repeats a piece or a sign until the input is as long as it may be.
    fn repeat(&mut self, bytes: &mut Vec<u8>) {
        let piece = match self.random.random_bool(0.5) {
            true => SIGNS.choose(&mut self.random).map_or(Vec::new(), |sign| sign.as_bytes().to_vec()),
            false => bytes[self.range(bytes.len())].to_vec(),
        };
        let times = self.longest.saturating_sub(bytes.len()) / piece.len().max(1);
        insert(bytes, self.place(bytes.len()), &piece.repeat(times));
    }

    fn change_bytes(&mut self, bytes: &mut Vec<u8>) {
        match self.random.random_range(0..5) {
            0 => {
                let range = self.range(bytes.len());
                bytes.drain(range);
            }
            1 => {
                let number = NUMBERS.choose(&mut self.random).copied().unwrap_or_default();
                let length = 1 << self.random.random_range(0..4);
                let at = self.place(bytes.len());
                let end = bytes.len().min(at + length);
                bytes.splice(at..end, number.to_le_bytes()[..length].iter().copied());
            }
            2 => self.replace_piece(bytes),
            _ => {
                let at = self.place(bytes.len());
                if let Some(byte) = bytes.get_mut(at) {
                    *byte ^= 1 << self.random.random_range(0..8);
                }
            }
        }
    }

    /// Adds one change of a message: where, and what.
    fn patch(&mut self, bytes: &mut Vec<u8>) {
        if bytes.is_empty() {
            bytes.push(self.random.random());
        }
        let place: u32 = self.random.random();
        let value = match self.random.random_range(0..4) {
            0 => self.random.random::<u64>(),
            1 => self.random.random_range(-1e3..1e3_f64).to_bits(),
            2 => self.random.random_range(0..64),
            _ => NUMBERS.choose(&mut self.random).copied().unwrap_or_default(),
        };
        bytes.extend(place.to_le_bytes().into_iter().chain(value.to_le_bytes()));
    }

    fn place(&mut self, length: usize) -> usize {
        self.random.random_range(0..=length)
    }

    /// A range of up to 64 bytes.
    fn range(&mut self, length: usize) -> std::ops::Range<usize> {
        let begin = self.place(length);
        begin..length.min(begin + self.random.random_range(0..64))
    }
}

fn insert(bytes: &mut Vec<u8>, at: usize, piece: &[u8]) {
    bytes.splice(at..at, piece.iter().copied());
}
