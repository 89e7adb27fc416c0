/// How fast a connection grows or shrinks, per ms of a full peak of the newly achieved subgoal.
const LEARN: f64 = 0.03;
/// How fast a contact is lost whose source is silent meanwhile, per ms of the same.
const PRUNE: f64 = 0.2;

/// One modifiable connection, from a memorised subgoal to a newly achieved one.
///
/// Correlation-based learning, gated by the target's transient peak c2 (Gerstner and Kistler 2002, chapter 10): the
/// weight follows the source's memory c1, as far as the `contact` lets it,
///
/// ```text
/// dw/dt = LEARN c2 (contact c1 - w)        d contact/dt = -PRUNE c2 (1 - c1) contact
/// ```
///
/// A source that was silent when the target came about is no condition of it. One such demonstration is proof, and no
/// number of later ones in the other order may undo it: so the contact is pruned, and never grows again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Connection {
    pub weight: f64,
    contact: f64,
}

impl Connection {
    pub const NEW: Self = Self { weight: 0.0, contact: 1.0 };

    /// Learns for 1 ms with the signals `memorised` = c1 of the source, `achieved` = c2 of the target.
    pub fn learn(&mut self, memorised: f64, achieved: f64) {
        self.weight += LEARN * achieved * (self.contact * memorised - self.weight);
        self.contact -= PRUNE * achieved * (1.0 - memorised) * self.contact;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A transient peak as the fields make it: some 80 ms.
    fn demonstrate(connection: &mut Connection, memorised: f64) {
        (0..80).for_each(|_| connection.learn(memorised, 0.9));
    }

    #[test]
    fn what_is_always_memorised_is_learned_from_the_first_time_on() {
        let mut connection = Connection::NEW;
        for _ in 0..50 {
            demonstrate(&mut connection, 1.0);
            assert!(connection.weight > 0.8);
        }
    }

    #[test]
    fn what_once_was_silent_is_never_learned_again() {
        let mut connection = Connection::NEW;
        demonstrate(&mut connection, 1.0);
        demonstrate(&mut connection, 0.0);
        assert!(connection.weight < 0.2, "{connection:?}");
        (0..1000).for_each(|_| demonstrate(&mut connection, 1.0));
        assert!(connection.weight < 0.01, "{connection:?}");
    }
}
