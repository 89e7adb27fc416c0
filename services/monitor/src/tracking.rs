use coact_messages::{ARM_JOINTS, Command};
use coact_run_records::TrackingReport;
use hdrhistogram::Histogram;

/// Resolution of the histogram, rad: far finer than the errors that matter, some mrad.
const UNIT: f64 = 1e-6;

/// How far the arm's joints were from their setpoints.
#[derive(Debug)]
pub struct Tracking {
    /// Largest error of a joint at each command that was seen, in [`UNIT`]s.
    largest: Histogram<u64>,
}

impl Tracking {
    /// Nothing seen yet.
    pub fn new() -> Self {
        Self { largest: crate::histogram() }
    }

    /// Adds one command's errors.
    pub fn command(&mut self, command: &Command) {
        let errors = command.tracking_error[..ARM_JOINTS].iter();
        let largest = errors.fold(0.0_f64, |largest, error| largest.max(error.abs()));
        self.largest.saturating_record((largest / UNIT).round() as u64);
    }

    /// The errors so far in short.
    pub fn report(&self) -> TrackingReport {
        let at = |quantile| self.largest.value_at_quantile(quantile) as f64 * UNIT;
        TrackingReport {
            count: self.largest.len(),
            p50: at(0.5),
            p99: at(0.99),
            max: self.largest.max() as f64 * UNIT,
        }
    }
}

impl Default for Tracking {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_joint_that_is_furthest_off_counts_whatever_its_sign() {
        let mut tracking = Tracking::new();
        assert_eq!(tracking.report(), TrackingReport::default());
        let mut command: Command = bytemuck::Zeroable::zeroed();
        command.tracking_error[2] = -0.25;
        command.tracking_error[3] = 0.01;
        command.tracking_error[ARM_JOINTS] = 0.7;
        tracking.command(&command);
        let report = tracking.report();
        assert_eq!(report.count, 1);
        assert!((report.max - 0.25).abs() < 0.25e-3 && (report.p50 - 0.25).abs() < 0.25e-3, "{report:?}");
    }
}
