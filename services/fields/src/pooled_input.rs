use coact_joint_task::Pool;

/// What the sources that one rule finds for one target have sent, in one step.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PooledInput {
    sources: u32,
    strongest: f64,
    weakest: f64,
}

impl PooledInput {
    pub(crate) const NOTHING: Self = Self { sources: 0, strongest: 0.0, weakest: f64::INFINITY };

    /// Whether no source has sent anything.
    pub(crate) fn is_nothing(&self) -> bool {
        self.sources == 0
    }

    /// Takes in the signal of a source that is not silent.
    pub(crate) fn add(&mut self, signal: f64) {
        self.sources += 1;
        self.strongest = self.strongest.max(signal);
        self.weakest = self.weakest.min(signal);
    }

    /// What all of them count as, where the rule finds so many `sources`; where each is pooled alone, there is but one.
    pub(crate) fn counts(self, pool: Pool, sources: u32) -> f64 {
        match pool {
            Pool::Every if self.sources < sources => 0.0,
            Pool::Every => self.weakest,
            Pool::Any | Pool::Sum => self.strongest,
            Pool::Absent => f64::from(sources) - self.strongest,
        }
    }
}
