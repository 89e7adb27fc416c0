use super::blend::Blend;
use super::features::features;
use super::hierarchy::{Counts, Hierarchy};
use super::model::{CLASSES, PreshapeModel, READ, SNAPSHOTS};
use super::person::{OwnLevel, PastReach, Person};
use super::reach::ON_THE_WAY;
use super::{FEATURES, Features, PreshapeMemory, ReachRecord};
use crate::hand::HandMemory;
use coact_joint_task::Kind;
use coact_messages::MAX_KINDS;

/// Degrees of freedom of the Student distribution by which shapes scatter: a hand unlike all that were recorded says
/// little.
const TAILS: f64 = 5.0;

/// Reads from the hand's shape which kinds of part it prepares for.
#[derive(Debug, Clone)]
pub(crate) struct Classifier {
    model: PreshapeModel,
    phases: Vec<Hierarchy>,
    whole: Hierarchy,
    /// Class means of a person of whom nothing is known.
    anyone: [OwnLevel; READ],
    /// Where each kind's width lies among the size classes.
    kinds: Vec<Blend>,
    /// Size classes that the task has parts of.
    possible: [bool; CLASSES],
}

impl Classifier {
    /// `None` when the model holds a singular covariance.
    pub fn new(model: &PreshapeModel, kinds: &[Kind]) -> Option<Self> {
        let phases: Vec<Hierarchy> = model.phase.iter().map(Hierarchy::new).collect::<Option<_>>()?;
        let kinds: Vec<Blend> = kinds.iter().map(|kind| Blend::of(kind.width, &model.sizes)).collect();
        let mut possible = [kinds.is_empty(); CLASSES];
        kinds.iter().for_each(|kind| kind.mark(&mut possible));
        Some(Self {
            whole: Hierarchy::new(&model.whole)?,
            anyone: std::array::from_fn(|level| OwnLevel::of(&phases[level], &Counts::default())),
            model: model.clone(),
            phases,
            kinds,
            possible,
        })
    }

    /// Time since the reach's onset in units of the person's tempo.
    pub fn phase(&self, memory: &PreshapeMemory, cycle: u64) -> f64 {
        let tempo = if memory.person.tempo > 0.0 { memory.person.tempo } else { self.model.tempo };
        cycle.saturating_sub(memory.reach.onset) as f64 * 1e-3 / tempo
    }

    /// The features of the hand now, on `reach`.
    pub fn features(&self, hand: &HandMemory, reach: &ReachRecord) -> Features {
        features(&hand.shape(), reach.departure)
    }

    /// Takes in one new frame of the hand. `onset`: a reach from rest has begun with it.
    pub fn observe(&self, hand: &HandMemory, onset: bool, memory: &mut PreshapeMemory) {
        if onset && !memory.reach.is_recording() {
            memory.reach.begin(hand.motion.onset, hand.motion.departure);
        }
        if !memory.reach.is_recording() {
            return;
        }
        if hand.motion.onset < memory.reach.onset {
            memory.reach.onset = 0;
            return;
        }
        let phase = self.phase(memory, hand.captured);
        let features = self.features(hand, &memory.reach);
        let displacement = features[FEATURES - 1];
        memory
            .reach
            .pace
            .advance(displacement, hand.captured.saturating_sub(memory.reach.onset) as f64 * 1e-3);
        let own_movement = hand.motion.onset == memory.reach.onset;
        if memory.reach.tempo == 0.0 && own_movement && hand.motion.slowed > 0 {
            memory.reach.tempo = memory.reach.pace.time_to(ON_THE_WAY * displacement).unwrap_or(0.0);
        }
        memory.reach.advance(phase, &features);
        if memory.reach.is_complete() {
            self.finish(memory);
        }
    }

    /// A reach is over: it is remembered, if it was one, and the person's means are fitted anew.
    fn finish(&self, memory: &mut PreshapeMemory) {
        let reach = memory.reach;
        if reach.tempo > 0.0 {
            memory.person.remember(self.projected(&reach), self.model.tempo);
            memory.fitting.begin();
        }
    }

    fn projected(&self, reach: &ReachRecord) -> PastReach {
        PastReach {
            whole: self.model.whole.project(reach.whole().iter()),
            phase: std::array::from_fn(|level| self.model.phase[level].project(reach.features[level].iter())),
            tempo: reach.tempo,
        }
    }

    /// One cycle's share of learning this person's hand.
    pub fn learn(&self, memory: &mut PreshapeMemory) {
        memory.fitting.step(&self.whole, &self.phases, self.possible, &mut memory.person);
    }

    /// Logarithm of how well a hand with `features` at `phase` of its reach prepares for each kind, up to a constant;
    /// 0 for all before the first phase that is read.
    pub fn likelihoods(&self, features: &Features, phase: f64, person: &Person) -> [f64; MAX_KINDS] {
        let mut fit = [0.0; MAX_KINDS];
        if phase < SNAPSHOTS[0] {
            return fit;
        }
        let between = Blend::of(phase, &SNAPSHOTS[..READ]);
        let (low, high) = (&self.model.phase[between.low], &self.model.phase[between.high]);
        let own = if person.adapted == 1 { &person.own } else { &self.anyone };
        let at = between.mix(low.project(features.iter()), high.project(features.iter()));
        for (kind, size) in self.kinds.iter().enumerate() {
            fit[kind] = self.fit(at, &between, size, own);
        }
        fit
    }

    /// Logarithm of the density of the coordinate `at`, between two phases, for a width between two size classes.
    fn fit(&self, at: f64, between: &Blend, size: &Blend, own: &[OwnLevel; READ]) -> f64 {
        let mixed = |of: fn(&OwnLevel) -> &[f64; CLASSES]| {
            let level = |level: usize| size.mix(of(&own[level])[size.low], of(&own[level])[size.high]);
            between.mix(level(between.low), level(between.high))
        };
        let within = between.mix(self.phases[between.low].within, self.phases[between.high].within);
        let variance = within + mixed(|level| &level.variance);
        let miss = at - mixed(|level| &level.mean);
        -0.5 * ((TAILS + 1.0) * (1.0 + miss * miss / (TAILS * variance)).ln() + variance.ln())
    }
}
