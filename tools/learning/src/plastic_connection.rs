/// How fast a connection follows its source, per cycle of a full peak of the newly achieved subgoal.
///
/// Chosen by hand: the target's peak lasts some 80 cycles, in which a new connection comes to more than 0.8, so that one
/// demonstration teaches. Not sensitive as long as one peak suffices.
const LEARNING_RATE: f64 = 0.03;
/// How fast the gate of a connection closes whose source is silent meanwhile, per cycle of the same peak.
///
/// Chosen by hand: several times [`LEARNING_RATE`], so that the gate is shut before the weight can follow again.
const PRUNING_RATE: f64 = 0.2;

/// One modifiable connection, from a memorised subgoal to a newly achieved one.
///
/// Correlation-based learning, gated by the target's transient peak c2 (Gerstner and Kistler 2002, chapter 10): the
/// weight follows the source's memory c1, as far as the `gate` lets it,
///
/// ```text
/// dw/dt = LEARNING_RATE c2 (gate c1 - w)        d gate/dt = -PRUNING_RATE c2 (1 - c1) gate
/// ```
///
/// A source that was silent when the target came about is no condition of it. One such demonstration is proof, and no
/// number of later ones in the other order may undo it: so the gate closes, and never opens again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PlasticConnection {
    pub weight: f64,
    gate: f64,
}

impl PlasticConnection {
    pub const NEW: Self = Self { weight: 0.0, gate: 1.0 };

    /// Learns for one cycle with the signals `memorised` = c1 of the source, `achieved` = c2 of the target.
    pub fn learn(&mut self, memorised: f64, achieved: f64) {
        self.weight += LEARNING_RATE * achieved * (self.gate * memorised - self.weight);
        self.gate -= PRUNING_RATE * achieved * (1.0 - memorised) * self.gate;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A transient peak as the fields make it: some 80 cycles.
    fn demonstrate(connection: &mut PlasticConnection, memorised: f64) {
        (0..80).for_each(|_| connection.learn(memorised, 0.9));
    }

    #[test]
    fn what_is_always_memorised_is_learned_from_the_first_time_on() {
        let mut connection = PlasticConnection::NEW;
        for _ in 0..50 {
            demonstrate(&mut connection, 1.0);
            assert!(connection.weight > 0.8);
        }
    }

    #[test]
    fn what_once_was_silent_is_never_learned_again() {
        let mut connection = PlasticConnection::NEW;
        demonstrate(&mut connection, 1.0);
        demonstrate(&mut connection, 0.0);
        assert!(connection.weight < 0.2, "{connection:?}");
        (0..1000).for_each(|_| demonstrate(&mut connection, 1.0));
        assert!(connection.weight < 0.01, "{connection:?}");
    }
}
