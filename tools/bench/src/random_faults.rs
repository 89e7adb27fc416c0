use coact_supervisor::{Fault, Injection};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg32;
use std::time::Duration;

/// How long the set is left alone when it begins.
const BEGINS: Duration = Duration::from_millis(2500);

/// So many faults, each of one of these processes by turns, at random instants that are `every` apart on the average, and not nearer
/// to each other than half of that.
pub fn random_faults(
    processes: &[&str],
    fault: Fault,
    count: usize,
    every: Duration,
    seed: u64,
) -> Vec<Injection> {
    let mut random = Pcg32::seed_from_u64(seed);
    let mut at = BEGINS;
    let mut strike = |process: &&str| {
        at += every.mul_f64(random.random_range(0.5..1.5));
        Injection { process: (*process).to_owned(), fault, at }
    };
    processes.iter().cycle().take(count).map(&mut strike).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn processes_take_turns_at_instants_that_the_seed_decides() {
        let every = Duration::from_millis(400);
        let faults = |seed| random_faults(&["fields", "control"], Fault::Kill, 9, every, seed);
        let one = faults(1);
        assert_eq!(one.len(), 9);
        for pair in one.windows(2) {
            let gap = pair[1].at - pair[0].at;
            assert!(
                gap >= every / 2 && gap <= every * 3 / 2 && pair[0].process != pair[1].process,
                "{pair:?}"
            );
        }
        assert!(one == faults(1) && one != faults(2));
    }
}
