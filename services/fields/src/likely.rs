use crate::due_kinds::Beforehand;
use coact_messages::{Destinations, MAX_KINDS};

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

    /// How well all fit together, and how many kinds could be taken: each kind counts once, however many of its parts lie there, and so does that
    /// nothing is taken.
    pub fn all(self) -> (f64, usize) {
        let mut of_kind = [None; MAX_KINDS];
        let mut nothing = 0.0_f64;
        for (kind, _, fit) in self.iter() {
            match kind {
                Some(kind) => of_kind[kind] = Some(of_kind[kind].map_or(fit, |best: f64| best.max(fit))),
                None => nothing = nothing.max(fit),
            }
        }
        let known = || of_kind.iter().copied().flatten();
        (nothing + known().sum::<f64>(), known().count())
    }
}
