//! Can this machine hold a period of 1 ms? What the kernel tells of itself, judged line by line.
//!
//! Everything is read below a root folder, `/` for the machine itself, so that made-up machines can be judged as well.
//!
//! ```
//! use coact_machine_check::{Demand, check};
//!
//! let findings = check("/".as_ref(), &Demand { cores: vec![1], priority: 84 });
//! assert!(findings.iter().any(|finding| finding.subject == "clock source"));
//! ```

mod cgroup;
mod cores;
mod demand;
mod finding;
mod kernel;
mod limits;
mod memory;
mod root;

pub use demand::Demand;
pub use finding::{Finding, Level};

use root::Root;
use std::path::Path;

/// Judges the machine whose `/proc`, `/sys` and `/dev` are below `root`.
pub fn check(root: &Path, demand: &Demand) -> Vec<Finding> {
    let root = Root(root);
    let mut findings = vec![
        kernel::preemption(&root),
        limits::scheduling(&root, demand),
        limits::locked_memory(&root),
        limits::open_files(&root),
        kernel::throttling(&root),
        kernel::clock_source(&root),
        cores::number(&root),
        cores::governor(&root, &demand.cores),
        cores::idle_states(&root, &demand.cores),
    ];
    findings.extend(demand.cores.iter().flat_map(|&core| cores::isolation(&root, core)));
    findings.extend([
        memory::swap(&root),
        memory::shared(&root),
        cgroup::processor(&root),
        cgroup::memory(&root),
    ]);
    findings
}
