use crate::{Glimpse, Picture};
use std::sync::Arc;

/// The run so far, to go back through. It never holds more than so many glimpses: when it is full, every second one of them is
/// dropped, and from then on half as many are kept of what comes. So all of the run is there, as fine as there is room.
#[derive(Debug)]
pub struct History {
    glimpses: Vec<Arc<Glimpse>>,
    most: usize,
    /// From one glimpse that is kept to the next, cycles.
    spacing: u64,
}

/// From one glimpse to the next while there is room for all, cycles: ten a second.
const SPACING: u64 = 100;

impl History {
    /// An empty one for at most so many glimpses.
    pub fn new(most: usize) -> Self {
        Self { glimpses: Vec::new(), most: most.max(2), spacing: SPACING }
    }

    /// Keeps a glimpse, unless the one before was just now. Of one that is kept the activity of single sites is left out.
    pub fn keep(&mut self, glimpse: &Glimpse) {
        let cycle = glimpse.picture.cycle;
        if self.glimpses.last().is_some_and(|last| cycle < last.picture.cycle + self.spacing) {
            return;
        }
        if self.glimpses.len() >= self.most {
            let mut number = 0;
            self.glimpses.retain(|_| {
                number += 1;
                number % 2 == 1
            });
            self.spacing *= 2;
        }
        self.glimpses.push(Arc::new(Glimpse { picture: glimpse.picture.of_the_past(), ..glimpse.clone() }));
    }

    /// The glimpse that is nearest to `cycle`.
    pub fn at(&self, cycle: u64) -> Option<&Arc<Glimpse>> {
        let next = self.glimpses.partition_point(|glimpse| glimpse.picture.cycle < cycle);
        let around = [next.checked_sub(1), Some(next)].into_iter().flatten();
        let glimpses = around.filter_map(|index| self.glimpses.get(index));
        glimpses.min_by_key(|glimpse| glimpse.picture.cycle.abs_diff(cycle))
    }

    /// Cycles of the first and the last glimpse.
    pub fn range(&self) -> Option<(u64, u64)> {
        let cycle = |glimpse: &Arc<Glimpse>| glimpse.picture.cycle;
        Some((self.glimpses.first().map(cycle)?, self.glimpses.last().map(cycle)?))
    }
}

impl Picture {
    /// Whether it shows the activity of single sites.
    #[cfg(test)]
    fn shows_sites(&self) -> bool {
        self.bytes[4..8] != [0; 4]
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    fn glimpse(cycle: u64) -> Glimpse {
        Glimpse { picture: Picture::new(cycle, &[1.0, 2.0], &[3.0; 5]), signals: vec![0.5], since: vec![7] }
    }

    #[test]
    fn all_of_a_long_run_is_there_within_the_room_that_there_is() {
        let mut history = History::new(50);
        for cycle in (0..200_000).step_by(33) {
            history.keep(&glimpse(cycle));
            assert!(history.glimpses.len() <= 50);
        }
        let (first, last) = history.range().unwrap();
        assert!(first == 0 && last > 180_000, "{first} {last}");
        for asked in [0, 777, 100_000, 250_000] {
            let found = history.at(asked).unwrap();
            let nearest = history.glimpses.iter().map(|glimpse| glimpse.picture.cycle.abs_diff(asked)).min();
            assert_eq!(found.picture.cycle.abs_diff(asked), nearest.unwrap());
            assert!(!found.picture.shows_sites() && glimpse(0).picture.shows_sites());
        }
        assert!(History::new(10).at(5).is_none());
    }
}
