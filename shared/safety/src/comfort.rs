use serde::Deserialize;

/// How fast the robot moves beside the people who work with it: what one is used to worries another.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Comfort {
    /// At full speed.
    Brisk,
    /// At three quarters of it.
    Normal,
    /// At half of it.
    Gentle,
}

impl Comfort {
    /// Fraction of the hand's speeds that is used.
    pub fn fraction(self) -> f64 {
        match self {
            Self::Brisk => 1.0,
            Self::Normal => 0.75,
            Self::Gentle => 0.5,
        }
    }
}
