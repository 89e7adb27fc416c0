use crate::extraction::{LabelledReach, USUAL_TEMPO, extract};
use crate::level_fit::{PersonFeatures, level, rounded};
use crate::movement_fit::movement;
use crate::parallel::in_parallel;
use anyhow::Context;
use coact_joint_task::Task;
use coact_perception::{
    CLASSES, CURVE_BEGINS, FEATURES, PreshapeModel, READ, ReachRecord, SNAPSHOTS, SingularModel, WHOLE,
};
use coact_recordings::{Order, Reach, Size};
use coact_robot::Robot;
use nalgebra::DVector;

/// Why no model could be made.
#[derive(Debug, thiserror::Error)]
pub enum TrainError {
    /// The recordings do not suffice.
    #[error(
        "{people} people with {reaches} usable reaches: expected at least three people, each with two or more reaches for \
         every size"
    )]
    TooFew {
        /// How many people.
        people: usize,
        /// How many reaches.
        reaches: usize,
    },
    /// A model could not be used.
    #[error(transparent)]
    Singular(#[from] SingularModel),
}

/// The model that the recordings of some people make. Repeatable bit by bit.
///
/// # Errors
/// [`TrainError`] when the recordings do not suffice.
pub fn train(
    task: &Task,
    robot: &Robot,
    reaches: &[Reach],
    order: Order,
) -> Result<PreshapeModel, TrainError> {
    fit(&extract_each(task, robot, &order.people(reaches))?)
}

/// For each of these people the model that the recordings of all others make. Repeatable bit by bit.
///
/// # Errors
/// The others' recordings do not suffice.
pub fn leave_one_out(
    task: &Task,
    robot: &Robot,
    reaches: &[Reach],
    order: Order,
) -> anyhow::Result<Vec<(u32, PreshapeModel)>> {
    let people = order.people(reaches);
    let labelled = extract_each(task, robot, &people)?;
    let of_others = |person: &Vec<&Reach>| {
        let participant = person[0].participant;
        let others = labelled.iter().filter(|reach| reach.participant != participant);
        let model = fit(&others.cloned().collect::<Vec<_>>())
            .with_context(|| format!("leaving out participant {participant}"))?;
        Ok((participant, model))
    };
    people.iter().map(of_others).collect()
}

fn extract_each(
    task: &Task,
    robot: &Robot,
    people: &[Vec<&Reach>],
) -> Result<Vec<LabelledReach>, TrainError> {
    Ok(in_parallel(people, |person| extract(task, robot, person))?.concat())
}

/// The model that these reaches make.
fn fit(labelled: &[LabelledReach]) -> Result<PreshapeModel, TrainError> {
    let mut people: Vec<u32> = labelled.iter().map(|reach| reach.participant).collect();
    people.sort_unstable();
    people.dedup();
    let too_few = || TrainError::TooFew { people: people.len(), reaches: labelled.len() };
    let make = |features: &dyn Fn(&ReachRecord) -> Vec<f64>| {
        let all: Vec<PersonFeatures> =
            people.iter().map(|person| by_class(labelled, *person, features)).collect();
        level(&all).ok_or_else(too_few)
    };
    let phase = (0..READ).map(|at| make(&|record| record.features[at].to_vec())).collect::<Result<_, _>>()?;
    let whole = make(&|record| record.whole().to_vec())?;
    Ok(PreshapeModel {
        sizes: Size::ALL.map(Size::width),
        tempo: rounded(median_tempo(labelled)),
        phase,
        whole,
        movement: movement(labelled.iter().filter_map(|reach| reach.curve.as_ref())).ok_or_else(too_few)?,
    })
}

fn by_class(
    labelled: &[LabelledReach],
    participant: u32,
    features: &dyn Fn(&ReachRecord) -> Vec<f64>,
) -> PersonFeatures {
    let of_class = |class: usize| {
        let own = labelled.iter().filter(|reach| reach.participant == participant && reach.class == class);
        own.map(|reach| DVector::from_vec(features(&reach.record))).collect()
    };
    std::array::from_fn::<_, CLASSES, _>(of_class)
}

fn median_tempo(labelled: &[LabelledReach]) -> f64 {
    let mut tempos: Vec<f64> = labelled.iter().map(|reach| reach.record.tempo).collect();
    tempos.sort_unstable_by(f64::total_cmp);
    tempos.get(tempos.len() / 2).copied().unwrap_or(USUAL_TEMPO)
}

/// The text of a model file: the numbers, and where they come from. `source` names the recordings.
///
/// # Errors
/// When the model cannot be written as TOML, which a trained one can.
pub fn model_file(
    model: &PreshapeModel,
    reaches: &[Reach],
    source: &str,
) -> Result<String, toml::ser::Error> {
    let mut people: Vec<u32> = reaches.iter().map(|reach| reach.participant).collect();
    people.dedup();
    let people: Vec<String> = people.iter().map(u32::to_string).collect();
    let numbers = toml::to_string(model)?;
    Ok(format!(
        "# How people shape their hand on the way to small, medium and large objects: made by `coact train`, read by\n\
         # perception. Not to be edited: make it anew from the recordings.\n\
         #\n\
         # source     {source}: {count} reaches of {number} people (participants {people})\n\
         # features   {FEATURES} lengths in m: thumb to middle tip, wrist to thumb tip, displacement of the\n\
         #            wrist; read at {read:?} of the person's tempo\n\
         #            (s: time to 80 % of the way to the slow phase; contact comes at about 1.8); and at\n\
         #            {whole:?} together when the reach is over (whole)\n\
         # method     Fisher's discriminant; Gaussian hierarchy of size class, person, person's class, and reach, by\n\
         #            moments in closed form. sizes: widths of the classes, m\n\
         # movement   way of the middle between thumb and index tip: mean and principal components, [along, aside] the straight\n\
         #            line in units of its length, from {CURVE_BEGINS} to 1 of the time from a tenth of the way to contact\n\
         # licence    the recordings are under the MIT licence (Dagioglou, Soulounias, Giannakopoulos 2022)\n\n\
         {numbers}",
        read = &SNAPSHOTS[..READ],
        whole = WHOLE.map(|at| SNAPSHOTS[at]),
        count = reaches.len(),
        number = people.len(),
        people = people.join(", "),
    ))
}
