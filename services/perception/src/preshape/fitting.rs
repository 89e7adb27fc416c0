use super::hierarchy::{Counts, Hierarchy};
use super::person_model::{OwnLevel, PersonModel};
use super::preshape_model::{CLASSES, READ};
use bytemuck::{Pod, Zeroable};
use coact_stage_state::{Flag, Implausible, ensure, finite};
use nalgebra::Vector3;

/// Sweeps of expectation maximisation from each start. Chosen by hand: in one dimension with three classes it has converged
/// by then, and one sweep a cycle keeps the whole fit within 35 ms.
const SWEEPS: u64 = 15;
/// Starts: the people's means, and the same moved by the person's overall offset. From one alone, a person with small or
/// large hands could be taken for one who grasps other sizes.
const STARTS: u64 = 2;
/// Steps of a fit: all sweeps, then the phases of the way.
const STEPS: u64 = STARTS * SWEEPS + READ as u64;

/// The mixture of size classes, being fitted to one person's reaches: one sweep in each cycle, so that no cycle
/// carries the whole burden.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Fitting {
    /// Steps that remain; 0 = idle.
    remaining: u64,
    /// Class means of the present start.
    means: [f64; CLASSES],
    /// The best start's means, and how well they fit.
    best: [f64; CLASSES],
    score: f64,
}

impl Fitting {
    /// Begins anew, with all reaches that are remembered now.
    pub fn begin(&mut self) {
        self.remaining = STEPS;
        self.score = f64::NEG_INFINITY;
    }

    /// Refuses what is no state of a fit.
    pub fn check(&self) -> Result<(), Implausible> {
        ensure(self.remaining <= STEPS, "preshape.fitting.remaining", "no more steps than a fit has")?;
        ensure(!self.score.is_nan(), "preshape.fitting.score", "a number")?;
        finite("preshape.fitting.means", &self.means)?;
        finite("preshape.fitting.best", &self.best)
    }

    /// One step. `whole` and `phases` are the priors; `possible` tells which classes the task has parts of.
    pub fn step(
        &mut self,
        whole: &Hierarchy,
        phases: &[Hierarchy],
        possible: [bool; CLASSES],
        person: &mut PersonModel,
    ) {
        if self.remaining == 0 {
            return;
        }
        self.remaining -= 1;
        let levels = READ as u64;
        if self.remaining >= levels {
            let done = STARTS * SWEEPS - 1 - (self.remaining - levels);
            self.sweep(done, whole, possible, person);
        } else {
            self.adapt(self.remaining as usize, whole, phases, possible, person);
        }
    }

    fn sweep(&mut self, done: u64, whole: &Hierarchy, possible: [bool; CLASSES], person: &PersonModel) {
        if done.is_multiple_of(SWEEPS) {
            self.means = start(done / SWEEPS, whole, person).into();
        }
        let means = Vector3::from(self.means);
        let mut counts = Counts::default();
        let mut score = whole.prior(&means);
        for reach in person.past() {
            let (responsibility, evidence) = responsibilities(whole.fit(reach.whole, &means), possible);
            counts.add(&responsibility, reach.whole);
            score += evidence;
        }
        if done % SWEEPS == SWEEPS - 1 && score > self.score {
            (self.best, self.score) = (self.means, score);
        }
        self.means = whole.posterior(&counts).0.into();
    }

    /// Takes the responsibilities of the best fit over to the phase `level`.
    fn adapt(
        &self,
        level: usize,
        whole: &Hierarchy,
        phases: &[Hierarchy],
        possible: [bool; CLASSES],
        person: &mut PersonModel,
    ) {
        let means = Vector3::from(self.best);
        let mut counts = Counts::default();
        for reach in person.past() {
            let (responsibility, _) = responsibilities(whole.fit(reach.whole, &means), possible);
            counts.add(&responsibility, reach.phase[level]);
        }
        person.own[level] = OwnLevel::of(&phases[level], &counts);
        person.adapted = Flag::Set;
    }
}

impl OwnLevel {
    /// The posterior of one person's class means.
    pub fn of(prior: &Hierarchy, counts: &Counts) -> Self {
        let (mean, variance) = prior.posterior(counts);
        Self { mean: mean.into(), variance: variance.into() }
    }
}

/// Where a fit starts.
fn start(index: u64, whole: &Hierarchy, person: &PersonModel) -> Vector3<f64> {
    let past = person.past();
    if index == 0 || past.is_empty() {
        return whole.mean;
    }
    let own = past.iter().map(|reach| reach.whole).sum::<f64>() / past.len() as f64;
    whole.mean.add_scalar(own - whole.mean.mean())
}

/// How far each of the possible classes explains one reach (fractions), and the logarithm of how well they explain it together.
fn responsibilities(fit: [f64; CLASSES], possible: [bool; CLASSES]) -> ([f64; CLASSES], f64) {
    let allowed = |class: usize| if possible[class] { fit[class] } else { f64::NEG_INFINITY };
    let best = (0..CLASSES).map(allowed).fold(f64::NEG_INFINITY, f64::max);
    let weights: [f64; CLASSES] = std::array::from_fn(|class| (allowed(class) - best).exp());
    let sum: f64 = weights.iter().sum();
    (weights.map(|weight| weight / sum), best + sum.ln())
}
