//! No page fault in a steady cycle: memory is locked, or at least prefaulted before the first cycle.

use rustix::mm::{Advice, MlockAllFlags, madvise, mlockall};
use rustix::process::{Resource, getrlimit};
use rustix::thread::{CapabilitySet, capabilities};
use std::hint::black_box;

/// Heap that is prefaulted for allocations in steady cycles, bytes: iceoryx2 makes one for each loan. A
/// trade-off, chosen by hand: more costs memory, less costs page faults in the first cycles.
const HEAP_RESERVE: usize = 1 << 20;
/// Stack that is prefaulted for steady cycles, bytes. A trade-off, chosen by hand: more costs memory,
/// less costs page faults in the first cycles.
const STACK_RESERVE: usize = 256 << 10;
/// Heaps of one process: more than it has threads, so that each has its own. Of one heap for all, an ordinary thread that was kept from its
/// core held the lock while the real-time one wanted memory for a new connection: a stage was without output for up to 6 ms.
const HEAPS: i32 = 32;

/// Prefaults all memory, and locks it if the machine grants that.
///
/// # Errors
/// Why it is not locked.
pub(crate) fn lock_and_prefault() -> Result<(), String> {
    retain_heap();
    touch_stack();
    let locked = lock(MlockAllFlags::CURRENT);
    if locked.is_err() {
        populate();
    }
    locked
}

/// The same for a process that is needed at once: what it touches is locked from then on, and [`populate`], which takes longer
/// than all the rest of a start, is left to a thread beside its first cycles.
///
/// # Errors
/// As [`lock_and_prefault`].
pub(crate) fn lock_on_fault() -> Result<(), String> {
    retain_heap();
    touch_stack();
    lock(MlockAllFlags::CURRENT | MlockAllFlags::ONFAULT)
}

/// Makes the allocator retain its memory: what was prefaulted is never given back to the kernel.
fn retain_heap() {
    // SAFETY: mallopt only sets parameters of the allocator; called before any other thread exists.
    unsafe {
        libc::mallopt(libc::M_TRIM_THRESHOLD, -1);
        libc::mallopt(libc::M_MMAP_MAX, 0);
        libc::mallopt(libc::M_ARENA_MAX, HEAPS);
        libc::mallopt(libc::M_TOP_PAD, HEAP_RESERVE as i32);
    }
    drop(black_box(vec![1_u8; HEAP_RESERVE]));
}

#[inline(never)]
fn touch_stack() {
    black_box([1_u8; STACK_RESERVE]);
}

fn lock(current: MlockAllFlags) -> Result<(), String> {
    let may_lock = capabilities(None).is_ok_and(|sets| sets.effective.contains(CapabilitySet::IPC_LOCK));
    // Under a finite limit, locking would make later mappings of peers' memory fail in the middle of the run.
    if let (false, Some(limit)) = (may_lock, getrlimit(Resource::Memlock).current) {
        return Err(format!("memory lock: limit is {} KiB (expected memlock unlimited)", limit >> 10));
    }
    // Later mappings are buffers of peers that join or are restarted. Prefaulting all their megabytes at once would delay
    // a cycle by more than its period; on first use, it costs some microseconds for each of the first few messages.
    mlockall(current)
        .and_then(|()| mlockall(MlockAllFlags::FUTURE | MlockAllFlags::ONFAULT))
        .map_err(|error| format!("memory lock: {error}"))
}

/// Prefaults the pages of every mapping that exists now.
pub(crate) fn populate() {
    let Ok(maps) = std::fs::read_to_string("/proc/self/maps") else { return };
    for (range, rights) in maps.lines().filter_map(mapping) {
        let advice =
            if rights.starts_with("rw") { Advice::LinuxPopulateWrite } else { Advice::LinuxPopulateRead };
        // SAFETY: populating neither changes contents nor rights; ranges that have vanished are refused.
        let _ = unsafe { madvise(range.start as *mut _, range.len(), advice) };
    }
}

/// Address range and access rights of one line of /proc/self/maps.
fn mapping(line: &str) -> Option<(std::ops::Range<usize>, &str)> {
    let mut words = line.split_ascii_whitespace();
    let (first, last) = words.next()?.split_once('-')?;
    let parse = |text| usize::from_str_radix(text, 16).ok();
    Some((parse(first)?..parse(last)?, words.next()?)).filter(|(_, rights)| rights.starts_with('r'))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn mapping_is_read_with_its_rights() {
        let (range, rights) = mapping("7f00-8f00 rw-s 00000000 00:1a 3 /dev/shm/coact").unwrap();
        assert_eq!((range, rights), (0x7f00..0x8f00, "rw-s"));
        assert_eq!(mapping("7f00-8f00 ---p 00000000 00:00 0"), None);
        assert_eq!(mapping(""), None);
    }

    #[test]
    fn populated_memory_takes_no_fault_when_it_is_written() {
        let pages = 512;
        let size = pages * 4096;
        // SAFETY: a fresh anonymous mapping, used only below.
        let memory = unsafe {
            let flags = rustix::mm::MapFlags::PRIVATE;
            let rights = rustix::mm::ProtFlags::READ | rustix::mm::ProtFlags::WRITE;
            rustix::mm::mmap_anonymous(std::ptr::null_mut(), size, rights, flags).unwrap()
        };
        populate();
        let before = faults();
        for page in 0..pages {
            // SAFETY: within the mapping.
            unsafe { memory.cast::<u8>().add(page * 4096).write_volatile(1) };
        }
        assert!(faults() - before < pages as i64 / 4, "{} faults for {pages} pages", faults() - before);
    }

    fn faults() -> i64 {
        // SAFETY: getrusage fills the structure that it is given.
        unsafe {
            let mut usage: libc::rusage = std::mem::zeroed();
            libc::getrusage(libc::RUSAGE_THREAD, &raw mut usage);
            usage.ru_minflt
        }
    }
}
