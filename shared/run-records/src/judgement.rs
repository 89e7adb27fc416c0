use serde::{Deserialize, Serialize};

/// Whether a run reached what `verdict.toml` asks for, in one respect.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub struct Judgement {
    /// "pass" when every rule was kept.
    pub verdict: Verdict,
    /// Why not "pass": one sentence for each rule that was broken.
    pub reasons: Vec<String>,
}

/// Whether every rule was kept.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// Every rule was kept.
    #[default]
    Pass,
    /// At least one rule was broken.
    Fail,
}

impl Judgement {
    /// From one sentence for each rule that was broken.
    pub fn new(reasons: Vec<String>) -> Self {
        let verdict = if reasons.is_empty() { Verdict::Pass } else { Verdict::Fail };
        Self { verdict, reasons }
    }

    /// Every rule was kept.
    pub fn passes(&self) -> bool {
        self.verdict == Verdict::Pass
    }
}
