//! The fields that select, as a network file describes them: over the places that the person's hand may go to, and over the grips that it may
//! take a part with.

use crate::network_file::{LEAST_TAU, SelectionEntry};
use crate::source_file::SourceFile;
use crate::{Scene, SelectionPlan, Task, TaskError};
use coact_messages::{ArmSide, MAX_GRIP_SITES, MAX_PLACES, SiteGrid};
use coact_neural_field::{Axis, MetricConstants};
use toml::Spanned;

/// Finest spacing of both fields: finer, no table, and no range of grips, would fit. m, and degrees and m.
const LEAST_SPACING: [[f64; 2]; 2] = [[0.01, 0.01], [1.0, 0.001]];
/// How far the destination field reaches beyond workspaces, handover place and resting hand, m: peaks at its edge are whole. Chosen by hand.
const BEYOND_PLACES: [f64; 2] = [0.10, 0.10];
/// How far the grip field reaches beyond the task's grips, rad, and the widths of its parts, m: this person's grips differ from those of the
/// task. Chosen by hand.
const BEYOND_GRIPS: [f64; 2] = [std::f64::consts::FRAC_PI_4, 0.02];

/// The destination field of a network file over the table of a scene, checked.
pub(crate) fn destination_field(
    source: &SourceFile,
    entry: &Spanned<SelectionEntry>,
    scene: &Scene,
) -> Result<SelectionPlan, TaskError> {
    let around = "workspaces, handover place and resting hand; give a larger spacing, or move them together";
    let corners = scene.workspace.into_iter().flatten();
    let elsewhere = [scene.handover, scene.rest(ArmSide::Right), scene.rest(ArmSide::Left)];
    let places: Vec<_> = corners.chain(elsewhere.map(|[x, y, _]| [x, y])).collect();
    let over = Over { places: &places, beyond: BEYOND_PLACES, most: MAX_PLACES, around };
    Entry { source, entry, name: "destinations", least: LEAST_SPACING[0], units: [1.0; 2] }.plan(&over)
}

/// The grip field of a network file over the grips and the widths of a task, checked. Its first axis is in degrees there, in rad here.
pub(crate) fn grip_field(
    source: &SourceFile,
    entry: &Spanned<SelectionEntry>,
    task: &Task,
) -> Result<SelectionPlan, TaskError> {
    let around = "the pitches of all grips and the widths of all parts; give a larger spacing";
    let widths = || task.kinds.iter().map(|kind| kind.width);
    let places: Vec<_> =
        task.grips.iter().flat_map(|grip| widths().map(|width| [grip.pitch, width])).collect();
    let over = Over { places: &places, beyond: BEYOND_GRIPS, most: MAX_GRIP_SITES, around };
    let units = [1_f64.to_radians(), 1.0];
    Entry { source, entry, name: "grips", least: LEAST_SPACING[1], units }.plan(&over)
}

/// What a field lies over.
struct Over<'a> {
    places: &'a [[f64; 2]],
    /// How far it reaches beyond them.
    beyond: [f64; 2],
    /// How many sites a frame holds.
    most: usize,
    /// The places in words, and what to do where they take too many sites.
    around: &'a str,
}

/// The entry of one field.
struct Entry<'a> {
    source: &'a SourceFile,
    entry: &'a Spanned<SelectionEntry>,
    name: &'static str,
    /// Least spacing along both axes, as the file gives it.
    least: [f64; 2],
    /// What the file's unit is in the field's, along both axes.
    units: [f64; 2],
}

impl Entry<'_> {
    fn plan(&self, over: &Over) -> Result<SelectionPlan, TaskError> {
        let entry = self.entry.get_ref();
        self.out_of_range().map_or(Ok(()), |(key, problem)| Err(self.refuse(key, problem)))?;
        let in_field = |values: [f64; 2]| [0, 1].map(|axis| values[axis] * self.units[axis]);
        let plan = SelectionPlan {
            constants: MetricConstants { tau: entry.tau, slope: entry.slope, threshold: 0.0 },
            resting: entry.h,
            gain: entry.gain,
            input_sigma: in_field(entry.input_sigma),
            excitation: entry.excitation.strength,
            excitation_sigma: in_field(entry.excitation.sigma),
            inhibition: entry.inhibition,
            grid: self.grid(over, in_field(entry.spacing))?,
        };
        plan.constants.check().map_err(|error| self.refuse(error.name, error.to_string()))?;
        plan.interaction()
            .map_err(|error| self.refuse(&format!("excitation.{}", error.name), error.to_string()))?;
        Ok(plan)
    }

    fn refuse(&self, key: &str, problem: String) -> TaskError {
        self.source.error(self.entry.span(), format!("{}.{key}", self.name), problem)
    }

    /// The first number that is out of its range, and what was expected.
    fn out_of_range(&self) -> Option<(&'static str, String)> {
        let SelectionEntry { tau, h, gain, spacing, input_sigma, inhibition, .. } = *self.entry.get_ref();
        let excitation = &self.entry.get_ref().excitation;
        let along = |key: &'static str, value: [f64; 2], least: [f64; 2]| {
            [0, 1].map(|axis| (key, value[axis], least[axis]))
        };
        let least = [
            [("tau", tau, LEAST_TAU), ("gain", gain, 0.0)],
            along("spacing", spacing, self.least),
            along("input_sigma", input_sigma, spacing),
            along("excitation.sigma", excitation.sigma, spacing),
            [("inhibition", inhibition, 0.0), ("excitation.strength", excitation.strength, 0.0)],
        ];
        let is_too_little = |(_, value, least): &&(_, f64, f64)| !value.is_finite() || value < least;
        let too_little = least.as_flattened().iter().find(is_too_little);
        let too_little = too_little.map(|(key, value, least)| {
            (*key, format!("{value} is too little; expected a number of at least {least}"))
        });
        let too_high = !(h.is_finite() && h < 0.0);
        too_little.or_else(|| too_high.then(|| ("h", "expected a resting level below 0".to_owned())))
    }

    /// Sites at this distance over all places; none where there is no place.
    fn grid(&self, over: &Over, spacing: [f64; 2]) -> Result<SiteGrid, TaskError> {
        if over.places.is_empty() {
            return Ok(SiteGrid { first: [0.0; 2], spacing, sites: [1; 2] });
        }
        let span = [0, 1].map(|axis| {
            let along = || over.places.iter().map(|place| place[axis]);
            [along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max)]
        });
        let [first, second] = [0, 1].map(|axis| {
            let ([least, most], beyond) = (span[axis], over.beyond[axis]);
            Axis::open(least - beyond, most + beyond, spacing[axis])
        });
        if first.sites.saturating_mul(second.sites) > over.most {
            let given = self.entry.get_ref().spacing;
            let [length, width] = [0, 1].map(|axis| (span[axis][1] - span[axis][0]) / self.units[axis]);
            let problem = format!(
                "{} x {} is too fine for a field that reaches {length:.2} x {width:.2} and more: expected at most {} sites around {}",
                given[0], given[1], over.most, over.around
            );
            return Err(self.refuse("spacing", problem));
        }
        let sites = [first.sites, second.sites].map(|sites| sites as u32);
        Ok(SiteGrid { first: [first.origin, second.origin], spacing, sites })
    }
}
