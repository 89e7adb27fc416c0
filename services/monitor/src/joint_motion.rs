use coact_messages::{ARM_JOINTS, JointReading, Pulse, SensorSample};
use coact_period::{PERIOD_NS, cycles, seconds};
use coact_robot::JointLimits;
use coact_run_records::{JointMoment, MotionReport};
use std::collections::VecDeque;
use std::time::Duration;

/// Speed and acceleration are means of so many cycles: the encoders scatter by 1 mrad/s, which would make the acceleration
/// between two single readings uncertain by 1.4 rad/s². Between two such means it is 0.05, half a percent of the limits.
const MEAN: usize = cycles(Duration::from_millis(10)) as usize;
/// A joint whose mean speed is below this stands, rad/s: thirty times the scatter of the means.
const STANDING: f64 = 0.01;

/// Measures at the joints how the arm moves: against its limits, and on which data.
#[derive(Debug)]
pub struct JointMotion {
    /// Of the arm's joints.
    limits: Vec<JointLimits>,
    /// How old a sample may be that a good command descends from.
    fresh_ns: u64,
    /// Velocities of the newest consecutive samples, the newest last: of two means.
    velocities: VecDeque<[f64; ARM_JOINTS]>,
    last_cycle: Option<u64>,
    /// Commands that are younger than the newest sample: publication, and stamp of the sample that they descend from.
    commands: VecDeque<(u64, u64)>,
    /// Stamp of the sample that the newest older command descends from; 0 before there was one.
    data_ns: u64,
    report: MotionReport,
}

impl JointMotion {
    /// For an arm with these limits, which does not move on data older than `fresh`.
    pub fn new(limits: Vec<JointLimits>, fresh: Duration) -> Self {
        Self {
            limits,
            fresh_ns: fresh.as_nanos() as u64,
            velocities: VecDeque::with_capacity(2 * MEAN),
            last_cycle: None,
            commands: VecDeque::new(),
            data_ns: 0,
            report: MotionReport::default(),
        }
    }

    /// Goes on after a restart from what was found before.
    pub fn resume(&mut self, found: MotionReport) {
        self.last_cycle = (found.samples + found.unseen).checked_sub(1);
        self.report = found;
    }

    /// A cycle of the process that commands the arm.
    pub fn commanded(&mut self, pulse: &Pulse) {
        self.commands.push_back((pulse.header.published_ns, pulse.header.sensor_ns));
    }

    /// What the sensors say, in the order of the cycles; one that was seen already changes nothing.
    pub fn sample(&mut self, sample: &SensorSample) {
        let cycle = sample.header.cycle;
        if self.last_cycle.is_some_and(|last| cycle <= last) {
            return;
        }
        let unseen = cycle - self.last_cycle.map_or(0, |last| last + 1);
        if unseen > 0 {
            self.velocities.clear();
        }
        self.last_cycle = Some(cycle);
        self.report.samples += 1;
        self.report.unseen += unseen;
        if self.velocities.len() == 2 * MEAN {
            self.velocities.pop_front();
        }
        self.velocities.push_back(std::array::from_fn(|joint| sample.joints.velocity[joint]));
        self.positions(&sample.joints);
        self.staleness(sample.header.sensor_ns);
        if self.velocities.len() == 2 * MEAN {
            self.speeds(cycle);
        }
    }

    /// What was found so far.
    pub fn report(&self) -> MotionReport {
        self.report
    }

    fn positions(&mut self, joints: &JointReading) {
        for (limits, position) in self.limits.iter().zip(joints.position) {
            let beyond = (position - limits.upper).max(limits.lower - position);
            self.report.beyond_position_rad = self.report.beyond_position_rad.max(beyond);
        }
    }

    fn speeds(&mut self, cycle: u64) {
        for (joint, limits) in self.limits.iter().enumerate() {
            let (before, now) = (self.mean(0, joint), self.mean(MEAN, joint));
            let acceleration = (now - before) / seconds(MEAN as u64);
            let here = JointMoment { joint: joint + 1, s: seconds(cycle) };
            let report = &mut self.report;
            exceed((&mut report.speed, &mut report.speed_at), now.abs() / limits.velocity, here);
            let fraction = acceleration.abs() / limits.acceleration;
            exceed((&mut report.acceleration, &mut report.acceleration_at), fraction, here);
        }
    }

    /// How long ago the newest command's data became too old, if the arm still moves.
    fn staleness(&mut self, now_ns: u64) {
        while self.commands.front().is_some_and(|(published_ns, _)| *published_ns <= now_ns)
            && let Some((_, data_ns)) = self.commands.pop_front()
        {
            self.data_ns = self.data_ns.max(data_ns);
        }
        let old_for_ns = now_ns.saturating_sub(self.data_ns).saturating_sub(self.fresh_ns);
        if self.data_ns > 0 && old_for_ns > 0 && self.moves() {
            let report = &mut self.report;
            report.on_stale_data_ms = report.on_stale_data_ms.max(old_for_ns / PERIOD_NS);
        }
    }

    fn moves(&self) -> bool {
        let newest = self.velocities.len().saturating_sub(MEAN);
        newest > 0 && (0..self.limits.len()).any(|joint| self.mean(newest, joint).abs() > STANDING)
    }

    /// Mean velocity of a joint over [`MEAN`] cycles.
    fn mean(&self, from: usize, joint: usize) -> f64 {
        self.velocities.range(from..from + MEAN).map(|velocity| velocity[joint]).sum::<f64>() / MEAN as f64
    }
}

/// Keeps the larger value, and where it was found.
fn exceed((most, at): (&mut f64, &mut JointMoment), found: f64, here: JointMoment) {
    if found > *most {
        (*most, *at) = (found, here);
    }
}
