use crate::assembly::{INSTANTS, settings};
use crate::configuration::{shipped, task};
use crate::scratch::Scratch;
use coact_joint_task::NetworkPlan;
use coact_messages::ARM_JOINTS;
use coact_monitor::{Intentions, Monitor, PipelineNode, Rules, Watched};
use coact_period::PERIOD_NS;
use coact_pipeline::Pipeline;
use coact_robot::{JointLimits, Robot};
use coact_safety::SafetyLimits;
use coact_separation::SeparationMeter;
use std::time::{Duration, SystemTime};

/// What a monitor is made of, read once.
pub(crate) struct Watch {
    intentions: Intentions,
    nodes: Vec<PipelineNode>,
    limits: Vec<JointLimits>,
    separation: SeparationMeter,
    rules: Rules,
}

impl Watch {
    fn new() -> Self {
        let settings = settings();
        let robot = Robot::load(&settings.robot).unwrap();
        let limits = SafetyLimits::load(&settings.safety).unwrap();
        Self {
            intentions: Intentions::from(&NetworkPlan::load(&settings.task).unwrap().1),
            nodes: PipelineNode::all(&Pipeline::load(&settings.pipeline).unwrap()),
            limits: robot.limits()[..ARM_JOINTS].to_vec(),
            separation: SeparationMeter::new(&robot, &limits).unwrap(),
            rules: Rules::load(&shipped(Rules::FILE)).unwrap(),
        }
    }

    /// A monitor that has just been started looks at something, and writes down what it has seen.
    pub(crate) fn with(look: impl FnOnce(&mut Monitor)) {
        thread_local! {
            static WATCH: Watch = Watch::new();
        }
        let report = Scratch::folder().join("report");
        std::fs::create_dir_all(&report).unwrap();
        Monitor::clear(&report).unwrap();
        let mut monitor = WATCH.with(|watch| Monitor::open(watch.watched(report))).unwrap();
        let first = &INSTANTS[0];
        monitor.truth(&first.truth, &mut Vec::new());
        monitor.frame(&first.frame, &mut Vec::new());
        look(&mut monitor);
        monitor.record(INSTANTS[3].tick * PERIOD_NS, Vec::new()).unwrap();
    }

    fn watched(&self, report: std::path::PathBuf) -> Watched {
        Watched {
            report,
            task: task().clone(),
            intentions: self.intentions.clone(),
            nodes: self.nodes.clone(),
            limits: self.limits.clone(),
            separation: self.separation.clone(),
            fresh: Duration::from_millis(10),
            rules: self.rules.clone(),
            start_ns: 0,
            started: SystemTime::UNIX_EPOCH,
        }
    }
}
