use rustix::io::Errno;
use std::fs::File;
use std::io;

/// Whether the process may still open something: one that may not ends, so that another takes its place.
///
/// # Errors
/// No file handles are left, to the process or on the machine.
pub fn handles_left() -> io::Result<()> {
    let is_shortage = |error: &io::Error| {
        [Errno::MFILE, Errno::NFILE]
            .iter()
            .any(|shortage| error.raw_os_error() == Some(shortage.raw_os_error()))
    };
    match File::open("/dev/null") {
        Err(error) if is_shortage(&error) => Err(error),
        _ => Ok(()),
    }
}
