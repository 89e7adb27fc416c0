use std::process::{Child, Command, Stdio};

/// Says sentences aloud with `espeak-ng`, without ever waiting for it.
#[derive(Debug, Default)]
pub struct Speaker {
    aloud: bool,
    /// Whether it was asked for, and a missing program is worth a word.
    asked: bool,
    speaking: Vec<Child>,
}

impl Speaker {
    /// Environment variable: 0 keeps the robot silent; without it, it speaks aloud where the program is installed.
    pub const VARIABLE: &'static str = "COACT_SPEAK";

    /// Aloud unless the environment forbids it.
    pub fn from_environment() -> Self {
        let wish = std::env::var(Self::VARIABLE).unwrap_or_default();
        Self { aloud: wish != "0", asked: !wish.is_empty(), speaking: Vec::new() }
    }

    /// Starts to say a sentence. Without the program the robot speaks in writing only; if speech was asked for, the log
    /// says so once.
    pub fn say(&mut self, text: &str) {
        self.speaking.retain_mut(|child| matches!(child.try_wait(), Ok(None)));
        if !self.aloud {
            return;
        }
        let mut program = Command::new("espeak-ng");
        program.args(["--", text]).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        match program.spawn() {
            Ok(child) => self.speaking.push(child),
            Err(error) => {
                if self.asked {
                    tracing::warn!("espeak-ng cannot be started: {error}; the robot speaks in writing only");
                }
                self.aloud = false;
            }
        }
    }
}
