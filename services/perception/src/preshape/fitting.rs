use super::hierarchy::{Counts, Hierarchy};
use super::person_model::{OwnLevel, PersonModel};
use super::preshape_model::{CLASSES, READ};
use bytemuck::{Pod, Zeroable};
use coact_stage_state::{Flag, Implausible, ensure, finite};
use nalgebra::Vector3;

/// Sweeps of expectation maximisation from each start. Chosen by hand: in one dimension with three classes it has converged
/// by then, and one sweep a cycle keeps the whole fit within 80 ms.
const SWEEPS: u64 = 15;
/// Starts: see [`start`].
const STARTS: u64 = 2 + CLASSES as u64;
/// Steps of a fit: all sweeps, then the phases of the way.
const STEPS: u64 = STARTS * SWEEPS + READ as u64;
/// Reaches of each class that every person has made beforehand, as it were: a Dirichlet prior of the classes' shares.
/// Chosen by hand: with fewer, people whose hands are unlike others' are taken for ones who grasp one size; with more, those who
/// grasp one size for ones with other hands.
const PRIOR_REACHES: f64 = 10.0;
/// How much more frequent one class is than any other where a fit starts with nearly all of one.
const MOSTLY: f64 = 10.0;

/// The mixture of size classes, being fitted to one person's reaches: one sweep in each cycle, so that no cycle
/// carries the whole burden.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(crate) struct Fitting {
    /// Steps that remain; 0 = idle.
    remaining: u64,
    /// The mixture of the present start.
    mixture: Mixture,
    /// The best start's, and how well it fits.
    best: Mixture,
    score: f64,
}

/// How one person's reaches are made up.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Mixture {
    /// Class means of whole reaches.
    means: [f64; CLASSES],
    /// Logarithm of each class's share; minus infinity of what the task has no parts of.
    shares: [f64; CLASSES],
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
        [self.mixture, self.best].iter().try_for_each(|mixture| {
            finite("preshape.fitting.means", &mixture.means)?;
            ensure(
                mixture.shares.iter().all(|share| *share <= 0.0),
                "preshape.fitting.shares",
                "logarithms of shares",
            )
        })
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
            self.adapt(self.remaining as usize, whole, phases, person);
        }
    }

    fn sweep(&mut self, done: u64, whole: &Hierarchy, possible: [bool; CLASSES], person: &PersonModel) {
        if done.is_multiple_of(SWEEPS) {
            self.mixture = start(done / SWEEPS, whole, possible, person);
        }
        let mut counts = Counts::default();
        let mut score = self.mixture.prior(whole);
        for reach in person.past() {
            let (responsibility, evidence) = self.mixture.responsibilities(whole, reach.whole);
            counts.add(&responsibility, reach.whole);
            score += evidence;
        }
        if done % SWEEPS == SWEEPS - 1 && score > self.score {
            (self.best, self.score) = (self.mixture, score);
        }
        self.mixture = Mixture {
            means: whole.posterior(&counts).0.into(),
            shares: shares(possible, |class| counts.weight(class) + PRIOR_REACHES),
        };
    }

    /// Takes the responsibilities of the best fit over to the phase `level`.
    fn adapt(&self, level: usize, whole: &Hierarchy, phases: &[Hierarchy], person: &mut PersonModel) {
        let mut counts = Counts::default();
        for reach in person.past() {
            let (responsibility, _) = self.best.responsibilities(whole, reach.whole);
            counts.add(&responsibility, reach.phase[level]);
        }
        person.own[level] = OwnLevel::of(&phases[level], &counts);
        person.adapted = Flag::Set;
    }
}

impl Mixture {
    /// How far each class explains one reach (fractions), and the logarithm of how well they explain it together.
    fn responsibilities(&self, whole: &Hierarchy, at: f64) -> ([f64; CLASSES], f64) {
        let fit = whole.fit(at, &Vector3::from(self.means));
        let each: [f64; CLASSES] = std::array::from_fn(|class| fit[class] + self.shares[class]);
        let best = each.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let weights = each.map(|one| (one - best).exp());
        let sum: f64 = weights.iter().sum();
        (weights.map(|weight| weight / sum), best + sum.ln())
    }

    /// Logarithm of how likely such a person is beforehand, up to a constant.
    fn prior(&self, whole: &Hierarchy) -> f64 {
        let shares: f64 = self.shares.iter().filter(|share| share.is_finite()).sum();
        whole.prior(&Vector3::from(self.means)) + PRIOR_REACHES * shares
    }
}

/// Logarithms of shares of the possible classes, in proportion to their weights.
fn shares(possible: [bool; CLASSES], weight: impl Fn(usize) -> f64) -> [f64; CLASSES] {
    let own = |class: usize| if possible[class] { weight(class) } else { 0.0 };
    let sum: f64 = (0..CLASSES).map(own).sum();
    std::array::from_fn(|class| (own(class) / sum).ln())
}

impl OwnLevel {
    /// The posterior of one person's class means.
    pub fn of(prior: &Hierarchy, counts: &Counts) -> Self {
        let (mean, variance) = prior.posterior(counts);
        Self { mean: mean.into(), variance: variance.into() }
    }
}

/// Where a fit starts: people's means, and the same moved by the person's overall offset, with equal shares; and people's means
/// where nearly all reaches were of one class. From one alone, a person with small or large hands could be taken for one who
/// grasps other sizes, and one who grasps one size for one with other hands.
fn start(index: u64, whole: &Hierarchy, possible: [bool; CLASSES], person: &PersonModel) -> Mixture {
    let past = person.past();
    let own = past.iter().map(|reach| reach.whole).sum::<f64>() / past.len().max(1) as f64;
    let means = match index {
        1 if !past.is_empty() => whole.mean.add_scalar(own - whole.mean.mean()),
        _ => whole.mean,
    };
    let alone = index.checked_sub(2).map(|class| class as usize);
    let weight = |class: usize| if alone == Some(class) { MOSTLY } else { 1.0 };
    Mixture { means: means.into(), shares: shares(possible, weight) }
}
