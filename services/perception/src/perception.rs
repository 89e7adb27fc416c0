use crate::acts::Acts;
use crate::hand::HandMemory;
use crate::memory::Memory;
use crate::objects::{PersonHand, Places, Surroundings};
use crate::preshape::{Classifier, PreshapeModel, ReachRecord};
use crate::words::Words;
use coact_joint_task::Task;
use coact_messages::{HandPercept, JointReading, Percept, SensorSample};
use coact_robot::Robot;
use nalgebra::Point3;

/// Sensor samples become a percept: what the person's hand does, what lies where, how far the construction is.
#[derive(Debug, Clone)]
pub struct Perception {
    places: Places,
    acts: Acts,
    words: Words,
    classifier: Classifier,
    robot: Option<Robot>,
    /// Everything that lasts from cycle to cycle: the next percept without header and memory, and its memory.
    state: Box<Percept>,
    memory: Box<Memory>,
}

/// Why perception cannot be built.
#[derive(Debug, thiserror::Error)]
#[error("the preshape model holds a covariance that cannot be inverted; make it anew with `coact train`")]
pub struct SingularModel;

impl Perception {
    /// A perception for `task` that has seen nothing yet.
    ///
    /// # Errors
    /// [`SingularModel`] when a covariance of the model cannot be inverted.
    pub fn new(task: &Task, model: &PreshapeModel) -> Result<Self, SingularModel> {
        let mut state: Box<Percept> = bytemuck::zeroed_box();
        state.workspace.iter_mut().for_each(|place| place.orientation.fill([0.0, 0.0, 0.0, 1.0]));
        Ok(Self {
            places: Places::new(task),
            acts: Acts::new(task),
            words: Words::new(task),
            classifier: Classifier::new(model, &task.kinds).ok_or(SingularModel)?,
            robot: None,
            state,
            memory: bytemuck::zeroed_box(),
        })
    }

    /// Lets perception know where the robot's fingers meet, from its joints. Without, a touched part that hangs in the
    /// air is taken to be in the robot's hand.
    #[must_use]
    pub fn with_robot(mut self, robot: Robot) -> Self {
        self.robot = Some(robot);
        self
    }

    /// Continues from the newest percept of a predecessor, made for the same task.
    pub fn resume(&mut self, last: &Percept) {
        *self.state = *last;
        *self.memory = *Memory::of(&last.memory);
    }

    /// Advances by one period of 1 ms. `sample` is the newest one known; the same one again is a stale one, whose
    /// evidence ages. Writes all of `out` but its header.
    pub fn step(&mut self, tick: u64, sample: Option<&SensorSample>, out: &mut Percept) {
        if let Some(sample) = sample {
            self.sense(tick, sample);
            let followed = self.memory.hand.is_followed(tick);
            self.places.report(tick, &self.memory.objects, &sample.scene, followed, &mut self.state);
        }
        self.classifier.learn(&mut self.memory.preshape);
        let heard = self.words.heard(tick);
        self.acts.report(tick, &mut self.memory, &self.classifier, &self.places, heard, &mut self.state);
        self.memory.loss.report(tick, self.places.kinds(), &mut self.state);
        self.report_hand(tick);
        let header = out.header;
        *out = *self.state;
        out.header = header;
        *Memory::of_mut(&mut out.memory) = *self.memory;
    }

    /// The present reach's features, for those who learn a model from them.
    pub fn reach(&self) -> &ReachRecord {
        &self.memory.preshape.reach
    }

    fn sense(&mut self, tick: u64, sample: &SensorSample) {
        let memory = &mut *self.memory;
        if let Some(onset) = memory.hand.observe(tick, &sample.hand, sample.scene.occluders > 0) {
            let from_rest = onset && self.acts.is_from_rest(memory.hand.motion.departure);
            self.classifier.observe(&memory.hand, from_rest, &mut memory.preshape);
            if self.state.person_holds.iter().all(|held| *held < 0.5) {
                let pitch = memory.hand.pitch();
                memory.keep_pitch(pitch);
            }
        }
        if memory.objects.is_news(tick, &sample.scene) {
            let around = surroundings(tick, &memory.hand, self.robot.as_ref(), &sample.joints);
            memory.objects.observe(&sample.scene, &around, &self.places);
            memory.loss.look(&memory.objects, &around, &self.places);
        }
        memory.loss.feel(tick, &sample.joints, &memory.objects, &self.places);
        memory.hiding.watch(tick, sample, &memory.hand, &memory.preshape.reach, &self.places);
        self.words.listen(&sample.heard);
    }

    fn report_hand(&mut self, tick: u64) {
        let (hand, reach) = (&self.memory.hand, &self.memory.preshape.reach);
        let tracked = hand.is_tracked(tick);
        let reaching = tracked && hand.motion.is_moving() && hand.motion.onset == reach.onset;
        self.state.arm = hand.arm_at(tick);
        self.state.hand = HandPercept {
            wrist: hand.wrist_at(tick).into(),
            velocity: hand.velocity().into(),
            aperture: hand.aperture(),
            reaching: u32::from(reaching),
            tracked: u32::from(tracked),
            since_onset: if reaching { tick.saturating_sub(reach.onset) } else { 0 },
            age: hand.age(tick),
        };
    }
}

fn surroundings(tick: u64, hand: &HandMemory, robot: Option<&Robot>, joints: &JointReading) -> Surroundings {
    let person = hand.is_tracked(tick).then(|| PersonHand {
        centre: hand.centre(),
        aperture: hand.aperture(),
        speed: hand.motion.speed,
    });
    let hand_axis = robot.map(|robot| {
        let (palm, hand) = (robot.palm(&joints.position), &robot.hand);
        [hand.palm_face, hand.grasp_distance].map(|along| (palm * Point3::new(0.0, 0.0, along)).coords)
    });
    Surroundings { person, hand_axis, touch: joints.touch }
}
