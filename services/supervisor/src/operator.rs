//! Who may operate a set: known by the socket's peer, which the kernel tells.

use std::io;
use std::os::fd::AsRawFd;
use std::os::unix::net::UnixStream;

/// Refuses, in words, a peer that is neither the user that owns the set nor root.
pub(crate) fn check(stream: &UnixStream) -> io::Result<Result<(), String>> {
    let peer = peer(stream)?;
    let own = rustix::process::geteuid().as_raw();
    Ok(match may_operate(peer, own) {
        true => Ok(()),
        false => {
            Err(format!("user {peer} may not operate this set; expected user {own}, who started it, or root"))
        }
    })
}

fn may_operate(peer: u32, own: u32) -> bool {
    peer == own || peer == 0
}

/// The user that the peer had when it connected.
fn peer(stream: &UnixStream) -> io::Result<u32> {
    let mut peer = libc::ucred { pid: 0, uid: u32::MAX, gid: u32::MAX };
    let mut length = size_of::<libc::ucred>() as libc::socklen_t;
    // SAFETY: the descriptor is open as long as `stream`, and the kernel writes at most `length` bytes into `peer`, which
    // is that long.
    let status = unsafe {
        libc::getsockopt(
            stream.as_raw_fd(),
            libc::SOL_SOCKET,
            libc::SO_PEERCRED,
            (&raw mut peer).cast(),
            &raw mut length,
        )
    };
    if status == 0 { Ok(peer.uid) } else { Err(io::Error::last_os_error()) }
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
        assert_eq!(peer(&one).unwrap(), rustix::process::geteuid().as_raw());
        assert_eq!(check(&one).unwrap(), Ok(()));
    }
}
