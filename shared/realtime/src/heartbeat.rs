use std::fs::{File, OpenOptions};
use std::io;
use std::os::unix::fs::OpenOptionsExt;
use std::path::Path;
use std::time::{Duration, Instant, SystemTime};

/// The sign of life of a process that follows the run at its own pace: it touches a file of the run directory ten times a
/// second. Once it has begun to, the supervisor takes a longer pause for a hang.
#[derive(Debug)]
pub struct Heartbeat {
    file: File,
    due: Instant,
}

impl Heartbeat {
    /// Often enough for the watchdog, which waits for ten of them. Chosen by hand.
    const INTERVAL: Duration = Duration::from_millis(100);

    /// Begins with the first beat.
    pub(crate) fn begin(path: &Path) -> io::Result<Self> {
        let file = OpenOptions::new().write(true).create(true).truncate(true).mode(0o600).open(path)?;
        Ok(Self { file, due: Instant::now() })
    }

    /// To be called in each turn of the process's loop: beats when a beat is due.
    ///
    /// # Errors
    /// The run directory is gone.
    pub fn beat(&mut self) -> io::Result<()> {
        let now = Instant::now();
        if now < self.due {
            return Ok(());
        }
        self.due = now + Self::INTERVAL;
        self.file.set_modified(SystemTime::now())
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn it_beats_when_a_beat_is_due_and_not_more_often() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("voice.heartbeat");
        let mut heartbeat = Heartbeat::begin(&path).unwrap();
        let modified = || std::fs::metadata(&path).unwrap().modified().unwrap();
        heartbeat.beat().unwrap();
        let first = modified();
        heartbeat.beat().unwrap();
        assert_eq!(modified(), first);
        std::thread::sleep(Heartbeat::INTERVAL);
        heartbeat.beat().unwrap();
        assert!(modified() > first);
    }
}
