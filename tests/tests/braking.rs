//! Whatever breaks, the arm brakes within its limits and stands.
#![allow(clippy::unwrap_used)]

use coact_messages::{ARM_JOINTS, DriveMode, DriveReport, SensorSample, topic};
use coact_pipeline::Run;
use coact_robot::Robot;
use coact_tests::{Launched, checkout, wait_for};
use iceoryx2::port::subscriber::Subscriber;
use iceoryx2::prelude::*;
use rustix::process::{Pid, Signal, test_kill_process};
use std::time::{Duration, Instant};

/// A joint of the arm this fast moves in earnest, rad/s.
const FAST: f64 = 0.4;
/// How long the driver may go on after its supervisor's death: a second of braking, and some for a busy machine.
const LONGEST_END: Duration = Duration::from_secs(3);

/// A joint that stands at its limit is read so far beyond it, rad: six times what encoders scatter by.
const SCATTER: f64 = 1.2e-4;

/// Reads the sensor samples as any program can.
struct Viewer {
    samples: Subscriber<ipc::Service, SensorSample, ()>,
    _node: Node<ipc::Service>,
}

impl Viewer {
    fn join(run: &Run) -> Self {
        let file = run.directory().join("config/iceoryx2.toml");
        let config = Config::from_file(&FilePath::new(file.as_os_str().as_encoded_bytes()).unwrap()).unwrap();
        let node = NodeBuilder::new().config(&config).create::<ipc::Service>().unwrap();
        let name = ServiceName::new(topic::SENSORS).unwrap();
        let service = node.service_builder(&name).publish_subscribe::<SensorSample>().open().unwrap();
        Self { samples: service.subscriber_builder().create().unwrap(), _node: node }
    }

    fn newest(&self) -> Option<DriveReport> {
        std::iter::from_fn(|| self.samples.receive().unwrap()).map(|sample| sample.drive).last()
    }
}

fn speed(report: &DriveReport) -> f64 {
    report.velocity[..ARM_JOINTS].iter().fold(0.0, |most: f64, speed| most.max(speed.abs()))
}

#[test]
fn the_arm_brakes_and_stands_when_the_supervisor_is_killed_while_it_moves() {
    let mut launched = Launched::start(&["--duration", "60", "--world", "kinematic"]);
    let run = launched.when_started();
    let world = Pid::from_raw(run.ready("world", 0).unwrap().unwrap().pid.cast_signed()).unwrap();
    let viewer = Viewer::join(&run);
    wait_for("a fast arm", || viewer.newest().filter(|report| speed(report) > FAST));
    launched.signal(Signal::KILL);
    let limits = Robot::load(&checkout().join("rt-config/robots/aros.toml")).unwrap().limits();
    let (killed, mut last) = (Instant::now(), None);
    while test_kill_process(world).is_ok() && killed.elapsed() < LONGEST_END {
        if let Some(report) = viewer.newest() {
            for (joint, limits) in limits[..ARM_JOINTS].iter().enumerate() {
                assert!(report.velocity[joint].abs() <= limits.velocity, "joint {joint}: {report:?}");
                assert!(
                    report.acceleration[joint].abs() <= 1.001 * limits.acceleration,
                    "{joint}: {report:?}"
                );
            }
            last = Some(report);
        }
        std::thread::sleep(Duration::from_micros(300));
    }
    let last = viewer.newest().or(last).unwrap();
    assert!(killed.elapsed() < LONGEST_END, "the driver lives on without a supervisor");
    assert_eq!(last.mode, DriveMode::Standing as u32, "{last:?}");
    assert_eq!(speed(&last), 0.0);
}

#[test]
fn the_joints_keep_their_limits_of_speed_and_position_when_control_is_killed_and_hangs_over_and_over() {
    let faults = ["control:kill@4s", "control:kill@6500ms", "control:stop@9s", "control:kill@13s"];
    let mut arguments = vec!["--duration".to_owned(), "16".to_owned()];
    arguments.extend(["--world".to_owned(), "kinematic".to_owned()]);
    arguments.extend(faults.map(|fault| format!("--inject={fault}")));
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let finished = Launched::start(&arguments).finish();
    let motion = finished.summary().motion;
    assert!(motion.samples > 8000, "{motion:?}");
    // Of the acceleration this says nothing: a simulated world that was late moves the joints on by several cycles at once.
    // `tools/lockstep/tests/lockstep/broken_chain.rs` measures it.
    assert!(motion.speed <= 1.0, "{motion:?}");
    assert!(motion.beyond_position_rad <= SCATTER, "{motion:?}");
}
