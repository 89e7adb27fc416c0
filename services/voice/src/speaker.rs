use std::process::{Child, Command, Stdio};

/// Says sentences aloud with `espeak-ng`, without ever waiting for it.
#[derive(Debug, Default)]
pub struct Speaker {
    aloud: bool,
    speaking: Vec<Child>,
}

impl Speaker {
    /// Environment variable that makes the robot speak aloud when it is set to anything but 0.
    pub const VARIABLE: &'static str = "COACT_SPEAK";

    /// Aloud if the environment asks for it.
    pub fn from_environment() -> Self {
        let aloud = std::env::var(Self::VARIABLE).is_ok_and(|value| !value.is_empty() && value != "0");
        Self { aloud, speaking: Vec::new() }
    }

    /// Starts to say a sentence; without the program, or when it cannot be started, this is said once on the log.
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
                tracing::warn!("espeak-ng cannot be started: {error}; the robot speaks in writing only");
                self.aloud = false;
            }
        }
    }
}
