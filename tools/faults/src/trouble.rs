/// Why a cell cannot be judged.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Trouble(pub String);

impl Trouble {
    /// From an error of another kind, and what was attempted.
    pub(crate) fn because(what: &str) -> impl FnOnce(&dyn std::error::Error) -> Self {
        let what = what.to_owned();
        move |error| Self(format!("{what}: {error}"))
    }
}
