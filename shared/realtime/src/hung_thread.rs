/// Exit status of a process that ends because a thread of it hangs: one that no program of ours uses otherwise.
pub const HUNG_THREAD: i32 = 75;

/// Ends the process because its background thread of this name hangs. Nothing within it can end or restart a thread; another
/// process can take its place.
pub fn end_for_hung_thread(name: &str) -> ! {
    tracing::error!("the thread \"{name}\" hangs: this process ends, so that another takes its place");
    std::process::exit(HUNG_THREAD)
}
