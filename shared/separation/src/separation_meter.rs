use coact_messages::{ARM_JOINTS, Command, JOINTS, Truth};
use coact_motion::{Capsule, Mechanism, MovingCapsules};
use coact_period::PERIOD_S;
use coact_robot::{Robot, RobotError};
use coact_run_records::SeparationReport;
use coact_safety::SafetyLimits;
use nalgebra::Point3;

/// Measures the distance of robot and person, tick by tick.
#[derive(Debug, Clone)]
pub struct SeparationMeter {
    mechanism: Mechanism,
    capsules: MovingCapsules,
    /// Radii of the person's upper arm, forearm and hand, m.
    radii: [f64; 3],
    /// Protective separation, m.
    protective: f64,
    /// The tick before: posture of all joints, rad, and the person's arm.
    before: Option<([f64; JOINTS], [Capsule; 3])>,
    fingers: Vec<Capsule>,
    links: Vec<Capsule>,
    report: SeparationReport,
}

/// Who comes nearer by less than this in a tick stands, m: 15 mm/s. A simulated arm that has braked yields by up to half a millimetre,
/// at up to 13 mm/s, while its servos take up what the other joints leave.
const STANDING: f64 = 15e-6;
/// An arm below this fraction of its planned speed is stopped.
const STOPPED: f64 = 0.01;

impl SeparationMeter {
    /// # Errors
    /// [`RobotError`] when the robot's collision geometry cannot be used.
    pub fn new(robot: &Robot, limits: &SafetyLimits) -> Result<Self, RobotError> {
        let mechanism = Mechanism::of(robot)?;
        let capsules = MovingCapsules::of(&mechanism, &robot.hand)?;
        let radii = limits.person.radii;
        let protective = limits.guard.protective_separation;
        let (before, report) = (None, SeparationReport::default());
        let (fingers, links) = (Vec::new(), Vec::new());
        Ok(Self { mechanism, capsules, radii, protective, before, fingers, links, report })
    }

    /// Goes on from what was measured before.
    pub fn resume(&mut self, report: SeparationReport) {
        self.report = report;
    }

    /// Adds one tick, in which this command was the newest. Truth without a person's arm counts for nothing.
    pub fn tick(&mut self, truth: &Truth, command: &Command) {
        if truth.arm.as_flattened().iter().all(|number| *number == 0.0) {
            return;
        }
        let person: [Capsule; 3] = std::array::from_fn(|limb| Capsule {
            start: Point3::from(truth.arm[limb]),
            end: Point3::from(truth.arm[limb + 1]),
            radius: self.radii[limb],
        });
        self.count_speed(command);
        if command.handover == 0 {
            self.count_distance(&truth.joints, &person);
        }
        self.before = Some((truth.joints, person));
    }

    /// What was measured so far.
    pub fn report(&self) -> &SeparationReport {
        &self.report
    }

    fn count_speed(&mut self, command: &Command) {
        self.report.ticks += 1;
        self.report.held_back_ms += u64::from(command.speed_override < 1.0);
        self.report.stopped_ms += u64::from(command.speed_override < STOPPED);
    }

    fn count_distance(&mut self, joints: &[f64; JOINTS], person: &[Capsule; 3]) {
        let now = self.distance(joints, person);
        let nearest = self.report.nearest_m.get_or_insert(now);
        *nearest = nearest.min(now);
        let Some((own_before, theirs_before)) = self.before.filter(|_| now < self.protective) else { return };
        if now <= 0.0 {
            self.count_contact(&own_before, joints, person);
            return;
        }
        let robot_closes = now < self.distance(&own_before, person) - STANDING;
        let person_closes = now < self.distance(joints, &theirs_before) - STANDING;
        self.report.robot_closing_ms += u64::from(robot_closes);
        self.report.person_closing_ms += u64::from(person_closes);
    }

    /// Where capsules overlap, no distance tells any more who closes: it is least where their axes cross.
    fn count_contact(&mut self, own_before: &[f64; JOINTS], joints: &[f64; JOINTS], person: &[Capsule; 3]) {
        self.place_links(own_before);
        let before = self.links.clone();
        self.place_links(joints);
        let touches = |link: &Capsule| person.iter().any(|limb| link.distance(limb) <= 0.0);
        let touching = before.iter().zip(&self.links).filter(|(_, link)| touches(link));
        let way = touching.fold(0.0, |way: f64, (before, link)| {
            way.max((link.start - before.start).norm()).max((link.end - before.end).norm())
        });
        self.report.contact_ms += 1;
        self.report.contact_speed_mps = self.report.contact_speed_mps.max(way / PERIOD_S);
    }

    /// Distance of arm and hand from the person's arm, m.
    fn distance(&mut self, joints: &[f64; JOINTS], person: &[Capsule; 3]) -> f64 {
        self.place_links(joints);
        let pairs = self.links.iter().flat_map(|link| person.iter().map(move |limb| (link, limb)));
        pairs.fold(f64::INFINITY, |nearest, (link, limb)| {
            if link.least_distance(limb) < nearest { nearest.min(link.distance(limb)) } else { nearest }
        })
    }

    /// Puts arm and hand where these joints have them.
    fn place_links(&mut self, joints: &[f64; JOINTS]) {
        let Self { mechanism, capsules, fingers, links, .. } = self;
        capsules.close(&std::array::from_fn(|joint| joints[ARM_JOINTS + joint]), fingers);
        capsules.place(mechanism, &std::array::from_fn(|joint| joints[joint]), fingers, links);
    }
}
