use crate::checkout;
use coact_messages::{ARM_JOINTS, DriveMode, DriveReport, HoldReason, SensorSample, topic};
use coact_pipeline::Run;
use coact_realtime::{Bus, Input};
use coact_robot::{JointLimits, Robot};
use std::time::{Duration, Instant};

/// A joint of the arm this fast moves in earnest, rad/s.
const FAST: f64 = 0.4;
/// A stopped arm stays where it stands within this, rad.
const STAYS: f64 = 1e-3;
/// How much longer than the accelerations' limit says one may be by rounding.
const ROUNDING: f64 = 1.001;
/// How long a stopped arm is watched: it would move within a fraction of that.
const WATCHED: Duration = Duration::from_secs(2);
/// Within so long whatever is waited for happens, on a busy machine too.
const SOON: Duration = Duration::from_secs(40);

/// Watches a set's joints as a viewer.
pub struct JointViewer {
    // Before the bus that it was opened on.
    samples: Input<SensorSample>,
    _bus: Bus,
    limits: Vec<JointLimits>,
}

impl JointViewer {
    /// Joins the run.
    pub fn join(run: &Run) -> Self {
        let bus = Bus::open(run, "viewer", 0).unwrap();
        let limits = Robot::load(&checkout().join("rt-config/robots/aros.toml")).unwrap().limits().to_vec();
        Self { samples: bus.input(topic::SENSORS).unwrap(), _bus: bus, limits }
    }

    /// Looks at each sample until one satisfies; all of them keep the limits.
    ///
    /// # Panics
    /// None does for a while, or one does not keep them; `what` says what was waited for.
    pub fn until(&mut self, what: &str, satisfies: impl Fn(&SensorSample) -> bool) -> SensorSample {
        let (begin, limits, mut found) = (Instant::now(), self.limits.clone(), None);
        while found.is_none() {
            assert!(begin.elapsed() < SOON, "timed out: {what}");
            self.samples
                .each(|sample| {
                    keeps(&limits, &sample.drive);
                    found = found.or_else(|| satisfies(sample).then_some(*sample));
                })
                .unwrap();
            std::thread::sleep(Duration::from_millis(1));
        }
        found.unwrap()
    }

    /// Until the arm moves in earnest.
    pub fn until_fast(&mut self) {
        self.until("a fast arm", |sample| speed(&sample.drive) > FAST);
    }

    /// Until it stands because it must; returns how.
    pub fn until_it_stands(&mut self) -> SensorSample {
        self.until("an arm that stands", |sample| {
            sample.drive.mode == DriveMode::Standing as u32 && sample.drive.hold == HoldReason::Stopped as u32
        })
    }

    /// Watches for a while that the arm stays where it was.
    ///
    /// # Panics
    /// It does not, or nothing is seen.
    pub fn sees_it_stay(&mut self, stood: &SensorSample) {
        let (begin, mut seen) = (Instant::now(), 0);
        while begin.elapsed() < WATCHED {
            self.samples
                .each(|sample| {
                    seen += 1;
                    for joint in 0..ARM_JOINTS {
                        let moved = (sample.joints.position[joint] - stood.joints.position[joint]).abs();
                        assert!(moved < STAYS, "joint {joint} has moved by {moved} rad: {:?}", sample.drive);
                    }
                })
                .unwrap();
            std::thread::sleep(Duration::from_millis(1));
        }
        assert!(seen > 0, "no sample came");
    }
}

fn speed(report: &DriveReport) -> f64 {
    report.velocity[..ARM_JOINTS].iter().fold(0.0, |most: f64, speed| most.max(speed.abs()))
}

fn keeps(limits: &[JointLimits], report: &DriveReport) {
    for (joint, limits) in limits[..ARM_JOINTS].iter().enumerate() {
        assert!(report.velocity[joint].abs() <= limits.velocity, "joint {joint}: {report:?}");
        let most = ROUNDING * limits.acceleration;
        assert!(report.acceleration[joint].abs() <= most, "joint {joint}: {report:?}");
    }
}
