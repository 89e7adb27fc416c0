use rustix::param::clock_ticks_per_second;
use std::fs::File;
use std::io::{self, Read};
use std::time::Duration;

/// What the kernel tells everybody of a process: `/proc/<pid>/stat`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ProcessStat {
    /// When it was started, clock ticks after boot. With the process id it is one process for ever: an id comes again, but
    /// not with the same time.
    pub started: u64,
    /// Whether a signal has stopped it (SIGSTOP), or a debugger.
    pub is_stopped: bool,
    /// Whether its main thread runs, or would if it had a core.
    pub is_runnable: bool,
    /// Whether its main thread sleeps until a message, a timer or a lock wakes it.
    pub is_asleep: bool,
    /// Whether it waits for something within the kernel, memory or a file, and no signal wakes it.
    pub is_in_kernel: bool,
    /// For how long it has computed, to some hundredths of a second.
    pub computed: Duration,
    /// How it ends, once it does, as wait(2) encodes it; 0 before, and to those who may not know.
    pub exit_code: i32,
}

impl ProcessStat {
    /// Longer than any line of it, bytes.
    const LONGEST: u64 = 4096;

    /// Of the process with this id.
    ///
    /// # Errors
    /// There is no such process, or the kernel tells something else.
    pub fn of(pid: u32) -> io::Result<Self> {
        Self::read(&format!("/proc/{pid}/stat"))
    }

    /// Of the thread of this process with this id: its own state and computing time.
    ///
    /// # Errors
    /// There is no such thread, or the kernel tells something else.
    pub fn of_thread(id: u32) -> io::Result<Self> {
        Self::read(&format!("/proc/self/task/{id}/stat"))
    }

    fn read(file: &str) -> io::Result<Self> {
        let mut text = String::new();
        File::open(file)?.take(Self::LONGEST).read_to_string(&mut text)?;
        Self::parse(&text).ok_or_else(|| io::ErrorKind::InvalidData.into())
    }

    /// The process's name stands in parentheses and may contain anything: what is of interest comes behind it.
    fn parse(text: &str) -> Option<Self> {
        let mut fields = text.rsplit_once(')')?.1.split_ascii_whitespace();
        let state = fields.next()?;
        // Fields 14 and 15 of proc_pid_stat(5); the state is field 3.
        let (user, system): (u64, u64) = (fields.nth(10)?.parse().ok()?, fields.next()?.parse().ok()?);
        let computed = Duration::from_secs(user + system) / clock_ticks_per_second() as u32;
        // Field 22.
        let started = fields.nth(6)?.parse().ok()?;
        // Field 52.
        let exit_code = fields.nth(29).and_then(|code| code.parse().ok()).unwrap_or(0);
        let [is_runnable, is_asleep, is_in_kernel] = ["R", "S", "D"].map(|letter| state == letter);
        let is_stopped = matches!(state, "T" | "t");
        Some(Self { started, is_stopped, is_runnable, is_asleep, is_in_kernel, computed, exit_code })
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn it_is_read_behind_a_name_that_contains_anything() {
        let text = "7 (a) T (b 1) T 1 7 7 0 -1 4194560 1 0 0 0 30 20 0 0 20 0 1 0 98765 1 2 3";
        let mut expected = ProcessStat {
            started: 98765,
            is_stopped: true,
            is_runnable: false,
            is_asleep: false,
            is_in_kernel: false,
            computed: Duration::from_secs(50) / clock_ticks_per_second() as u32,
            exit_code: 0,
        };
        assert_eq!(ProcessStat::parse(text), Some(expected));
        let running = ProcessStat { is_stopped: false, is_runnable: true, ..expected };
        assert_eq!(ProcessStat::parse(&text.replacen(") T 1", ") R 1", 1)), Some(running));
        let asleep = ProcessStat { is_runnable: false, is_asleep: true, ..running };
        assert_eq!(ProcessStat::parse(&text.replacen(") T 1", ") S 1", 1)), Some(asleep));
        expected.exit_code = 9;
        assert_eq!(ProcessStat::parse(&format!("{text}{} 9\n", " 5".repeat(26))), Some(expected));
        for bad in ["", "7 (a", "7 (a) R 1 2", "7 (a) R 1 7 7 0 -1 4 1 0 0 0 0 0 0 0 20 0 1 0 soon 1"] {
            assert_eq!(ProcessStat::parse(bad), None, "{bad}");
        }
    }

    #[test]
    fn a_process_keeps_its_start_for_as_long_as_it_lives() {
        let own = ProcessStat::of(std::process::id()).unwrap();
        assert_eq!(ProcessStat::of(std::process::id()).unwrap().started, own.started);
        assert!(own.started > 0 && !own.is_stopped);
        assert!(ProcessStat::of(u32::MAX).is_err());
    }
}
