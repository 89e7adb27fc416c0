use crate::ParameterError;

/// Constants of a metric field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MetricConstants {
    /// Time scale tau, in the unit of the step (coact: ms).
    pub tau: f64,
    /// Slope beta of the sigmoid (chapter, eq. 3).
    pub slope: f64,
    /// Threshold u0 of the sigmoid.
    pub threshold: f64,
}

impl MetricConstants {
    /// Checks that a field of these constants is well defined.
    ///
    /// # Errors
    /// The first constant that is out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        let Self { tau, slope, threshold } = *self;
        ParameterError::unless_positive("tau", tau)?;
        ParameterError::unless_positive("slope", slope)?;
        ParameterError::unless_finite("threshold", threshold)
    }
}
