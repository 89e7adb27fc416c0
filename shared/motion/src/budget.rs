use std::cell::Cell;

/// What a search may still do, counted in postures whose clearance is computed. It bounds the search's time without
/// reading a clock, so that the same problem ends the same way on every machine.
#[derive(Debug)]
pub(crate) struct Budget {
    left: Cell<u32>,
    of: u32,
}

/// Postures that a search looks at in a second, about.
const POSTURES_PER_S: f64 = 40_000.0;

impl Budget {
    /// So many postures.
    pub fn of(postures: u32) -> Self {
        Self { left: Cell::new(postures), of: postures }
    }

    /// Takes some of them; false when none was left before.
    pub fn spend(&self, postures: u32) -> bool {
        let left = self.left.get();
        self.left.set(left.saturating_sub(postures));
        left > 0
    }

    /// For how long the search has gone on, about, s.
    pub fn spent_s(&self) -> f64 {
        f64::from(self.of - self.left.get()) / POSTURES_PER_S
    }

    /// Whether all of them are spent.
    pub fn is_spent(&self) -> bool {
        self.left.get() == 0
    }
}
