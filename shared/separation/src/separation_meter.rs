use crate::needed_separation::needed_separation;
use coact_messages::{ARM_JOINTS, Command, JOINTS, Truth};
use coact_motion::{Capsule, Mechanism, MovingCapsules};
use coact_period::PERIOD_S;
use coact_robot::{Robot, RobotError};
use coact_run_records::SeparationReport;
use coact_safety::{PersonLimits, SafetyLimits};
use nalgebra::{Point3, Vector3};

/// Measures the distance of robot and person, tick by tick.
#[derive(Debug, Clone)]
pub struct SeparationMeter {
    mechanism: Mechanism,
    capsules: MovingCapsules,
    /// How wide arm and head are.
    person: PersonLimits,
    /// Protective separation, m.
    protective: f64,
    /// The tick before: its cycle, and the person. Where the links were then, and are now.
    before: Option<(u64, Person)>,
    links_before: Vec<Capsule>,
    links: Vec<Capsule>,
    fingers: Vec<Capsule>,
    report: SeparationReport,
}

/// Upper arm, forearm, hand and head, of one arm after the other.
type Person = [Capsule; 8];

/// Who comes nearer by less than this in a tick stands, m: 15 mm/s. A simulated arm that has braked yields by up to half a millimetre,
/// at up to 13 mm/s, while its servos take up what the other joints leave.
const STANDING: f64 = 15e-6;
/// Links and limbs farther apart than this are left out of the margin, m: what both need when the robot closes at 1 m/s and the
/// hand comes at 2.5.
const NEAR: f64 = 0.45;
/// An arm below this fraction of its planned speed is stopped.
const STOPPED: f64 = 0.01;

impl SeparationMeter {
    /// # Errors
    /// [`RobotError`] when the robot's collision geometry cannot be used.
    pub fn new(robot: &Robot, limits: &SafetyLimits) -> Result<Self, RobotError> {
        let mechanism = Mechanism::of(robot)?;
        let capsules = MovingCapsules::of(&mechanism, &robot.hand)?;
        let (person, protective) = (limits.person, limits.guard.protective_separation);
        let (before, report) = (None, SeparationReport::default());
        let [links_before, links, fingers] = std::array::from_fn(|_| Vec::with_capacity(capsules.most()));
        Ok(Self { mechanism, capsules, person, protective, before, links_before, links, fingers, report })
    }

    /// Goes on from what was measured before.
    pub fn resume(&mut self, report: SeparationReport) {
        self.report = report;
    }

    /// Adds one tick. Truth without a person's arm counts for nothing. Whether a motion is part of a handover the truth tells: `command`,
    /// the newest one known, may be older or younger than the motion, and only its speed counts.
    pub fn tick(&mut self, truth: &Truth, command: &Command) {
        if truth.arms.iter().all(is_none) {
            self.before = None;
            return;
        }
        let person = self.person_of(truth);
        std::mem::swap(&mut self.links, &mut self.links_before);
        self.place_links(&truth.joints);
        self.count_speed(command);
        let cycle = truth.header.cycle;
        if truth.handover == 0 {
            self.count_distance(cycle, &person);
        }
        self.before = Some((cycle, person));
    }

    /// The arms as they are, and the head, which may stand above either shoulder. One that there is not is taken to be where the other is.
    fn person_of(&self, truth: &Truth) -> Person {
        let [right, left] = truth.arms;
        let (right, left) =
            (if is_none(&right) { left } else { right }, if is_none(&left) { right } else { left });
        let (right, left) = (self.side_of(right), self.side_of(left));
        std::array::from_fn(|index| if index < 4 { right[index] } else { left[index - 4] })
    }

    fn side_of(&self, arm: [[f64; 3]; 4]) -> [Capsule; 4] {
        let PersonLimits { radii: [upper_arm, forearm, hand], head_radius, head_height, .. } = self.person;
        let [shoulder, elbow, wrist, fingertip] = arm.map(Point3::from);
        let crown = shoulder + head_height * Vector3::z();
        let line = |start, end, radius| Capsule { start, end, radius };
        [
            line(shoulder, elbow, upper_arm),
            line(elbow, wrist, forearm),
            line(wrist, fingertip, hand),
            line(shoulder, crown, head_radius),
        ]
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

    fn count_distance(&mut self, cycle: u64, person: &Person) {
        let now = distance(&self.links, person);
        let nearest = self.report.nearest_m.get_or_insert(now);
        *nearest = nearest.min(now);
        let Some((cycle_before, theirs_before)) = self.before else { return };
        let span = PERIOD_S * cycle.saturating_sub(cycle_before).max(1) as f64;
        self.count_margin(person, &theirs_before, span);
        if now >= self.protective {
            return;
        }
        if now <= 0.0 {
            self.count_contact(person, span);
        }
        self.count_closing(person, &theirs_before);
    }

    /// Whether some link, or some limb, came nearer by its own motion to what is nearer than the protective separation: each pair is held
    /// to that, not only the nearest one.
    fn count_closing(&mut self, person: &Person, theirs_before: &Person) {
        let (mut robot_closes, mut person_closes) = (false, false);
        for (link, own_before) in self.links.iter().zip(&self.links_before) {
            for (limb, limb_before) in person.iter().zip(theirs_before) {
                if link.least_distance(limb) >= self.protective {
                    continue;
                }
                let now = link.distance(limb);
                if now > 0.0 && now < self.protective {
                    robot_closes |= now < own_before.distance(limb) - STANDING;
                    person_closes |= now < link.distance(limb_before) - STANDING;
                }
            }
        }
        self.report.robot_closing_ms += u64::from(robot_closes);
        self.report.person_closing_ms += u64::from(person_closes);
    }

    /// What is left of each distance beyond what both need, where the robot's link closes.
    fn count_margin(&mut self, person: &Person, theirs_before: &Person, span: f64) {
        for (link, own_before) in self.links.iter().zip(&self.links_before) {
            for (limb, limb_before) in person.iter().zip(theirs_before) {
                if link.least_distance(limb) > NEAR {
                    continue;
                }
                let now = link.distance(limb);
                let closing = own_before.distance(limb) - now;
                if now > 0.0 && closing > STANDING {
                    let coming = (link.distance(limb_before) - now).max(0.0);
                    let margin = now - needed_separation(closing / span, coming / span);
                    let smallest = self.report.smallest_margin_m.get_or_insert(margin);
                    *smallest = smallest.min(margin);
                }
            }
        }
    }

    /// Where capsules overlap, no distance tells any more who closes: it is least where their axes cross.
    fn count_contact(&mut self, person: &Person, span: f64) {
        let touches = |link: &Capsule| person.iter().any(|limb| link.distance(limb) <= 0.0);
        let touching = self.links_before.iter().zip(&self.links).filter(|(_, link)| touches(link));
        let way = touching.fold(0.0, |way: f64, (before, link)| {
            way.max((link.start - before.start).norm()).max((link.end - before.end).norm())
        });
        self.report.contact_ms += 1;
        self.report.contact_speed_mps = self.report.contact_speed_mps.max(way / span);
    }

    /// Puts arm and hand where these joints have them.
    fn place_links(&mut self, joints: &[f64; JOINTS]) {
        let Self { mechanism, capsules, fingers, links, .. } = self;
        capsules.close(&std::array::from_fn(|joint| joints[ARM_JOINTS + joint]), fingers);
        capsules.place(mechanism, &std::array::from_fn(|joint| joints[joint]), fingers, links);
    }
}

/// Whether there is no such arm.
fn is_none(arm: &[[f64; 3]; 4]) -> bool {
    arm.as_flattened().iter().all(|number| *number == 0.0)
}

/// Distance of arm and hand from the person, m.
fn distance(links: &[Capsule], person: &Person) -> f64 {
    let pairs = links.iter().flat_map(|link| person.iter().map(move |limb| (link, limb)));
    pairs.fold(f64::INFINITY, |nearest, (link, limb)| {
        if link.least_distance(limb) < nearest { nearest.min(link.distance(limb)) } else { nearest }
    })
}
