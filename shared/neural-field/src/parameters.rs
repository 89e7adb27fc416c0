use crate::Kernel;

/// Constants of one field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parameters {
    /// Time scale tau, in the unit of the step (coact: ms). Steps of at most a twentieth of it follow the equation closely
    /// for slopes of about 5; slopes above 100 need steps of a fiftieth.
    pub tau: f64,
    /// Slope beta of the sigmoid (chapter, eq. 3).
    pub slope: f64,
    /// Threshold u0 of the sigmoid: activation at which a site takes part in the interaction.
    pub threshold: f64,
    /// Distance of two sites, dx.
    pub spacing: f64,
    /// Standard deviation of the Gaussian input to a population (chapter, eq. 4).
    pub input_sigma: f64,
    /// Lateral interaction.
    pub kernel: Kernel,
}

/// A constant with which no field can be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{name} is {value}; expected {expected}")]
pub struct ParameterError {
    /// Name of the constant.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
    /// What it must be.
    pub expected: &'static str,
}

impl ParameterError {
    /// Refuses what is not a finite number above 0.
    pub(crate) fn unless_positive(name: &'static str, value: f64) -> Result<(), Self> {
        let expected = "a finite number above 0";
        if value > 0.0 && value.is_finite() { Ok(()) } else { Err(Self { name, value, expected }) }
    }

    /// Refuses what is not a finite number.
    pub(crate) fn unless_finite(name: &'static str, value: f64) -> Result<(), Self> {
        if value.is_finite() { Ok(()) } else { Err(Self { name, value, expected: "a finite number" }) }
    }
}

/// No kernel or input is wider, sites: as many as a field frame holds in all. Memory is taken in proportion.
const WIDEST: f64 = 1e4;

impl Parameters {
    /// Checks that a field of these constants is well defined.
    ///
    /// # Errors
    /// The first constant that is out of its range.
    pub fn check(&self) -> Result<(), ParameterError> {
        let Kernel { amplitude, sigma, inhibition, range } = self.kernel;
        let range = range.unwrap_or(0.0);
        for (name, value) in [
            ("tau", self.tau),
            ("slope", self.slope),
            ("spacing", self.spacing),
            ("input_sigma", self.input_sigma),
            ("kernel sigma", sigma),
        ] {
            ParameterError::unless_positive(name, value)?;
        }
        for (name, value) in [("amplitude", amplitude), ("inhibition", inhibition), ("range", range)] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(ParameterError { name, value, expected: "a finite number, at least 0" });
            }
        }
        for (name, value) in [("kernel sigma", sigma), ("range", range), ("input_sigma", self.input_sigma)] {
            if value > WIDEST * self.spacing {
                return Err(ParameterError { name, value, expected: "at most 10000 times the spacing" });
            }
        }
        ParameterError::unless_finite("threshold", self.threshold)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kernel_wider_than_any_field_is_refused_before_memory_is_taken_for_it() {
        let kernel = Kernel { amplitude: 3.0, sigma: 2.0, inhibition: 1.0, range: Some(6.0) };
        let good =
            Parameters { tau: 20.0, slope: 5.0, threshold: 0.0, spacing: 0.5, input_sigma: 2.0, kernel };
        assert_eq!(good.check(), Ok(()));
        let far = Parameters { kernel: Kernel { range: Some(4_294_967_296.0), ..kernel }, ..good };
        assert_eq!(far.check().map_err(|error| error.name), Err("range"));
        let fine = Parameters { spacing: 1e-9, ..good };
        assert_eq!(fine.check().map_err(|error| error.name), Err("kernel sigma"));
    }
}
