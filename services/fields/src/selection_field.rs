use coact_joint_task::SelectionPlan;
use coact_messages::SiteGrid;
use coact_neural_field::{MetricField, ParameterError, sigmoid};

/// Standard deviations beyond which a place's input is cut off: there it is a hundredth.
pub(crate) const CUT_OFF: f64 = 3.0;

/// A field of two dimensions in which what drives it at different places competes (chapter, eq. 1): where the peak stands is selected.
#[derive(Debug, Clone)]
pub(crate) struct SelectionField {
    plan: SelectionPlan,
    field: MetricField<2>,
    input: Vec<f64>,
}

impl SelectionField {
    /// # Errors
    /// A constant that is out of its range.
    pub fn new(plan: &SelectionPlan) -> Result<Self, ParameterError> {
        let field = MetricField::new(plan.constants, plan.interaction()?)?;
        Ok(Self { plan: *plan, input: vec![0.0; field.lattice().sites()], field })
    }

    /// Number of its sites.
    pub fn sites(&self) -> usize {
        self.input.len()
    }

    /// One step of `dt` ms from the activity `now` to `next`, driven at each place by so much of its gain.
    pub fn step(
        &mut self,
        dt: f64,
        drives: impl Iterator<Item = ([f64; 2], f64)>,
        now: &[f64],
        next: &mut [f64],
    ) {
        let (now, next) = (&now[..self.sites()], &mut next[..self.sites()]);
        let mut drives = drives.filter(|(_, drive)| *drive > 0.0).peekable();
        if drives.peek().is_none() && self.is_quiet(now) {
            let rate = dt / self.plan.constants.tau;
            next.iter_mut().zip(now).for_each(|(next, u)| *next = u + rate * (self.plan.resting - u));
            return;
        }
        self.input.fill(0.0);
        for (place, drive) in drives {
            add_gaussian(&self.plan, place, self.plan.gain * drive, &mut self.input);
        }
        self.field.step(dt, now, &self.input, self.plan.resting, next);
    }

    /// Whether all sites are so far below threshold that none acts on another one: there f(u) is below a hundredth. Without input they only
    /// go back to rest then, at a tenth of the cost.
    fn is_quiet(&self, now: &[f64]) -> bool {
        now.iter().fold(f64::NEG_INFINITY, |most, u| most.max(*u)) < 0.5 * self.plan.resting
    }
}

/// Adds a Gaussian around `place` that has this strength at the site nearest to it: wherever between sites it lies, it drives as much.
fn add_gaussian(plan: &SelectionPlan, place: [f64; 2], strength: f64, input: &mut [f64]) {
    let SelectionPlan { grid: SiteGrid { first, spacing, sites }, input_sigma, .. } = plan;
    let range = |axis: usize| {
        let end = f64::from(sites[axis]);
        let number = |at: f64| ((at - first[axis]) / spacing[axis]).clamp(0.0, end).ceil() as usize;
        let reach = CUT_OFF * input_sigma[axis];
        number(place[axis] - reach)..number(place[axis] + reach)
    };
    let share = |axis: usize, site: usize| {
        let deviation = (first[axis] + site as f64 * spacing[axis] - place[axis]) / input_sigma[axis];
        (-0.5 * deviation * deviation).exp()
    };
    let width = sites[1] as usize;
    let most = |axis: usize| range(axis).map(|site| share(axis, site)).fold(f64::MIN_POSITIVE, f64::max);
    let strength = strength / (most(0) * most(1));
    for along_first in range(0) {
        let strength = strength * share(0, along_first);
        for along_second in range(1) {
            input[along_first * width + along_second] += strength * share(1, along_second);
        }
    }
}

/// The signal of a peak at `place`: 0 below threshold and beside the field, 1 with a full peak (eq. 4).
pub(crate) fn signal(plan: &SelectionPlan, activity: &[f64], place: [f64; 2]) -> f64 {
    let Some(site) = plan.grid.site(place) else { return 0.0 };
    let u = activity[site] - plan.constants.threshold;
    if u > 0.0 { 2.0 * sigmoid(u, plan.constants.slope, 0.0) - 1.0 } else { 0.0 }
}
