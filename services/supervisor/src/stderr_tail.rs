use crate::scheduling;
use std::collections::VecDeque;
use std::io::{BufRead, BufReader, Read};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Reads what a process writes to its standard error, passes it on, and keeps the last lines.
#[derive(Debug)]
pub struct StderrTail {
    lines: Arc<Mutex<VecDeque<String>>>,
    reader: JoinHandle<()>,
}

impl StderrTail {
    /// Lines that are kept.
    const KEPT: usize = 12;

    /// Reads `stderr` until its end on a thread of its own; each line goes to `pass_on`, too.
    pub fn follow(
        stderr: impl Read + Send + 'static,
        mut pass_on: impl FnMut(&str) + Send + 'static,
    ) -> Self {
        let lines = Arc::new(Mutex::new(VecDeque::with_capacity(Self::KEPT)));
        let kept = Arc::clone(&lines);
        let reader = std::thread::spawn(move || {
            scheduling::stand_down();
            for line in BufReader::new(stderr).split(b'\n').map_while(Result::ok) {
                let line = String::from_utf8_lossy(&line);
                pass_on(&line);
                let mut kept = kept.lock().unwrap_or_else(PoisonError::into_inner);
                if kept.len() == Self::KEPT {
                    kept.pop_front();
                }
                kept.push_back(line.into_owned());
            }
        });
        Self { lines, reader }
    }

    /// The last lines. Of a dead process: waits up to `limit` for what is still in the pipe.
    pub fn last_lines(&self, limit: Duration) -> Vec<String> {
        let begin = Instant::now();
        while !self.reader.is_finished() && begin.elapsed() < limit {
            std::thread::sleep(Duration::from_millis(1));
        }
        self.lines.lock().unwrap_or_else(PoisonError::into_inner).iter().cloned().collect()
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use std::sync::mpsc::channel;

    #[test]
    fn all_lines_are_passed_on_and_the_last_ones_are_kept() {
        let text: String = (0..100).map(|i| format!("line {i}\n")).collect();
        let (sender, receiver) = channel();
        let tail = StderrTail::follow(std::io::Cursor::new(text), move |line| {
            sender.send(line.to_owned()).unwrap();
        });
        let kept = tail.last_lines(Duration::from_secs(60));
        assert_eq!(kept.len(), StderrTail::KEPT);
        assert_eq!(kept.last().unwrap(), "line 99");
        assert_eq!(receiver.iter().count(), 100);
    }
}
