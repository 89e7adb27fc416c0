//! From the text of the file to [`SafetyLimits`], with the place of every mistake.

use crate::range::{Fault, within};
use crate::{Comfort, DriveLimits, GuardLimits, PersonLimits, PlannerLimits, SafetyLimits, StaleLimits};
use serde::Deserialize;
use std::time::Duration;
use toml::Spanned;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SafetyFile {
    person: PersonTable,
    guard: GuardTable,
    planner: PlannerTable,
    stale: StaleTable,
    drive: DriveTable,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PersonTable {
    upper_arm_radius_m: Spanned<f64>,
    forearm_radius_m: Spanned<f64>,
    hand_radius_m: Spanned<f64>,
    hand_length_m: Spanned<f64>,
    upper_arm_reach_m: Spanned<f64>,
    forearm_reach_m: Spanned<f64>,
    hand_reach_m: Spanned<f64>,
    reach_m: Spanned<f64>,
    head_radius_m: Spanned<f64>,
    head_height_m: Spanned<f64>,
    carried_within_m: Spanned<f64>,
    extrapolated_ms: Spanned<u64>,
    hand_speed_mps: Spanned<f64>,
    walking_speed_mps: Spanned<f64>,
    rests_after_ms: Spanned<u64>,
    rest_acceleration_mps2: Spanned<f64>,
    slow_acceleration_mps2: Spanned<f64>,
    moving_from_mps: Spanned<f64>,
    moving_acceleration_mps2: Spanned<f64>,
    fast_from_mps: Spanned<f64>,
    fast_acceleration_mps2: Spanned<f64>,
    velocity_lag_ms: Spanned<u64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct GuardTable {
    protective_separation_m: Spanned<f64>,
    contact_speed_mps: Spanned<f64>,
    hysteresis_m: Spanned<f64>,
    quickening_per_s: Spanned<f64>,
    blocked_override: Spanned<f64>,
    blocked_ms: Spanned<u64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PlannerTable {
    comfort: Comfort,
    hand_speed_mps: Spanned<f64>,
    path_clearance_m: Spanned<f64>,
    goal_clearance_m: Spanned<f64>,
    insertion_clearance_m: Spanned<f64>,
    beyond_guard_m: Spanned<f64>,
    person_ahead_ms: Spanned<u64>,
    withdraw_within_m: Spanned<f64>,
    withdraw_distance_m: Spanned<f64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StaleTable {
    input_after_ms: Spanned<u64>,
    hand_after_ms: Spanned<u64>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct DriveTable {
    command_after_ms: Spanned<u64>,
    driver_late_after_ms: Spanned<u64>,
    tracking_error_rad: Spanned<f64>,
    tracking_error_after_ms: Spanned<u64>,
    stop_unheard_after_ms: Spanned<u64>,
}

pub(crate) fn parse(text: &str) -> Result<SafetyLimits, Fault> {
    let file: SafetyFile = toml::from_str(text).map_err(|error| Fault {
        at: error.span().map_or(0, |span| span.start),
        problem: format!("{}; expected every key of rt-config/safety.toml, and no other", error.message()),
    })?;
    Ok(SafetyLimits {
        person: file.person.limits()?,
        guard: file.guard.limits()?,
        planner: file.planner.limits()?,
        stale: file.stale.limits()?,
        drive: file.drive.limits()?,
    })
}

impl PersonTable {
    fn limits(&self) -> Result<PersonLimits, Fault> {
        Ok(PersonLimits {
            radii: [
                within("upper_arm_radius_m", &self.upper_arm_radius_m, 0.01..=0.3)?,
                within("forearm_radius_m", &self.forearm_radius_m, 0.01..=0.3)?,
                within("hand_radius_m", &self.hand_radius_m, 0.01..=0.3)?,
            ],
            hand_length: within("hand_length_m", &self.hand_length_m, 0.05..=0.4)?,
            upper_arm_reach: within("upper_arm_reach_m", &self.upper_arm_reach_m, 0.1..=1.0)?,
            forearm_reach: within("forearm_reach_m", &self.forearm_reach_m, 0.1..=1.0)?,
            hand_reach: within("hand_reach_m", &self.hand_reach_m, 0.05..=0.5)?,
            reach: within("reach_m", &self.reach_m, 0.2..=1.5)?,
            head_radius: within("head_radius_m", &self.head_radius_m, 0.05..=1.0)?,
            head_height: within("head_height_m", &self.head_height_m, 0.0..=1.0)?,
            carried_within: within("carried_within_m", &self.carried_within_m, 0.0..=0.3)?,
            extrapolated: milliseconds("extrapolated_ms", &self.extrapolated_ms, 0..=2000)?,
            hand_speed: within("hand_speed_mps", &self.hand_speed_mps, 0.1..=10.0)?,
            walking_speed: within("walking_speed_mps", &self.walking_speed_mps, 0.1..=10.0)?,
            rests_after: milliseconds("rests_after_ms", &self.rests_after_ms, 0..=10_000)?,
            accelerations: [
                within("rest_acceleration_mps2", &self.rest_acceleration_mps2, 0.0..=100.0)?,
                within("slow_acceleration_mps2", &self.slow_acceleration_mps2, 0.0..=100.0)?,
                within("moving_acceleration_mps2", &self.moving_acceleration_mps2, 0.0..=100.0)?,
                within("fast_acceleration_mps2", &self.fast_acceleration_mps2, 0.0..=100.0)?,
            ],
            speeds: [
                within("moving_from_mps", &self.moving_from_mps, 0.0..=10.0)?,
                within("fast_from_mps", &self.fast_from_mps, 0.0..=10.0)?,
            ],
            velocity_lag: milliseconds("velocity_lag_ms", &self.velocity_lag_ms, 0..=200)?,
        })
    }
}

impl GuardTable {
    fn limits(&self) -> Result<GuardLimits, Fault> {
        Ok(GuardLimits {
            protective_separation: within(
                "protective_separation_m",
                &self.protective_separation_m,
                0.0..=1.0,
            )?,
            contact_speed: within("contact_speed_mps", &self.contact_speed_mps, 0.0..=1.0)?,
            hysteresis: within("hysteresis_m", &self.hysteresis_m, 0.0..=0.1)?,
            quickening: within("quickening_per_s", &self.quickening_per_s, 0.1..=100.0)?,
            blocked_override: within("blocked_override", &self.blocked_override, 0.0..=1.0)?,
            blocked: milliseconds("blocked_ms", &self.blocked_ms, 1..=10_000)?,
        })
    }
}

impl PlannerTable {
    fn limits(&self) -> Result<PlannerLimits, Fault> {
        Ok(PlannerLimits {
            comfort: self.comfort,
            hand_speed: within("hand_speed_mps", &self.hand_speed_mps, 0.1..=2.0)?,
            path_clearance: within("path_clearance_m", &self.path_clearance_m, 0.0..=0.5)?,
            goal_clearance: within("goal_clearance_m", &self.goal_clearance_m, 0.0..=0.5)?,
            insertion_clearance: within("insertion_clearance_m", &self.insertion_clearance_m, 0.0..=0.5)?,
            beyond_guard: within("beyond_guard_m", &self.beyond_guard_m, 0.0..=0.5)?,
            person_ahead: milliseconds("person_ahead_ms", &self.person_ahead_ms, 0..=2000)?,
            withdraw_within: within("withdraw_within_m", &self.withdraw_within_m, 0.0..=1.0)?,
            withdraw_distance: within("withdraw_distance_m", &self.withdraw_distance_m, 0.01..=0.5)?,
        })
    }
}

impl StaleTable {
    fn limits(&self) -> Result<StaleLimits, Fault> {
        Ok(StaleLimits {
            input_after: milliseconds("input_after_ms", &self.input_after_ms, 1..=1000)?,
            hand_after: milliseconds("hand_after_ms", &self.hand_after_ms, 1..=150)?,
        })
    }
}

impl DriveTable {
    fn limits(&self) -> Result<DriveLimits, Fault> {
        Ok(DriveLimits {
            command_after: milliseconds("command_after_ms", &self.command_after_ms, 1..=4)?,
            driver_late_after: milliseconds("driver_late_after_ms", &self.driver_late_after_ms, 1..=20)?,
            tracking_error: within("tracking_error_rad", &self.tracking_error_rad, 0.01..=1.0)?,
            tracking_error_after: milliseconds(
                "tracking_error_after_ms",
                &self.tracking_error_after_ms,
                1..=1000,
            )?,
            stop_unheard_after: milliseconds(
                "stop_unheard_after_ms",
                &self.stop_unheard_after_ms,
                50..=5000,
            )?,
        })
    }
}

fn milliseconds(
    key: &str,
    value: &Spanned<u64>,
    range: std::ops::RangeInclusive<u64>,
) -> Result<Duration, Fault> {
    Ok(Duration::from_millis(within(key, value, range)?))
}
