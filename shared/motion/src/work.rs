use std::cell::Cell;

/// What a search may still do, counted in postures that are held against the surroundings: a bound on its time that
/// does not depend on the machine, so that the same problem ends the same way everywhere.
#[derive(Debug)]
pub(crate) struct Work {
    left: Cell<u32>,
}

impl Work {
    /// So many postures.
    pub fn of(postures: u32) -> Self {
        Self { left: Cell::new(postures) }
    }

    /// Takes some of them; false when nothing is left to be done with.
    pub fn spend(&self, postures: u32) -> bool {
        let left = self.left.get();
        self.left.set(left.saturating_sub(postures));
        left > 0
    }

    /// Whether all of it is done.
    pub fn is_done(&self) -> bool {
        self.left.get() == 0
    }
}
