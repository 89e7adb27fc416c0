use crate::{Flaw, Header, Plausible, message_text};
use bytemuck::{Pod, Zeroable};
use iceoryx2::prelude::ZeroCopySend;

/// A sentence that the robot says, or that the person says to it (on occasion).
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
#[type_name("coact::Speech")]
pub struct Speech {
    /// Header; `cycle` is that of the field frame that the sentence was composed from.
    pub header: Header,
    /// Bytes of `text` that are valid.
    pub length: u64,
    /// The sentence, UTF-8.
    pub text: [u8; 256],
}

impl Speech {
    /// Takes down a sentence; what does not fit is cut off.
    pub fn write(&mut self, sentence: &str) {
        self.length = message_text::write(sentence, &mut self.text);
    }

    /// The sentence; empty for bytes that are no text.
    pub fn sentence(&self) -> &str {
        message_text::read(&self.text, self.length)
    }
}

impl Plausible for Speech {
    fn check(&self) -> Result<(), Flaw> {
        message_text::check("text", &self.text, self.length)
    }
}
