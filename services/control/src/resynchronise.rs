//! Control goes on from where the drive is.

use crate::Control;
use coact_messages::{ARM_JOINTS, DriveMode, DriveReport, HoldReason, SensorSample};
use coact_robot::PathProgress;
use coact_stage_state::Flag;

/// Setpoints that differ by less are the same, rad: rounding.
const EXACT: f64 = 1e-9;
/// Fingers that differ by less go on in their movement, rad: in a bridged cycle they leave it by their jerk. Where they cannot,
/// the limiters say so.
const BRIDGED: f64 = 1e-6;

impl Control {
    /// Where the drive has not followed the last command, goes on from its setpoints: along the trajectory while they lie on
    /// it, else the joints brake, and movements begin anew from where they stand.
    pub(crate) fn resynchronise(&mut self, report: &DriveReport) {
        let own = self.servo.position();
        if report.position == own
            || !self.servo.resume(&report.position, &report.velocity, &report.acceleration)
        {
            return;
        }
        let arm = &mut self.state.arm;
        let here = arm.trajectory.posture(report.elapsed);
        if report.on_path == 1
            && !arm.braking.is_set()
            && is_near(&here, &report.position[..ARM_JOINTS], EXACT)
        {
            arm.progress = PathProgress {
                elapsed: report.elapsed,
                speed_override: report.speed_override,
                override_rate: report.override_rate,
            };
        } else if !is_near(&own[..ARM_JOINTS], &report.position[..ARM_JOINTS], EXACT) {
            arm.braking = Flag::Set;
        }
        if !is_near(&own[ARM_JOINTS..], &report.position[ARM_JOINTS..], BRIDGED) {
            self.state.fingers.braking = Flag::Set;
        }
    }
}

/// What the drive did in this cycle; none when that is not known, or nothing is driven.
pub(crate) fn report_of(tick: u64, sample: Option<&SensorSample>) -> Option<&DriveReport> {
    let report = sample.filter(|sample| sample.header.cycle == tick).map(|sample| &sample.drive)?;
    let numbers = report.position.iter().chain(&report.velocity).chain(&report.acceleration);
    let is_finite = numbers.chain([&report.elapsed]).all(|number| number.is_finite());
    let is_progress = report.elapsed >= 0.0
        && (0.0..=1.0).contains(&report.speed_override)
        && report.override_rate.is_finite();
    (report.mode != DriveMode::Absent as u32 && is_finite && is_progress).then_some(report)
}

/// Whether the drive follows no command now.
pub(crate) fn holds(report: &DriveReport) -> bool {
    report.hold != HoldReason::None as u32
}

fn is_near(one: &[f64], other: &[f64], most: f64) -> bool {
    one.iter().zip(other).all(|(one, other)| (one - other).abs() <= most)
}
