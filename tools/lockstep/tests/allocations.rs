//! A steady cycle makes no heap allocation. Control plans within its own step here: what it does without that, its own
//! tests count.
#![allow(clippy::unwrap_used)]

#[path = "lockstep/shipped.rs"]
mod shipped;

use coact_lockstep::Lockstep;
use shipped::settings;
use std::collections::BTreeMap;

#[test]
fn no_stage_allocates_in_steady_state() {
    let mut stages = Lockstep::new(&settings(2, "synthetic")).unwrap();
    (0..100).for_each(|_| stages.step());
    let mut allocations = BTreeMap::<&str, u64>::new();
    // Long enough for grasps, handovers and changes of decision.
    for _ in 0..30_000 {
        stages.step_watched(&mut |name, stage| {
            *allocations.entry(name).or_default() += allocation_counter::measure(stage).count_total;
        });
    }
    assert!(allocations.remove("control").is_some_and(|count| count > 0), "the counter counts");
    assert_eq!(allocations, BTreeMap::from([("world", 0), ("perception", 0), ("fields", 0)]));
}
