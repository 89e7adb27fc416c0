use bytemuck::{Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;

/// The person's newest sentence, as the microphone's recogniser wrote it down.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
pub struct Heard {
    /// Sentences heard so far; unchanged while nothing new was said.
    pub sentences: u64,
    /// Cycle at which the newest one was complete.
    pub cycle: u64,
    /// Bytes of `text` that are valid.
    pub length: u64,
    /// The sentence, UTF-8.
    pub text: [u8; 256],
}

impl Heard {
    /// Takes down another sentence; what does not fit is cut off.
    pub fn hear(&mut self, cycle: u64, sentence: &str) {
        let sentence = &sentence[..sentence.floor_char_boundary(self.text.len())];
        self.sentences += 1;
        self.cycle = cycle;
        self.length = sentence.len() as u64;
        self.text = [0; 256];
        self.text[..sentence.len()].copy_from_slice(sentence.as_bytes());
    }

    /// The newest sentence; empty before the first, and for bytes that are no text.
    pub fn sentence(&self) -> &str {
        let length = (self.length as usize).min(self.text.len());
        std::str::from_utf8(&self.text[..length]).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_is_heard_as_it_was_said_and_a_long_one_is_cut_between_characters() {
        let mut heard = Heard::zeroed();
        assert_eq!(heard.sentence(), "");
        heard.hear(7, "give me the wheel");
        assert_eq!((heard.sentences, heard.cycle, heard.sentence()), (1, 7, "give me the wheel"));
        heard.hear(9, &"é".repeat(200));
        assert_eq!((heard.sentences, heard.sentence()), (2, "é".repeat(128).as_str()));
        heard.text[0] = 0xff;
        assert_eq!(heard.sentence(), "");
    }
}
