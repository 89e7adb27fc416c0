use coact_joint_task::LayerPlan;
use coact_neural_field::{Field, ParameterError};
use coact_period::PERIOD_S;

/// The period in ms, the unit of the fields' time constants.
const PERIOD_MS: f64 = PERIOD_S * 1e3;

/// One layer of the network that runs by itself: a field and its state.
pub(crate) struct Layer {
    field: Field,
    gain: f64,
    resting: Vec<f64>,
    now: Vec<f64>,
    next: Vec<f64>,
    input: Vec<f64>,
    /// Signal of each population.
    pub signal: Vec<f64>,
}

impl Layer {
    pub fn new(plan: &LayerPlan, width: usize) -> Result<Self, ParameterError> {
        let field = Field::new(plan.parameters, plan.populations.len(), width)?;
        let (sites, populations) = (field.sites(), field.populations());
        Ok(Self {
            field,
            gain: plan.gain,
            resting: vec![plan.resting; populations],
            now: vec![plan.resting; sites],
            next: vec![0.0; sites],
            input: vec![0.0; sites],
            signal: vec![0.0; populations],
        })
    }

    /// Brings every site to the resting level: no peak stands.
    pub fn rest(&mut self) {
        self.now.fill(self.resting[0]);
        self.signal.fill(0.0);
    }

    /// Advances by one period under inputs in units of the ignition threshold.
    pub fn step(&mut self, strength: &[f64]) {
        let strength: Vec<f64> = strength.iter().map(|strength| self.gain * strength).collect();
        self.field.spread(&strength, &mut self.input);
        self.field.step(PERIOD_MS, &self.now, &self.input, &self.resting, &mut self.next);
        std::mem::swap(&mut self.now, &mut self.next);
        self.field.signals(&self.now, &mut self.signal);
    }
}
