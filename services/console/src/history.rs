use crate::{Moment, Picture};
use std::sync::Arc;

/// The run so far, to go back through. It never holds more than so many moments: when it is full, every second one of them is
/// dropped, and from then on half as many are kept of what comes. So all of the run is there, as fine as there is room.
#[derive(Debug)]
pub struct History {
    moments: Vec<Arc<Moment>>,
    most: usize,
    /// From one moment that is kept to the next, cycles.
    spacing: u64,
}

/// From one moment to the next while there is room for all, cycles: ten a second.
const SPACING: u64 = 100;

impl History {
    /// An empty one for at most so many moments.
    pub fn new(most: usize) -> Self {
        Self { moments: Vec::new(), most: most.max(2), spacing: SPACING }
    }

    /// Keeps a moment, unless the one before was just now. Of one that is kept the activity of single sites is left out.
    pub fn keep(&mut self, moment: &Moment) {
        let cycle = moment.picture.cycle;
        if self.moments.last().is_some_and(|last| cycle < last.picture.cycle + self.spacing) {
            return;
        }
        if self.moments.len() >= self.most {
            let mut number = 0;
            self.moments.retain(|_| {
                number += 1;
                number % 2 == 1
            });
            self.spacing *= 2;
        }
        self.moments.push(Arc::new(Moment { picture: moment.picture.of_the_past(), ..moment.clone() }));
    }

    /// The moment that is nearest to `cycle`.
    pub fn at(&self, cycle: u64) -> Option<&Arc<Moment>> {
        let next = self.moments.partition_point(|moment| moment.picture.cycle < cycle);
        let around = [next.checked_sub(1), Some(next)].into_iter().flatten();
        let moments = around.filter_map(|index| self.moments.get(index));
        moments.min_by_key(|moment| moment.picture.cycle.abs_diff(cycle))
    }

    /// Cycles of the first and the last moment.
    pub fn range(&self) -> Option<(u64, u64)> {
        let cycle = |moment: &Arc<Moment>| moment.picture.cycle;
        Some((self.moments.first().map(cycle)?, self.moments.last().map(cycle)?))
    }

    /// The last moment.
    pub fn last(&self) -> Option<&Arc<Moment>> {
        self.moments.last()
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

    fn moment(cycle: u64) -> Moment {
        Moment { picture: Picture::new(cycle, &[1.0, 2.0], &[3.0; 5]), signals: vec![0.5], since: vec![7] }
    }

    #[test]
    fn all_of_a_long_run_is_there_within_the_room_that_there_is() {
        let mut history = History::new(50);
        for cycle in (0..200_000).step_by(33) {
            history.keep(&moment(cycle));
            assert!(history.moments.len() <= 50);
        }
        let (first, last) = history.range().unwrap();
        assert!(first == 0 && last > 180_000, "{first} {last}");
        for asked in [0, 777, 100_000, 250_000] {
            let found = history.at(asked).unwrap();
            let nearest = history.moments.iter().map(|moment| moment.picture.cycle.abs_diff(asked)).min();
            assert_eq!(found.picture.cycle.abs_diff(asked), nearest.unwrap());
            assert!(!found.picture.shows_sites() && moment(0).picture.shows_sites());
        }
        assert!(History::new(10).at(5).is_none());
    }
}
