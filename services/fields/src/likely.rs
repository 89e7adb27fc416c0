use crate::due_kinds::Beforehand;
use coact_messages::Destinations;

/// Where a hand may go, by its movement and by what was likely before it (Bayes).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Likely<'a> {
    pub destinations: &'a Destinations,
    pub beforehand: &'a Beforehand,
}

impl<'a> Likely<'a> {
    /// Kind and place (m) of each destination, and how well it fits.
    pub fn iter(self) -> impl Iterator<Item = (Option<usize>, [f64; 2], f64)> + 'a {
        self.destinations.iter().map(move |(kind, place, fit)| (kind, place, fit * self.beforehand.of(kind)))
    }
}
