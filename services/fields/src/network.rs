use crate::due_kinds::{Beforehand, DueKinds};
use crate::likely::Likely;
use crate::selection_field::SelectionField;
use crate::{Projections, destination_field, grip_field, sources};
use coact_joint_task::{LayerPlan, NetworkPlan, Synapse};
use coact_messages::{Decision, FieldFrame, LayerKind, NONE, Percept};
use coact_neural_field::{Field, ParameterError, forget};
use coact_period::PERIOD;
use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;

/// Step of the integration in ms, the unit in which layers give their tau.
const STEP_MS: f64 = PERIOD.as_millis() as f64;
/// Signal of a population above which its peak has formed: half of a full peak's.
const DECIDED: f64 = 0.5;

/// 2^64 divided by the golden ratio: neighbouring ticks, multiplied by it, become seeds far apart (Fibonacci hashing,
/// Knuth, *The Art of Computer Programming* 3, 6.4).
const GOLDEN_RATIO: u64 = 0x9e37_79b9_7f4a_7c15;

/// The network stage: percept in, field frame out, one period at a time.
pub struct Network {
    plan: NetworkPlan,
    projections: Projections,
    task: u64,
    seed: u64,
    destinations: SelectionField,
    grips: SelectionField,
    due: DueKinds,
    fields: Vec<Field>,
    /// Signals of all populations, then the values of the percept's channels.
    sources: Vec<f64>,
    /// Input strength of each population.
    strength: Vec<f64>,
    /// For each population, how surely what supported its memory is gone.
    gone: Vec<f64>,
}

impl Network {
    /// The network of `plan`; `task` is the fingerprint of the task, `seed` that of the noise.
    ///
    /// # Errors
    /// A layer's constant that is out of its range.
    pub fn new(plan: NetworkPlan, task: u64, seed: u64) -> Result<Self, ParameterError> {
        let field = |layer: &LayerPlan| {
            Field::new(layer.parameters, layer.populations.len(), plan.sites_per_population)
        };
        let populations = plan.populations.len();
        Ok(Self {
            destinations: SelectionField::new(&plan.destinations)?,
            grips: SelectionField::new(&plan.grips)?,
            due: DueKinds::of(&plan),
            fields: plan.layers.iter().map(field).collect::<Result<_, _>>()?,
            sources: vec![0.0; populations + plan.channels.len()],
            strength: vec![0.0; populations],
            gone: vec![0.0; populations],
            projections: Projections::of(&plan),
            plan,
            task,
            seed,
        })
    }

    /// The plan that it was made from.
    pub fn plan(&self) -> &NetworkPlan {
        &self.plan
    }

    /// Writes the frame of the network at rest: what the first step starts from.
    pub fn rest(&self, out: &mut FieldFrame) {
        let width = self.plan.sites_per_population;
        self.describe(out);
        out.input.fill(0.0);
        out.signal.fill(0.0);
        out.since.fill(0);
        out.decision = Decision { action: NONE, reserved: 0, since: 0 };
        out.destination[..self.destinations.sites()].fill(self.plan.destinations.resting);
        out.grip[..self.grips.sites()].fill(self.plan.grips.resting);
        for layer in &self.plan.layers {
            let SiteRange { first, last } = sites(layer, width);
            out.activity[first..last].fill(layer.resting);
            out.resting[layer.populations.clone()].fill(layer.resting);
        }
        out.seal();
    }

    /// Whether `frame` is a state of this network, so that it can be resumed from.
    pub fn fits(&self, frame: &FieldFrame) -> bool {
        let (table, width) = (&frame.layers, self.plan.sites_per_population);
        let stands_there = |(index, layer): (usize, &LayerPlan)| {
            let SiteRange { first, last } = sites(layer, width);
            let found = [table.kind[index], table.first_site[index], table.sites[index]];
            let found = (found, table.first_population[index], table.populations[index]);
            let expected = [layer.kind as u32, first as u32, (last - first) as u32];
            found == (expected, layer.populations.start as u32, layer.populations.len() as u32)
        };
        frame.task == self.task
            && frame.table == self.plan.destinations.grid
            && frame.shapes == self.plan.grips.grid
            && table.count as usize == self.plan.layers.len()
            && self.plan.layers.iter().enumerate().all(stands_there)
    }

    /// Integrates one period from `previous` into `out`.
    ///
    /// Costs about 14 multiplications per site of a layer, 20 per site of the fields that select, one exponential per site and one
    /// multiplication per synapse.
    pub fn step(
        &mut self,
        tick: u64,
        percept: Option<&Percept>,
        previous: &FieldFrame,
        out: &mut FieldFrame,
    ) {
        self.describe(out);
        let percept = percept.filter(|percept| sources::is_fresh(tick, percept));
        let beforehand = self.due.beforehand(&previous.signal);
        sources::collect(&self.plan, percept, previous, &beforehand, &mut self.sources);
        self.select(percept, &beforehand, previous, out);
        self.transmit(tick);
        for index in 0..self.plan.layers.len() {
            self.integrate(index, previous, out);
        }
        let peaks = self.strength.len();
        for index in 0..peaks {
            out.since[index] = match (out.signal[index] > 0.0, previous.since[index]) {
                (false, _) => 0,
                (true, 0) => tick.max(1),
                (true, since) => since,
            };
        }
        out.decision = self.decision(out);
        out.seal();
    }

    /// Moves the fields that select on: where the hand goes, and with which grip.
    fn select(
        &mut self,
        percept: Option<&Percept>,
        beforehand: &Beforehand,
        previous: &FieldFrame,
        out: &mut FieldFrame,
    ) {
        let likely = percept.map(|percept| Likely { destinations: &percept.destinations, beforehand });
        let places = likely.into_iter().flat_map(destination_field::drives);
        self.destinations.step(STEP_MS, places, &previous.destination, &mut out.destination);
        let told = percept.zip(likely).into_iter();
        let grips = told.flat_map(|(percept, likely)| grip_field::drives(percept, likely, &self.plan.widths));
        self.grips.step(STEP_MS, grips, &previous.grip, &mut out.grip);
    }

    /// Fills the parts of the frame that never change.
    fn describe(&self, out: &mut FieldFrame) {
        let width = self.plan.sites_per_population;
        out.task = self.task;
        out.noise_seed = self.seed;
        out.table = self.plan.destinations.grid;
        out.shapes = self.plan.grips.grid;
        out.layers.count = self.plan.layers.len() as u32;
        out.layers.reserved = 0;
        for (index, layer) in self.plan.layers.iter().enumerate() {
            let SiteRange { first, last } = sites(layer, width);
            out.layers.kind[index] = layer.kind as u32;
            out.layers.first_site[index] = first as u32;
            out.layers.sites[index] = (last - first) as u32;
            out.layers.first_population[index] = layer.populations.start as u32;
            out.layers.populations[index] = layer.populations.len() as u32;
        }
    }

    /// Sends the sources through the synapse table (chapter, eq. 4), adds noise.
    fn transmit(&mut self, tick: u64) {
        self.projections.gather(&self.sources, &mut self.strength);
        // The generator is made anew from seed and tick, so that a restarted network makes the same noise.
        let mut random = Pcg64Mcg::seed_from_u64(self.seed ^ tick.wrapping_mul(GOLDEN_RATIO));
        for layer in &self.plan.layers {
            for strength in &mut self.strength[layer.populations.clone()] {
                if layer.noise > 0.0 {
                    let normal: f64 = StandardNormal.sample(&mut random);
                    *strength += layer.noise * normal;
                }
                *strength *= layer.gain;
            }
        }
        self.gone.fill(0.0);
        for &Synapse { from, to, .. } in &self.plan.forgetting {
            self.gone[to] = self.gone[to].max(self.sources[from]);
        }
    }

    fn integrate(&mut self, index: usize, previous: &FieldFrame, out: &mut FieldFrame) {
        let layer = &self.plan.layers[index];
        let field = &mut self.fields[index];
        let rows = layer.populations.clone();
        let SiteRange { first, last } = sites(layer, self.plan.sites_per_population);
        for population in rows.clone() {
            out.resting[population] = match &layer.forgetting {
                None => layer.resting,
                Some(forgetting) => {
                    let c = self.gone[population] * f64::from(self.sources[population] > 0.0);
                    forget(previous.resting[population], c, STEP_MS, forgetting)
                }
            };
        }
        let input = &mut out.input[first..last];
        field.spread(&self.strength[rows.clone()], input);
        let next = &mut out.activity[first..last];
        field.step(STEP_MS, &previous.activity[first..last], input, &out.resting[rows.clone()], next);
        field.signals(next, &mut out.signal[rows]);
    }

    /// The action whose peak stands in AEL: the highest, should two ever stand.
    fn decision(&self, out: &FieldFrame) -> Decision {
        let layer = self.plan.layer(LayerKind::ActionExecution).populations.clone();
        let mut decision = Decision { action: NONE, reserved: 0, since: 0 };
        let mut highest = DECIDED;
        for (action, population) in layer.enumerate() {
            if out.signal[population] > highest {
                highest = out.signal[population];
                decision = Decision { action: action as u32, reserved: 0, since: out.since[population] };
            }
        }
        decision
    }
}

/// Sites of one layer in the frame's rows.
struct SiteRange {
    first: usize,
    last: usize,
}

fn sites(layer: &LayerPlan, width: usize) -> SiteRange {
    SiteRange { first: layer.populations.start * width, last: layer.populations.end * width }
}
