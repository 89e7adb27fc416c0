//! No page fault in a steady cycle: memory is locked, or at least prefaulted before the first cycle.

use crate::SchedulingClass;
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
/// Memory that is populated at once, bytes: whoever populates holds a lock of the address space, and a real-time thread that maps a
/// peer's memory waits for it. Chosen by hand: 16 pages take some ten microseconds.
const PIECE: usize = 64 << 10;

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
        for start in range.clone().step_by(PIECE) {
            let size = PIECE.min(range.end - start);
            // SAFETY: populating neither changes contents nor rights; ranges that have vanished are refused.
            let _ = unsafe { madvise(start as *mut _, size, advice) };
        }
    }
}

/// The same by a thread beside cycles that run already, on their core: from then on it stands above ordinary threads.
///
/// As one of those it was kept from its core by other programs while it held the lock of
/// the address space, and the real-time thread of a replacement stood for more than 100 ms in `munmap`: it was taken for hung.
pub(crate) fn populate_beside_cycles() {
    // Refused, no thread of the process is of a real-time class.
    let _ = SchedulingClass::STARTING.apply();
    populate();
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
    use crate::scheduling;
    use std::sync::atomic::{AtomicBool, Ordering};
    use std::time::{Duration, Instant};

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
        let memory = anonymous(pages * 4096);
        populate();
        let before = faults();
        for page in 0..pages {
            // SAFETY: within the mapping.
            unsafe { memory.cast::<u8>().add(page * 4096).write_volatile(1) };
        }
        assert!(faults() - before < pages as i64 / 4, "{} faults for {pages} pages", faults() - before);
    }

    #[test]
    fn whoever_gives_memory_back_waits_for_no_thread_that_populates_while_others_have_its_core() {
        const POPULATED: usize = 128 << 20;
        let over = AtomicBool::new(false);
        let work = || {
            SchedulingClass::Other.apply().unwrap();
            while !over.load(Ordering::Relaxed) {
                std::hint::spin_loop();
            }
        };
        std::thread::scope(|scope| {
            let cycles = || {
                scheduling::keep_to_first_core();
                if SchedulingClass::Fifo(3).apply().is_err() {
                    println!("skipped: no right to SCHED_FIFO");
                    return;
                }
                let (memory, begun) = (anonymous(POPULATED), Instant::now());
                scope.spawn(populate_beside_cycles).join().unwrap();
                let alone = begun.elapsed();
                give_back(memory, POPULATED);
                (0..9).for_each(|_| _ = scope.spawn(work));
                let (memory, begun) = (anonymous(POPULATED), Instant::now());
                let beside = scope.spawn(populate_beside_cycles);
                let mut longest = Duration::ZERO;
                while !beside.is_finished() {
                    let cycle = Instant::now();
                    give_back(anonymous(4096), 4096);
                    longest = longest.max(cycle.elapsed());
                    std::thread::sleep(Duration::from_millis(1));
                }
                let all = begun.elapsed();
                over.store(true, Ordering::Relaxed);
                give_back(memory, POPULATED);
                assert!(longest < all / 5, "{longest:?} of the {all:?} that populating took");
                assert!(all < 3 * alone, "others kept it from its core: {all:?}, alone {alone:?}");
            };
            scope.spawn(cycles);
        });
    }

    fn anonymous(size: usize) -> *mut libc::c_void {
        let rights = rustix::mm::ProtFlags::READ | rustix::mm::ProtFlags::WRITE;
        let flags = rustix::mm::MapFlags::PRIVATE;
        // SAFETY: a fresh anonymous mapping, used only by whoever asked for it.
        unsafe { rustix::mm::mmap_anonymous(std::ptr::null_mut(), size, rights, flags).unwrap() }
    }

    fn give_back(memory: *mut libc::c_void, size: usize) {
        // SAFETY: mapped by `anonymous` with this size, and not used any more.
        unsafe { rustix::mm::munmap(memory, size).unwrap() };
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
