/// How long a target is exercised, and what one input may cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// For so long, s; every seed is run unchanged in any case.
    pub seconds: f64,
    /// Seed of the random changes.
    pub seed: u64,
    /// Longest input, bytes.
    pub longest: usize,
    /// Most memory that an input may take at a time, bytes.
    pub memory: u64,
    /// Most time of the processor that an input may take, s: so a machine that is busy with something else does not count.
    pub processor: f64,
}

impl Default for Bounds {
    /// A second; inputs of up to 128 KiB, twenty times the files that are shipped, which may take 256 MiB and 2 s: far more than
    /// any of them needs, far less than whoever waits for a refusal would notice as a fault of the machine.
    fn default() -> Self {
        Self { seconds: 1.0, seed: 1, longest: 128 << 10, memory: 256 << 20, processor: 2.0 }
    }
}
