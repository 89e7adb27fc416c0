use crate::evidence::{HELD, smooth_step};
use crate::objects::{PartTrack, TaskPlaces};
use crate::perception_state::PerceptionState;
use crate::present_movement::PresentMovement;
use crate::preshape::{Classifier, LAST_READ};
use crate::reaching::{HANDOVER, MovementReader, PLACES};
use coact_joint_task::{PersonGrip, Task};
use coact_messages::{ArmSide, MAX_GRIPS, MAX_KINDS, MAX_PARTS, PERSON, Percept, SceneView};
use nalgebra::{Vector2, Vector3};
use std::cmp::Ordering;

/// Phase of contact (see [`crate::SNAPSHOTS`]): in the recorded reaches, within 10 %.
const CONTACT: f64 = 1.8;
/// Phases of a reach between which the hand takes the shape that tells what it is for: before, it misleads. They are those
/// from which the recorded reaches can be told apart.
const SHAPES: (f64, f64) = (0.6, 1.1);
/// Phases between which evidence is sharpened, as contact comes near. Chosen by hand.
const SHARPENS: (f64, f64) = (1.0, 1.4);
/// The exponent that is reached then. Chosen by hand: large enough that the best of two that are nearly alike decides.
const SHARPNESS: f64 = 6.0;
/// Phases between which the pitch of the hand becomes that of the grip. Chosen by hand.
const TURNS: (f64, f64) = (0.25, 0.80);
/// From one place where an empty hand may be shown to the next, nearer to the person, m: it is held out short of where parts change
/// hands. Chosen by hand.
const SHORT_OF_IT: f64 = 0.08;
/// How well a movement must lead to a part: no, and full evidence that it is meant for one. Chosen by hand.
const LEADS: (f64, f64) = (0.05, 0.35);
/// Distance from its target at which a movement that did not begin at rest tells where it goes, m: no, full evidence.
/// Chosen by hand: such a movement has no known length, so that its phase tells nothing.
const ARRIVES: (f64, f64) = (0.15, 0.05);
/// How likely it is beforehand that a reach takes apart what is mounted, against any other place: a logarithm. Chosen by hand: a
/// twentieth was too little, and with a third reaches to what lies there are understood as soon as without.
const TAKES_APART: f64 = -1.0;
/// How likely it is beforehand that a hand which set out from elsewhere returns to rest, against that it goes for any one part: a logarithm.
/// Chosen by hand: what it held is put down, and most withdraw then, past whatever lies there.
const RETURNS: f64 = 2.0;
/// Least that a movement leads anywhere: its logarithm is finite.
const LEAST: f64 = 1e-12;
/// A part in the robot's hand is offered when it is this near to the handover place, m: chosen by hand.
pub(crate) const OFFERED: f64 = 0.25;

/// Tells where the hand's movement may lead, by its way, its shape and its pitch; and what grasp it is by sight, once a part is in the hand.
#[derive(Debug, Clone)]
pub(crate) struct Grasps {
    grips: Vec<PersonGrip>,
    handover: Vector3<f64>,
    /// Where each hand rests, by [`ArmSide`], m.
    rest: [Vector3<f64>; 2],
}

impl Grasps {
    pub fn new(task: &Task) -> Self {
        Self {
            grips: task.grips.clone(),
            handover: task.scene.handover.into(),
            rest: ArmSide::BOTH.map(|side| task.scene.rest(side).into()),
        }
    }

    /// Evidence in [0, 1] that the hand has taken a part of `kind`, to do something with it. What was mounted, and is taken out again, may go
    /// anywhere: until it is laid down, how it is held tells nothing.
    pub fn evidence(kind: usize, state: &PerceptionState, out: &Percept) -> f64 {
        if state.parts.is_taken_out(kind) { 0.0 } else { out.person_holds[kind] }
    }

    /// Learns how this person holds the hand, from a part that it has taken.
    pub fn learn(&self, state: &mut PerceptionState) {
        if let Some(pitch) = state.grip_pitch() {
            state.grips.learn(&self.grips, pitch);
        }
    }

    /// Tells where the present movement may lead, and which grips it may end in. Without one, what was told of the last stands.
    pub fn report(
        &self,
        movement: Option<&PresentMovement>,
        state: &PerceptionState,
        classifier: &Classifier,
        places: &TaskPlaces,
        out: &mut Percept,
    ) {
        let held = out.person_holds.iter().copied().fold(0.0, f64::max);
        if held > HELD {
            state.grips.tell(&self.grips, state.grip_pitch(), 1.0, &mut out.grips);
        }
        let (grips, out) = (&mut out.grips, &mut out.destinations);
        out.told = 0.0;
        let Some(movement) = movement else { return };
        out.count = 0;
        let mut found = [None; MAX_PARTS];
        found.iter_mut().zip(self.targets(movement, state, places)).for_each(|(slot, own)| *slot = Some(own));
        let targets = || found.iter().copied().flatten();
        let Some(best) = targets().max_by(TargetMatch::by_likelihood) else { return };
        let Reading { trust, gate, sharpness, heading, fit } = reading(movement, &best, state, classifier);
        out.told = (1.0 - held) * gate;
        for target in targets() {
            let fit = sharpness * fit[target.kind] + target.lead.logarithm(heading);
            out.push(Some(target.kind), target.place.into(), fit);
        }
        let usual = mean(targets().map(|target| fit[target.kind]));
        let offered = targets().any(|target| target.offered);
        for (place, lead) in self.elsewhere(movement, state, offered) {
            out.push(None, place.into(), sharpness * usual + lead.logarithm(heading));
        }
        for (kind, place, lead) in self.mounted(movement, state, places) {
            // What is mounted is hardly ever taken: the hand's shape can speak against it, and not for it.
            out.push(None, place.into(), sharpness * fit[kind].min(usual) + lead.logarithm(heading));
        }
        against_the_best(&mut out.fit[..out.count as usize]);
        if held <= HELD {
            state.grips.tell(&self.grips, state.hand.pitch_ahead(), trust, grips);
        }
    }

    /// Tells where a hand may be that has gone out of sight: at a part that is out of sight as well, or it would be seen there. Its way until
    /// then still counts; its grip does not show.
    pub fn report_hidden(
        &self,
        state: &PerceptionState,
        places: &TaskPlaces,
        view: &SceneView,
        out: &mut Percept,
    ) {
        let (grips, out) = (&mut out.grips, &mut out.destinations);
        let parts = state.parts.numbered();
        let takable = parts.filter(|(_, kind, part)| self.is_takable(*kind, part, places));
        let sight = places.sight(view);
        let hidden = |kind: usize, part: &PartTrack| sight.hides(part.upper_face(places.size(kind)));
        (out.told, out.count) = (1.0, 0);
        grips.count = self.grips.len().min(MAX_GRIPS) as u32;
        grips.fit.fill(0.0);
        // Of a hand that went out of sight as it set out no way is known.
        let fit = |index| if state.hand.movement.is_moving() { state.likelihoods.of(index) } else { 1.0 };
        for (index, kind, part) in takable.filter(|(_, kind, part)| hidden(*kind, part)) {
            let centre = part.centre(places.size(kind));
            out.push(Some(kind), centre.xy().into(), fit(index));
        }
        against_the_best(&mut out.fit[..out.count as usize]);
    }

    /// One cycle's part of finding out which places the movement leads to.
    pub fn look_ahead(&self, state: &mut PerceptionState, reader: &MovementReader, places: &TaskPlaces) {
        let rest = self.rest[state.acting() as usize];
        let PerceptionState { likelihoods, path, person, parts, .. } = state;
        likelihoods.step(reader, path, person, |index| match index.checked_sub(HANDOVER) {
            Some(nearer) => Some(self.shown(rest, nearer)),
            None => {
                let part = parts.track(index)?;
                let takable = |kind: usize| {
                    self.is_takable(kind, part, places) || places.is_mounted(kind, part.position)
                };
                let kind = part.kind().filter(|kind| takable(*kind))?;
                Some(part.centre(places.size(kind)).xy())
            }
        });
    }

    /// Where an empty hand that rests at `rest` may be shown, on the table plane: at the handover place, or nearer to the person.
    fn shown(&self, rest: Vector3<f64>, nearer: usize) -> Vector2<f64> {
        let back = (rest - self.handover).xy();
        self.handover.xy() + SHORT_OF_IT * nearer as f64 * back.normalize()
    }

    /// Parts that are mounted, each with its kind: a hand that goes there takes nothing that lies on its way. One that is still in the robot's hand is not:
    /// the person can take it.
    fn mounted<'a>(
        &'a self,
        movement: &'a PresentMovement,
        state: &'a PerceptionState,
        places: &'a TaskPlaces,
    ) -> impl Iterator<Item = (usize, Vector2<f64>, Lead)> + 'a {
        let parts = state.parts.numbered();
        let mounted = parts.filter(|(_, kind, part)| {
            places.is_mounted(*kind, part.position) && !self.is_takable(*kind, part, places)
        });
        mounted.map(|(index, kind, part)| {
            let centre = part.centre(places.size(kind));
            let likely = if movement.phase.is_some() { state.likelihoods.of(index) } else { 0.0 };
            let lead = Lead { heads: movement.heading.leads_to(centre), likely: likely + TAKES_APART };
            (kind, centre.xy(), lead)
        })
    }

    /// Places where nothing is taken: an empty hand is shown at the handover place, and one that has set out from elsewhere returns to rest.
    fn elsewhere(
        &self,
        movement: &PresentMovement,
        state: &PerceptionState,
        offered: bool,
    ) -> impl Iterator<Item = (Vector2<f64>, Lead)> {
        let heads = if offered { 0.0 } else { movement.heading.leads_to(self.handover) };
        let likelihoods = (HANDOVER..PLACES).map(|place| state.likelihoods.of(place));
        let is_from_rest = movement.phase.is_some();
        let likely = if is_from_rest { likelihoods.fold(f64::NEG_INFINITY, f64::max) } else { 0.0 };
        let shown = (self.handover.xy(), Lead { heads, likely });
        let rest = self.rest[state.acting() as usize];
        let back = Lead { heads: movement.heading.leads_to(rest), likely: RETURNS };
        let back = (!is_from_rest).then_some((rest.xy(), back));
        std::iter::once(shown).chain(back)
    }

    /// Whether the person could take a part: it lies there, or the robot offers it.
    fn is_takable(&self, kind: usize, part: &PartTrack, places: &TaskPlaces) -> bool {
        let offered = (Vector3::from(part.position) - self.handover).norm() < OFFERED;
        places.is_free_at(PERSON, kind, part) || (part.is_with_the_robot() && offered)
    }

    /// The parts that the person could take.
    fn targets<'a>(
        &'a self,
        movement: &'a PresentMovement,
        state: &'a PerceptionState,
        places: &'a TaskPlaces,
    ) -> impl Iterator<Item = TargetMatch> + 'a {
        let parts = state.parts.numbered();
        let takable = parts.filter(|(_, kind, part)| self.is_takable(*kind, part, places));
        takable.map(|(index, kind, part)| {
            let centre = part.centre(places.size(kind));
            let heading = &movement.heading;
            let likely = if movement.phase.is_some() { state.likelihoods.of(index) } else { 0.0 };
            let lead = Lead { heads: heading.leads_to(centre), likely };
            let distance = (centre - heading.centre).norm();
            TargetMatch { kind, place: centre.xy(), lead, distance, offered: part.is_with_the_robot() }
        })
    }
}

/// How a movement relates to one part.
#[derive(Debug, Clone, Copy)]
struct TargetMatch {
    kind: usize,
    /// Where it is on the table plane, m.
    place: Vector2<f64>,
    lead: Lead,
    /// How far it is away, m.
    distance: f64,
    /// Whether the robot holds it out.
    offered: bool,
}

impl TargetMatch {
    fn by_likelihood(one: &Self, other: &Self) -> Ordering {
        let sum = |target: &Self| target.lead.logarithm(1.0);
        sum(one).total_cmp(&sum(other))
    }
}

/// How well a movement leads to a place.
#[derive(Debug, Clone, Copy)]
struct Lead {
    /// By where it is and where it heads now, in [0, 1].
    heads: f64,
    /// By all its way so far, as people reach: a logarithm, against other places; 0 for a movement that did not begin at rest.
    likely: f64,
}

impl Lead {
    /// Both together, as a logarithm; where the hand heads now has this exponent.
    fn logarithm(&self, heading: f64) -> f64 {
        heading * self.heads.max(LEAST).ln() + self.likely
    }
}

/// What a movement tells already.
struct Reading {
    /// How far the grip shows.
    trust: f64,
    /// How much it counts that the movement leads to the best part.
    gate: f64,
    /// How much the best kind is preferred.
    sharpness: f64,
    /// How much that is to which the hand heads now: on the first part of a reach from rest nothing, for all its way so far tells that better, and
    /// people set out in directions of their own.
    heading: f64,
    /// Logarithm of how well the hand's shape fits each kind.
    fit: [f64; MAX_KINDS],
}

/// Of a reach from rest, its phase tells how much is to be read from direction, shape and pitch; of any other movement,
/// the distance from its target.
fn reading(
    movement: &PresentMovement,
    best: &TargetMatch,
    state: &PerceptionState,
    classifier: &Classifier,
) -> Reading {
    let Some(time) = movement.phase else {
        let near = smooth_step(best.distance, ARRIVES.0, ARRIVES.1);
        return Reading {
            trust: near,
            gate: best.lead.heads * near,
            sharpness: SHARPNESS,
            heading: SHARPNESS,
            fit: [0.0; MAX_KINDS],
        };
    };
    let phase = phase_of(time, best, state);
    let shaped = smooth_step(phase, SHAPES.0, SHAPES.1);
    let sharpens = smooth_step(phase, SHARPENS.0, SHARPENS.1);
    Reading {
        trust: smooth_step(phase, TURNS.0, TURNS.1),
        gate: smooth_step(best.lead.heads, LEADS.0, LEADS.1),
        sharpness: 1.0 + (SHARPNESS - 1.0) * sharpens,
        heading: SHARPNESS * sharpens,
        fit: size_fit(state, classifier).map(|fit| shaped * fit),
    }
}

/// Phase of a reach: the mean of what the time that it has taken says, and the way that is left to the part that it
/// leads to. The fraction of the way that is covered grows with the square root of the phase,
/// nearly so in all people.
fn phase_of(time: f64, target: &TargetMatch, state: &PerceptionState) -> f64 {
    let shape = state.hand.shape();
    let covered = (Vector3::from(shape.wrist) - Vector3::from(state.preshape.reach.departure)).norm();
    let fraction = covered / (covered + target.distance).max(1e-6);
    0.5 * (time + CONTACT * fraction * fraction)
}

/// Logarithm of how well the hand's shape fits each kind. Beyond the last phase that the model reads, what was seen
/// then counts.
fn size_fit(state: &PerceptionState, classifier: &Classifier) -> [f64; MAX_KINDS] {
    let (hand, reach, person) = (&state.hand, &state.preshape.reach, &state.preshape.person);
    if reach.passed as usize > LAST_READ {
        return classifier.likelihoods(&reach.features[LAST_READ], crate::SNAPSHOTS[LAST_READ], person);
    }
    let seen = classifier.phase(&state.preshape, hand.captured);
    classifier.likelihoods(&classifier.features(hand, reach), seen, person)
}

/// From logarithms to how well each fits against the best.
fn against_the_best(fit: &mut [f64]) {
    let best = fit.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    fit.iter_mut().for_each(|fit| *fit = (*fit - best).exp());
}

/// 0 of none.
fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (count, sum) = values.fold((0.0, 0.0), |(count, sum), value| (count + 1.0, sum + value));
    sum / f64::max(count, 1.0)
}
