use crate::acts::Acts;
use crate::attention::attend;
use crate::evidence::HELD;
use crate::hand::TrackedHand;
use crate::objects::{Hands, PersonHand, TaskPlaces};
use crate::perception_state::{PerceptionState, ResumeError};
use crate::preshape::{Classifier, PreshapeModel, ReachRecord};
use crate::reaching::MovementReader;
use crate::words::Words;
use coact_joint_task::Task;
use coact_messages::{HandPercept, JointReading, Percept, SensorSample};
use coact_robot::Robot;
use coact_stage_state::StageState;
use nalgebra::Point3;

/// Sensor samples become a percept: what the person's hand does, what lies where, how far the construction is.
#[derive(Debug, Clone)]
pub struct Perception {
    places: TaskPlaces,
    acts: Acts,
    words: Words,
    classifier: Classifier,
    movements: MovementReader,
    robot: Option<Robot>,
    /// The next percept, without its header and its state words: evidence lasts from cycle to cycle.
    percept: Box<Percept>,
    /// Everything else that lasts.
    state: Box<PerceptionState>,
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
        let mut percept: Box<Percept> = bytemuck::zeroed_box();
        percept.workspace.iter_mut().for_each(|place| place.orientation.fill([0.0, 0.0, 0.0, 1.0]));
        Ok(Self {
            places: TaskPlaces::new(task),
            acts: Acts::new(task),
            words: Words::new(task),
            classifier: Classifier::new(model, &task.kinds).ok_or(SingularModel)?,
            movements: MovementReader::new(&model.movement),
            robot: None,
            percept,
            state: bytemuck::zeroed_box(),
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
    ///
    /// # Errors
    /// [`ResumeError`] when it is not what a perception of this task leaves behind; then this one stays as it was.
    pub fn resume(&mut self, last: &Percept) -> Result<(), ResumeError> {
        *self.state = PerceptionState::of(last, self.places.kinds())?;
        *self.percept = *last;
        Ok(())
    }

    /// Advances by one period of 1 ms. `sample` is the newest one known; the same one again is a stale one, whose
    /// evidence ages. Writes all of `out` but its header.
    pub fn step(&mut self, tick: u64, sample: Option<&SensorSample>, out: &mut Percept) {
        if let Some(sample) = sample {
            self.sense(tick, sample);
            let followed = self.state.hand.is_followed(tick);
            let sight = self.places.sight(&sample.scene);
            self.places.report(tick, &self.state.parts, &sight, followed, &mut self.percept);
        }
        self.classifier.learn(&mut self.state.preshape);
        self.acts.look_ahead(&mut self.state, &self.movements, &self.places);
        let heard = self.words.heard(tick);
        self.acts.report(tick, &mut self.state, &self.classifier, &self.places, heard, &mut self.percept);
        if let Some(sample) = sample {
            self.acts.look_behind(&self.state, &self.places, &sample.scene, &mut self.percept);
        }
        self.state.loss.report(tick, self.places.kinds(), &mut self.percept);
        self.report_hand(tick);
        out.tell_as(&self.percept);
        self.state.store(&mut out.state);
    }

    /// The present reach's features, for those who learn a model from them.
    pub fn reach(&self) -> &ReachRecord {
        &self.state.preshape.reach
    }

    fn sense(&mut self, tick: u64, sample: &SensorSample) {
        let state = &mut *self.state;
        if let Some(onset) = attend(tick, sample, &self.acts, &self.places, &self.percept, state) {
            let from_rest = onset && self.acts.is_from_rest(state.acting(), state.hand.movement.departure);
            self.classifier.observe(&state.hand, from_rest, &mut state.preshape);
            if onset {
                state.likelihoods.begin();
            }
            // A grip that was out of sight shows when the hand comes back with what it has taken.
            if self.percept.person_holds.iter().all(|held| *held < HELD) || state.grip_pitch().is_none() {
                let pitch = state.hand.pitch();
                state.keep_pitch(pitch);
            }
        }
        if state.parts.is_news(tick, &sample.scene) {
            let rests = self.acts.is_from_rest(state.acting(), state.hand.shape().wrist);
            let around = hands(tick, (&state.hand, rests), self.robot.as_ref(), &sample.joints);
            let held = state.parts.is_any_with_the_person();
            let sight = self.places.sight(&sample.scene);
            state.parts.observe(&sight, &around, &self.places);
            let takes = !held && state.parts.is_any_with_the_person();
            if takes && state.preshape.reach.is_of(&state.hand.movement) {
                self.movements.learn(&state.path, state.hand.centre().xy(), &mut state.person);
            }
            if takes {
                self.acts.learn(state);
            }
            state.loss.look(&state.parts, &around, &self.places);
        }
        state.loss.feel(tick, &sample.joints, &state.parts, &self.places);
        let may_reach = may_reach(&self.acts, state);
        let seen = (&sample.scene, &sample.hands[state.acting() as usize]);
        state.occlusion.watch(tick, seen, &state.hand, may_reach, &self.places);
        self.words.listen(&sample.heard);
    }

    fn report_hand(&mut self, tick: u64) {
        let (hand, reach) = (&self.state.hand, &self.state.preshape.reach);
        let tracked = hand.is_tracked(tick);
        let reaching = tracked && hand.movement.is_moving() && reach.is_of(&hand.movement);
        let side = self.state.acting();
        self.percept.arms[side as usize] = hand.arm_at(tick);
        self.percept.arms[side.other() as usize] = self.state.other.arm_at(tick);
        self.percept.hand = HandPercept {
            aperture: hand.aperture(),
            reaching: u32::from(reaching),
            side: side as u32,
            since_onset: if reaching { tick.saturating_sub(reach.onset) } else { 0 },
        };
    }
}

/// Whether the hand was on a reach when it was seen last, or lay where reaches begin: of one that goes out of sight as it sets out, no
/// movement is seen.
fn may_reach(acts: &Acts, state: &PerceptionState) -> bool {
    let movement = &state.hand.movement;
    match movement.is_moving() {
        true => state.preshape.reach.is_of(movement),
        false => acts.is_from_rest(state.acting(), movement.place_of_stillness()),
    }
}

/// Both hands at `tick`; `rests`: the person's lies where it rests.
fn hands(
    tick: u64,
    (hand, rests): (&TrackedHand, bool),
    robot: Option<&Robot>,
    joints: &JointReading,
) -> Hands {
    let person = hand.is_tracked(tick).then(|| PersonHand {
        centre: hand.centre(),
        aperture: hand.shape().aperture(),
        speed: hand.movement.speed,
        velocity: hand.steady_centre().1,
        rests,
    });
    let palm = robot.map(|robot| robot.palm(&joints.position));
    let hand_axis = robot.zip(palm).map(|(Robot { hand, .. }, palm)| {
        [hand.palm_face, hand.grasp_distance].map(|along| (palm * Point3::new(0.0, 0.0, along)).coords)
    });
    Hands {
        person,
        unseen: hand.has_been_seen() && person.is_none(),
        followed: hand.is_followed(tick),
        palm,
        hand_axis,
        touch: joints.touch,
    }
}
