use crate::plausible::{bounded, ensure, index, not_after, optional};
use crate::{
    Flaw, Header, MAX_GRIP_SITES, MAX_LAYERS, MAX_PLACES, MAX_POPULATIONS, MAX_SITES, Plausible, SiteGrid,
};
use bytemuck::{Pod, Zeroable};
use coact_stage_state::checksum;
use iceoryx2::prelude::ZeroCopySend;

/// The integrator's own state: the whole network of dynamic neural fields at one tick (1 kHz).
///
/// A cycle is computed from the previous frame straight into this one, in the loaned sample. Sites of all layers
/// stand in one row, layer after layer, as [`LayerTable`] says; populations likewise.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
#[type_name("coact::FieldFrame")]
pub struct FieldFrame {
    /// Header.
    pub header: Header,
    /// Fingerprint of the task that made the network; a frame of another task is not resumed from.
    pub task: u64,
    /// Seed of the network's noise. The noise has no state beyond it: the generator is made anew from seed and cycle in
    /// each cycle, so that a restarted network makes the same noise as one that was never interrupted.
    pub noise_seed: u64,
    /// Where each layer's sites and populations stand.
    pub layers: LayerTable,
    /// Where the sites of the destination field lie.
    pub table: SiteGrid,
    /// Where the sites of the grip field lie: the hand's pitch, rad, and the width that it opens for, m.
    pub shapes: SiteGrid,
    /// The chosen action of the action execution layer.
    pub decision: Decision,
    /// Activity u(x, t) of each site (chapter, eq. 1).
    pub activity: [f64; MAX_SITES],
    /// Input S(x, t) of each site in this tick (eq. 4 and external input).
    pub input: [f64; MAX_SITES],
    /// Resting level h of each population; constant but for memory layers, where forgetting moves it.
    pub resting: [f64; MAX_POPULATIONS],
    /// Signal c(t) of each population: 0 at rest, 1 with a full peak (eq. 4).
    pub signal: [f64; MAX_POPULATIONS],
    /// Cycle at which the population's present peak crossed threshold; 0 when it holds no peak.
    pub since: [u64; MAX_POPULATIONS],
    /// Activity u(x, y, t) of the destination field, site by site of [`table`](Self::table): a peak is where the person's hand is going.
    pub destination: [f64; MAX_PLACES],
    /// Activity of the grip field, site by site of [`shapes`](Self::shapes): a peak is how the person's hand takes, or holds, a part.
    pub grip: [f64; MAX_GRIP_SITES],
    /// Of what the next frame is computed from: see [`FieldFrame::is_whole`].
    pub checksum: u64,
}

impl FieldFrame {
    /// Writes the checksum; for the stage, once the frame is complete.
    pub fn seal(&mut self) {
        self.checksum = self.state_checksum();
    }

    /// Whether activities, resting levels, signals and peaks are as they were when the frame was sealed.
    pub fn is_whole(&self) -> bool {
        self.checksum == self.state_checksum()
    }

    fn state_checksum(&self) -> u64 {
        let (sites, populations) = (self.layers.used_sites(), self.layers.used_populations());
        let rows: [&[u64]; 6] = [
            bytemuck::cast_slice(&self.destination[..self.table.used()]),
            bytemuck::cast_slice(&self.grip[..self.shapes.used().min(MAX_GRIP_SITES)]),
            bytemuck::cast_slice(&self.activity[..sites]),
            bytemuck::cast_slice(&self.resting[..populations]),
            bytemuck::cast_slice(&self.signal[..populations]),
            &self.since[..populations],
        ];
        let [destination, grip, activity, resting, signal, since] = rows.map(checksum);
        let [sites, populations] = [sites, populations].map(|count| count as u64);
        checksum(&[self.task, sites, populations, destination, grip, activity, resting, signal, since])
    }

    /// How far the population with this number in the first layer of a kind has come from its resting level to its threshold: 0 at rest, from 1
    /// on its middle is active. 0 where the frame has no such population.
    pub fn excitation(&self, kind: LayerKind, number: usize) -> f64 {
        let table = &self.layers;
        let layers = (table.count as usize).min(MAX_LAYERS);
        let Some(layer) = table.kind[..layers].iter().position(|&own| own == kind as u32) else { return 0.0 };
        let (sites, populations) = (table.sites[layer] as usize, table.populations[layer] as usize);
        if number >= populations {
            return 0.0;
        }
        let width = sites / populations;
        let middle = table.first_site[layer] as usize + number * width + width / 2;
        let own = table.first_population[layer] as usize + number;
        match (self.activity.get(middle), self.resting.get(own)) {
            (Some(activity), Some(resting)) if *resting < 0.0 => 1.0 - activity / resting,
            _ => 0.0,
        }
    }

    /// Populations of the first layer of this kind, as indices into [`signal`](Self::signal) and
    /// [`since`](Self::since); empty when the network has no such layer.
    pub fn populations(&self, kind: LayerKind) -> std::ops::Range<usize> {
        let table = &self.layers;
        let layers = (table.count as usize).min(MAX_LAYERS);
        let Some(layer) = table.kind[..layers].iter().position(|&own| own == kind as u32) else {
            return 0..0;
        };
        let first = (table.first_population[layer] as usize).min(MAX_POPULATIONS);
        first..(first + table.populations[layer] as usize).min(MAX_POPULATIONS)
    }
}

/// Where each layer's sites and populations stand in the rows of a [`FieldFrame`].
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable, ZeroCopySend)]
pub struct LayerTable {
    /// How many layers are valid.
    pub count: u32,
    /// Reserved, zero.
    pub reserved: u32,
    /// [`LayerKind`] of each layer.
    pub kind: [u32; MAX_LAYERS],
    /// First site of each layer.
    pub first_site: [u32; MAX_LAYERS],
    /// Number of sites of each layer.
    pub sites: [u32; MAX_LAYERS],
    /// First population of each layer.
    pub first_population: [u32; MAX_LAYERS],
    /// Number of populations of each layer.
    pub populations: [u32; MAX_LAYERS],
}

/// What the robot has decided to do.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, Pod, Zeroable, ZeroCopySend)]
pub struct Decision {
    /// Index into `Task::actions` of the action whose peak stands in AEL; [`NONE`](crate::NONE) without a peak.
    pub action: u32,
    /// Reserved, zero.
    pub reserved: u32,
    /// Cycle at which that peak crossed threshold.
    pub since: u64,
}

/// The layers of the architecture (chapter, section 3 and figure 2), in the order in which they stand in a frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u32)]
pub enum LayerKind {
    /// AOL: observed acts of the person's hand.
    ActionObservation = 0,
    /// OML of the robot's workspace.
    ObjectMemoryRobot = 1,
    /// OML of the person's workspace.
    ObjectMemoryPerson = 2,
    /// CSGL, first sublayer: achieved subgoals.
    SubgoalsAchieved = 3,
    /// CSGL, second sublayer: subgoals available now.
    SubgoalsAvailable = 4,
    /// ASL: simulated action chains of the person.
    ActionSimulation = 5,
    /// IL: inferred goals of the person.
    Intention = 6,
    /// EML: detected errors.
    ErrorMonitoring = 7,
    /// AEL: the robot's own actions.
    ActionExecution = 8,
}

impl LayerKind {
    /// All layers, in the order in which they stand in a frame.
    pub const ALL: [Self; 9] = [
        Self::ActionObservation,
        Self::ObjectMemoryRobot,
        Self::ObjectMemoryPerson,
        Self::SubgoalsAchieved,
        Self::SubgoalsAvailable,
        Self::ActionSimulation,
        Self::Intention,
        Self::ErrorMonitoring,
        Self::ActionExecution,
    ];

    /// The chapter's name of the layer, as network files write it.
    pub fn name(self) -> &'static str {
        match self {
            Self::ActionObservation => "AOL",
            Self::ObjectMemoryRobot => "OML robot",
            Self::ObjectMemoryPerson => "OML person",
            Self::SubgoalsAchieved => "CSGL achieved",
            Self::SubgoalsAvailable => "CSGL available",
            Self::ActionSimulation => "ASL",
            Self::Intention => "IL",
            Self::ErrorMonitoring => "EML",
            Self::ActionExecution => "AEL",
        }
    }
}

/// Activities, inputs and signals beyond this are none of a network's, whose thresholds are some 10. Chosen by hand.
const MOST: f64 = 1e6;

impl Plausible for FieldFrame {
    fn check(&self) -> Result<(), Flaw> {
        self.layers.check()?;
        self.table.check("table", MAX_PLACES)?;
        self.shapes.check("shapes", MAX_GRIP_SITES)?;
        bounded("destination", &self.destination[..self.table.used()], MOST)?;
        bounded("grip", &self.grip[..self.shapes.used()], MOST)?;
        let (sites, populations) = (self.layers.used_sites(), self.layers.used_populations());
        bounded("activity", &self.activity[..sites], MOST)?;
        bounded("input", &self.input[..sites], MOST)?;
        bounded("resting", &self.resting[..populations], MOST)?;
        bounded("signal", &self.signal[..populations], MOST)?;
        not_after("since", &self.header, &self.since[..populations])?;
        optional("decision.action", self.decision.action, MAX_POPULATIONS)?;
        not_after("decision.since", &self.header, &[self.decision.since])
    }
}

impl LayerTable {
    /// Sites of the rows that belong to a layer; all sites of the table's layers stand before it.
    pub fn used_sites(&self) -> usize {
        self.end(&self.first_site, &self.sites).min(MAX_SITES)
    }

    /// The same for populations.
    pub fn used_populations(&self) -> usize {
        self.end(&self.first_population, &self.populations).min(MAX_POPULATIONS)
    }

    fn end(&self, first: &[u32; MAX_LAYERS], count: &[u32; MAX_LAYERS]) -> usize {
        let layers = (self.count as usize).min(MAX_LAYERS);
        let ends = first.iter().zip(count).map(|(first, count)| *first as usize + *count as usize);
        ends.take(layers).max().unwrap_or(0)
    }

    fn check(&self) -> Result<(), Flaw> {
        index("layers.count", self.count, MAX_LAYERS + 1)?;
        self.kind[..self.count as usize]
            .iter()
            .try_for_each(|kind| index("layers.kind", *kind, LayerKind::ALL.len()))?;
        let sites = self.end(&self.first_site, &self.sites);
        ensure(sites <= MAX_SITES, "layers.sites", "sites that a frame holds")?;
        let populations = self.end(&self.first_population, &self.populations);
        ensure(populations <= MAX_POPULATIONS, "layers.populations", "populations that a frame holds")
    }
}
