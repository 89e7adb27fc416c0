use std::fmt;
use std::io;
use std::os::fd::AsRawFd;
use std::os::unix::net::UnixStream;

/// Who operates a set: the peer of the set's socket, as the kernel tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Operator {
    /// The user that it had when it connected.
    pub(crate) user: u32,
    /// Its process id then.
    pub(crate) pid: u32,
}

impl Operator {
    /// The peer of a connection.
    ///
    /// # Errors
    /// The kernel does not tell.
    pub(crate) fn of(stream: &UnixStream) -> io::Result<Self> {
        let mut peer = libc::ucred { pid: 0, uid: u32::MAX, gid: u32::MAX };
        let mut length = size_of::<libc::ucred>() as libc::socklen_t;
        // SAFETY: the descriptor is open as long as `stream`, and the kernel writes at most `length` bytes into `peer`,
        // which is that long.
        let status = unsafe {
            libc::getsockopt(
                stream.as_raw_fd(),
                libc::SOL_SOCKET,
                libc::SO_PEERCRED,
                (&raw mut peer).cast(),
                &raw mut length,
            )
        };
        match status {
            0 => Ok(Self { user: peer.uid, pid: u32::try_from(peer.pid).unwrap_or(0) }),
            _ => Err(io::Error::last_os_error()),
        }
    }

    /// Who runs this program.
    pub(crate) fn own() -> Self {
        Self { user: rustix::process::geteuid().as_raw(), pid: std::process::id() }
    }

    /// Refuses, in words, who is neither the user that owns the set nor root.
    pub(crate) fn check(self) -> Result<(), String> {
        let (user, own) = (self.user, rustix::process::geteuid().as_raw());
        match may_operate(user, own) {
            true => Ok(()),
            false => Err(format!(
                "user {user} may not operate this set; expected user {own}, who started it, or root"
            )),
        }
    }
}

impl fmt::Display for Operator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "user {} (pid {})", self.user, self.pid)
    }
}

fn may_operate(peer: u32, own: u32) -> bool {
    peer == own || peer == 0
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn only_the_owner_and_root_operate_a_set() {
        assert!(may_operate(1000, 1000) && may_operate(0, 1000) && may_operate(0, 0));
        assert!(!may_operate(1001, 1000) && !may_operate(1000, 0) && !may_operate(u32::MAX, 0));
    }

    #[test]
    fn the_kernel_tells_who_the_peer_is() {
        let (one, _other) = UnixStream::pair().unwrap();
        let operator = Operator::of(&one).unwrap();
        assert_eq!(operator.user, rustix::process::geteuid().as_raw());
        assert_eq!(operator.pid, std::process::id());
        assert_eq!(operator.check(), Ok(()));
    }
}
