use crate::{Flaw, Header, message_text, plausible};
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
        self.sentences += 1;
        self.cycle = cycle;
        self.length = message_text::write(sentence, &mut self.text);
    }

    /// The newest sentence; empty before the first, and for bytes that are no text.
    pub fn sentence(&self) -> &str {
        message_text::read(&self.text, self.length)
    }
}

impl Heard {
    pub(crate) fn check(&self, header: &Header) -> Result<(), Flaw> {
        plausible::not_after("heard.cycle", header, &[self.cycle])?;
        message_text::check("heard.text", &self.text, self.length)
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
