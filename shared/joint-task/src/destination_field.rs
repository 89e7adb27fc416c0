//! The destination field as a network file describes it.

use crate::network_file::{DestinationsEntry, LEAST_TAU};
use crate::source_file::SourceFile;
use crate::{DestinationPlan, Scene, TaskError};
use coact_messages::{ArmSide, MAX_PLACES, TableGrid};
use coact_neural_field::{Axis, MetricConstants};
use toml::Spanned;

/// Finest destination field, m: finer, no table would fit.
const LEAST_SPACING: f64 = 0.01;
/// How far the field reaches beyond workspaces, handover place and resting hand, m: peaks at its edge are whole. Chosen by hand.
const BEYOND: f64 = 0.10;

/// The destination field of a network file over the table of a scene, checked.
pub(crate) fn destination_field(
    source: &SourceFile,
    entry: &Spanned<DestinationsEntry>,
    scene: &Scene,
) -> Result<DestinationPlan, TaskError> {
    let refuse =
        |key: &str, problem: String| source.error(entry.span(), format!("destinations.{key}"), problem);
    let entry = entry.get_ref();
    out_of_range(entry).map_or(Ok(()), |(key, problem)| Err(refuse(key, problem)))?;
    let spacing = entry.spacing;
    let table = over_the_table(scene, spacing).map_err(|[length, width]| {
        let problem = format!(
            "{spacing} m is too fine for a table on which hands go to places {length:.2} m x {width:.2} m apart: expected at most \
             {MAX_PLACES} sites around workspaces, handover place and resting hand; give a larger spacing, or move them together"
        );
        refuse("spacing", problem)
    })?;
    let plan = DestinationPlan {
        constants: MetricConstants { tau: entry.tau, slope: entry.slope, threshold: 0.0 },
        resting: entry.h,
        gain: entry.gain,
        undue: entry.undue,
        input_sigma: entry.input_sigma,
        excitation: (entry.excitation.strength, entry.excitation.sigma),
        inhibition: entry.inhibition,
        table,
    };
    plan.constants.check().map_err(|error| refuse(error.name, error.to_string()))?;
    plan.interaction().map_err(|error| refuse(&format!("excitation.{}", error.name), error.to_string()))?;
    Ok(plan)
}

/// The first number that is out of its range, and what was expected.
fn out_of_range(entry: &DestinationsEntry) -> Option<(&'static str, String)> {
    let DestinationsEntry { tau, h, gain, undue, spacing, input_sigma, inhibition, .. } = *entry;
    let excitation = &entry.excitation;
    let least = [
        ("tau", tau, LEAST_TAU),
        ("spacing", spacing, LEAST_SPACING),
        ("input_sigma", input_sigma, spacing),
        ("excitation.sigma", excitation.sigma, spacing),
        ("gain", gain, 0.0),
        ("inhibition", inhibition, 0.0),
        ("excitation.strength", excitation.strength, 0.0),
    ];
    let is_too_little = |(_, value, least): &(_, f64, f64)| !value.is_finite() || value < least;
    let too_little = least.into_iter().find(is_too_little);
    let too_little = too_little.map(|(key, value, least)| {
        (key, format!("{value} is too little; expected a number of at least {least}"))
    });
    let too_high = !(h.is_finite() && h < 0.0);
    let no_fraction = !(undue > 0.0 && undue <= 1.0);
    too_little
        .or_else(|| too_high.then(|| ("h", "expected a resting level below 0".to_owned())))
        .or_else(|| no_fraction.then(|| ("undue", "expected a number above 0, at most 1".to_owned())))
}

/// Sites at this distance, m, over all places that a hand may go to.
///
/// # Errors
/// There are more sites than a frame holds: how far apart the places are, m, along both axes.
fn over_the_table(scene: &Scene, spacing: f64) -> Result<TableGrid, [f64; 2]> {
    let corners = scene.workspace.into_iter().flatten();
    let places = corners.chain(
        [scene.handover, scene.rest(ArmSide::Right), scene.rest(ArmSide::Left)].map(|[x, y, _]| [x, y]),
    );
    let places: Vec<[f64; 2]> = places.collect();
    let span = [0, 1].map(|axis| {
        let most = places.iter().map(|place| place[axis]).fold(f64::NEG_INFINITY, f64::max);
        let least = places.iter().map(|place| place[axis]).fold(f64::INFINITY, f64::min);
        [least, most]
    });
    let [x, y] = span.map(|[least, most]| Axis::open(least - BEYOND, most + BEYOND, spacing));
    if x.sites.saturating_mul(y.sites) > MAX_PLACES {
        return Err(span.map(|[least, most]| most - least));
    }
    Ok(TableGrid { first: [x.origin, y.origin], spacing, sites: [x, y].map(|axis| axis.sites as u32) })
}
