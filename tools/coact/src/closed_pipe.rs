/// From here on, a reader that has seen enough (`| head`) ends the program without a word, as with any other filter.
///
/// Never while processes run that this program must stop: it would leave them behind.
pub fn ends_the_program() {
    // SAFETY: the default disposition of a signal runs no code of ours; no other thread changes this signal's.
    unsafe { libc::signal(libc::SIGPIPE, libc::SIG_DFL) };
}
