use crate::{Posture, RobotError};
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// A robot file: what a URDF does not say.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Config {
    /// URDF file, beside this one.
    pub urdf: PathBuf,
    /// Link that is the palm frame.
    pub palm: String,
    pub arm: ArmConfig,
    pub hand: HandConfig,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ArmConfig {
    pub joints: [String; 7],
    /// Of planned movements, rad/s².
    pub acceleration: [f64; 7],
    /// Of planned movements, rad/s³.
    pub jerk: [f64; 7],
    /// What the joints can bear at most, rad/s².
    pub most_acceleration: [f64; 7],
    /// Likewise, rad/s³.
    pub most_jerk: [f64; 7],
    /// rad.
    pub park: Posture,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct HandConfig {
    pub spread: String,
    pub bases: [String; 3],
    pub tips: [String; 3],
    /// Links at the finger ends.
    pub ends: [String; 3],
    /// rad/s².
    pub acceleration: f64,
    /// rad/s³.
    pub jerk: f64,
    /// rad.
    pub grasp_spread: f64,
    /// m.
    pub pad: [f64; 2],
    /// m.
    pub grasp_distance: f64,
}

impl Config {
    pub(crate) fn load(path: &Path) -> Result<Self, RobotError> {
        let text = coact_input_file::read_text(path)
            .map_err(|reason| RobotError::File { path: path.to_path_buf(), reason })?;
        let config: Self = toml::from_str(&text).map_err(|error| RobotError::Malformed {
            path: path.to_path_buf(),
            line: error.span().map(|span| 1 + text[..span.start].matches('\n').count()),
            message: format!("{}; see rt-config/robots/aros.toml for all keys", error.message()),
        })?;
        config.check(path)?;
        Ok(config)
    }

    fn check(&self, path: &Path) -> Result<(), RobotError> {
        let positive = |values: &[f64]| values.iter().all(|value| value.is_finite() && *value > 0.0);
        if !positive(&self.arm.acceleration) || !positive(&[self.hand.acceleration]) {
            return Err(Self::fault(path, "acceleration", "expected limits above zero, rad/s²"));
        }
        if !positive(&self.arm.jerk) || !positive(&[self.hand.jerk]) {
            return Err(Self::fault(path, "jerk", "expected limits above zero, rad/s³"));
        }
        let beyond = |most: &[f64; 7], planned: &[f64; 7]| {
            most.iter().zip(planned).all(|(most, own)| most >= own && most.is_finite())
        };
        if !beyond(&self.arm.most_acceleration, &self.arm.acceleration) {
            return Err(Self::fault(path, "most_acceleration", "expected no less than acceleration, rad/s²"));
        }
        if !beyond(&self.arm.most_jerk, &self.arm.jerk) {
            return Err(Self::fault(path, "most_jerk", "expected no less than jerk, rad/s³"));
        }
        if !positive(&[self.hand.grasp_distance]) {
            return Err(Self::fault(path, "grasp_distance", "expected a length above zero, m"));
        }
        Ok(())
    }

    pub(crate) fn fault(path: &Path, key: &str, message: &str) -> RobotError {
        let text = coact_input_file::read_text(path).unwrap_or_default();
        let line = text.lines().position(|line| line.trim_start().starts_with(key)).map(|index| index + 1);
        RobotError::Malformed { path: path.to_path_buf(), line, message: format!("key \"{key}\": {message}") }
    }
}
