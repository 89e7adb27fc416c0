/// For how long a goal stands until it counts as inferred for good, cycles.
const STANDS: u64 = 50;

/// The first goal that stood for 50 ms on the way to a grasp: an inference that nothing corrects later.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct FirstGoal {
    /// Population of IL that stands now, and since when, from the onset on.
    standing: Option<(usize, u64)>,
    /// The first population that stood for long enough.
    first: Option<usize>,
}

impl FirstGoal {
    /// Takes in which goal stands highest in this cycle.
    pub fn see(&mut self, now: u64, goal: Option<usize>) {
        let since =
            self.standing.filter(|(standing, _)| Some(*standing) == goal).map_or(now, |(_, since)| since);
        self.standing = goal.map(|goal| (goal, since));
        if self.first.is_none() && now - since + 1 >= STANDS {
            self.first = goal;
        }
    }

    /// Its population.
    pub fn goal(&self) -> Option<usize> {
        self.first
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(goals: &[(Option<usize>, u64)]) -> Option<usize> {
        let mut first = FirstGoal::default();
        let each = goals.iter().flat_map(|&(goal, cycles)| (0..cycles).map(move |_| goal));
        each.enumerate().for_each(|(now, goal)| first.see(now as u64, goal));
        first.goal()
    }

    #[test]
    fn what_has_stood_for_50_ms_is_corrected_by_nothing() {
        assert_eq!(seen(&[(None, 100), (Some(7), 50), (Some(3), 200)]), Some(7));
        assert_eq!(seen(&[(Some(3), 50), (Some(7), 200)]), Some(3));
        assert_eq!(seen(&[(Some(3), 49), (Some(7), 60)]), Some(7));
        assert_eq!(seen(&[(Some(7), 30), (None, 1), (Some(7), 49)]), None);
    }
}
