use super::blend::Blend;
use super::features::features;
use super::hierarchy::{Counts, Hierarchy};
use super::person_model::{OwnLevel, PastReach, PersonModel};
use super::preshape_model::{CLASSES, PreshapeModel, READ, SNAPSHOTS};
use super::reach_record::ON_THE_WAY;
use super::{FEATURES, Features, PreshapeState, ReachRecord};
use crate::hand::TrackedHand;
use coact_joint_task::Kind;
use coact_messages::MAX_KINDS;
use coact_period::seconds;

/// Degrees of freedom of the Student distribution by which shapes scatter: a hand unlike all that were recorded says
/// little. Chosen by hand: few, so that the tails are heavy.
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
    pub fn phase(&self, state: &PreshapeState, cycle: u64) -> f64 {
        let tempo = if state.person.tempo > 0.0 { state.person.tempo } else { self.model.tempo };
        seconds(cycle.saturating_sub(state.reach.onset)) / tempo
    }

    /// The features of the hand now, on `reach`.
    pub fn features(&self, hand: &TrackedHand, reach: &ReachRecord) -> Features {
        features(&hand.shape(), reach.departure)
    }

    /// Takes in one new frame of the hand. `onset`: a reach from rest has begun with it.
    pub fn observe(&self, hand: &TrackedHand, onset: bool, state: &mut PreshapeState) {
        if onset && !state.reach.is_recording() {
            state.reach.begin(hand.movement.onset, hand.movement.departure);
        }
        if !state.reach.is_recording() {
            return;
        }
        if hand.movement.onset < state.reach.onset {
            state.reach.onset = 0;
            return;
        }
        let phase = self.phase(state, hand.captured);
        let features = self.features(hand, &state.reach);
        let displacement = features[FEATURES - 1];
        state.reach.progress.advance(displacement, seconds(hand.captured.saturating_sub(state.reach.onset)));
        let own_movement = hand.movement.onset == state.reach.onset;
        if state.reach.tempo == 0.0 && own_movement && hand.movement.slowed > 0 {
            state.reach.tempo = state.reach.progress.time_to(ON_THE_WAY * displacement).unwrap_or(0.0);
        }
        state.reach.advance(phase, &features);
        if state.reach.is_complete() {
            self.finish(state);
        }
    }

    /// A reach is over: it is remembered, if it was one, and the person's means are fitted anew.
    fn finish(&self, state: &mut PreshapeState) {
        let reach = state.reach;
        if reach.tempo > 0.0 {
            state.person.remember(self.projected(&reach), self.model.tempo);
            state.fitting.begin();
        }
    }

    fn projected(&self, reach: &ReachRecord) -> PastReach {
        PastReach {
            whole: self.model.whole.project(reach.whole().iter()),
            phase: std::array::from_fn(|level| self.model.phase[level].project(reach.features[level].iter())),
            tempo: reach.tempo,
        }
    }

    /// One cycle's part of learning this person's hand.
    pub fn learn(&self, state: &mut PreshapeState) {
        state.fitting.step(&self.whole, &self.phases, self.possible, &mut state.person);
    }

    /// Logarithm of how well a hand with `features` at `phase` of its reach prepares for each kind, up to a constant;
    /// 0 for all before the first phase that is read.
    pub fn likelihoods(&self, features: &Features, phase: f64, person: &PersonModel) -> [f64; MAX_KINDS] {
        let mut fit = [0.0; MAX_KINDS];
        if phase < SNAPSHOTS[0] {
            return fit;
        }
        let between = Blend::of(phase, &SNAPSHOTS[..READ]);
        let (low, high) = (&self.model.phase[between.low], &self.model.phase[between.high]);
        let own = if person.adapted.is_set() { &person.own } else { &self.anyone };
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
