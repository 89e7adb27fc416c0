use coact_realtime::SchedulingClass;
use std::collections::VecDeque;
use std::io::{BufRead, BufReader, Read};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// The tail of a process's standard error. Reads all of it, passes each line on, and retains the last ones.
#[derive(Debug)]
pub struct StderrTail {
    lines: Arc<Mutex<VecDeque<String>>>,
    reader: JoinHandle<()>,
}

impl StderrTail {
    /// Lines that are retained: an error with its causes, or a panic's message. Chosen by hand.
    const LINES: usize = 12;
    /// How often it looks whether the reader has come to the end.
    const POLL_INTERVAL: Duration = Duration::from_millis(1);

    /// Reads `stderr` until its end on a thread of its own; each line goes to `on_line`, too.
    pub fn follow(
        stderr: impl Read + Send + 'static,
        mut on_line: impl FnMut(&str) + Send + 'static,
    ) -> Self {
        let lines = Arc::new(Mutex::new(VecDeque::with_capacity(Self::LINES)));
        let tail = Arc::clone(&lines);
        let reader = std::thread::spawn(move || {
            // Refused only to a thread that never had another class.
            let _ = SchedulingClass::Other.apply();
            for line in BufReader::new(stderr).split(b'\n').map_while(Result::ok) {
                let line = String::from_utf8_lossy(&line);
                on_line(&line);
                let mut tail = tail.lock().unwrap_or_else(PoisonError::into_inner);
                if tail.len() == Self::LINES {
                    tail.pop_front();
                }
                tail.push_back(line.into_owned());
            }
        });
        Self { lines, reader }
    }

    /// The last lines. Of a dead process: waits up to `limit` for what is still in the pipe.
    pub fn last_lines(&self, limit: Duration) -> Vec<String> {
        let begin = Instant::now();
        while !self.reader.is_finished() && begin.elapsed() < limit {
            std::thread::sleep(Self::POLL_INTERVAL);
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
    fn all_lines_are_passed_on_and_the_last_ones_are_retained() {
        let text: String = (0..100).map(|i| format!("line {i}\n")).collect();
        let (sender, receiver) = channel();
        let tail = StderrTail::follow(std::io::Cursor::new(text), move |line| {
            sender.send(line.to_owned()).unwrap();
        });
        let last = tail.last_lines(Duration::from_secs(60));
        assert_eq!(last.len(), StderrTail::LINES);
        assert_eq!(last.last().unwrap(), "line 99");
        assert_eq!(receiver.iter().count(), 100);
    }
}
