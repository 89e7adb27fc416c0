use super::scenario_source::ScenarioSource;
use super::staging::{Blind, During, MOST_OCCLUDERS, MOST_SLIPS, Occluder, Sense, Slip, Staging};
use crate::WorldError;
use coact_joint_task::{Agent, Part, Task};
use serde::Deserialize;
use toml::Spanned;

/// Smallest distance between two parts on the table, m: the physics engine must not begin in a penetration.
const ROOM: f64 = 0.01;

/// `[start]`: how the scene is when the run begins.
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct StartTable {
    /// Subgoals whose parts are in place.
    #[serde(default)]
    achieved: Vec<Spanned<String>>,
    #[serde(default)]
    part: Vec<PartLine>,
}

/// `[[start.part]]`: the next part of this kind that the task lays in this workspace lies elsewhere.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct PartLine {
    kind: Spanned<String>,
    workspace: Agent,
    at: Spanned<[f64; 2]>,
}

/// `[[occluder]]`: a box that hides what is behind it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct OccluderLine {
    centre: Spanned<[f64; 3]>,
    size: Spanned<[f64; 3]>,
    from: Spanned<f64>,
    until: Option<Spanned<f64>>,
}

/// `[[blind]]`: a time in which sensors deliver nothing.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct BlindLine {
    from: Spanned<f64>,
    until: Option<Spanned<f64>>,
    what: Option<Sense>,
}

/// `[[slip]]`: once, the robot's fingers lose a part.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct SlipLine {
    kind: Spanned<String>,
    after: Spanned<f64>,
    to: Option<Spanned<[f64; 2]>>,
}

impl ScenarioSource<'_> {
    pub fn staging(
        &self,
        start: &StartTable,
        occluders: &[Spanned<OccluderLine>],
        blinds: &[BlindLine],
        slips: &[Spanned<SlipLine>],
    ) -> Result<Staging, WorldError> {
        if let Some(surplus) = occluders.get(MOST_OCCLUDERS) {
            let message = format!("table \"occluder\": expected at most {MOST_OCCLUDERS} of them");
            return Err(self.fault(surplus.span().start, message));
        }
        if let Some(surplus) = slips.get(MOST_SLIPS) {
            let message = format!("table \"slip\": expected at most {MOST_SLIPS} of them");
            return Err(self.fault(surplus.span().start, message));
        }
        let mut staging = Staging {
            occluders: occluders.iter().map(|line| self.occluder(line.as_ref())).collect::<Result<_, _>>()?,
            blinds: blinds.iter().map(|line| self.blind(line)).collect::<Result<_, _>>()?,
            slips: slips.iter().map(|line| self.slip(line.as_ref())).collect::<Result<_, _>>()?,
            ..Staging::default()
        };
        for line in &start.part {
            let moved = self.moved(line, &staging.moved)?;
            staging.moved.push(moved);
        }
        for name in &start.achieved {
            staging.achieved.push(self.subgoal("start.achieved", name)?);
        }
        self.check_achieved(&start.achieved, &staging)?;
        self.check_places(&start.part, &staging)?;
        Ok(staging)
    }

    fn occluder(&self, line: &OccluderLine) -> Result<Occluder, WorldError> {
        let (centre, size) = (line.centre.as_ref(), line.size.as_ref());
        if !centre.iter().all(|value| value.abs() <= 10.0) {
            let message = "key \"occluder.centre\": expected x, y, z within 10 m of the robot".into();
            return Err(self.fault(line.centre.span().start, message));
        }
        if !size.iter().all(|value| *value > 0.0 && *value <= 10.0) {
            let message = "key \"occluder.size\": expected three extents above 0 and up to 10 m".into();
            return Err(self.fault(line.size.span().start, message));
        }
        let block = std::array::from_fn(|axis| if axis < 3 { centre[axis] } else { 0.5 * size[axis - 3] });
        Ok(Occluder { block, during: self.during("occluder", &line.from, line.until.as_ref())? })
    }

    fn blind(&self, line: &BlindLine) -> Result<Blind, WorldError> {
        let during = self.during("blind", &line.from, line.until.as_ref())?;
        Ok(Blind { what: line.what.unwrap_or(Sense::Hand), during })
    }

    fn during(
        &self,
        table: &str,
        from: &Spanned<f64>,
        until: Option<&Spanned<f64>>,
    ) -> Result<During, WorldError> {
        let first = self.cycles(&format!("{table}.from"), from)?;
        let Some(until) = until else { return Ok(During(first, u64::MAX)) };
        let end = self.cycles(&format!("{table}.until"), until)?;
        if end <= first {
            let message = format!("key \"{table}.until\": expected a time after \"from\"");
            return Err(self.fault(until.span().start, message));
        }
        Ok(During(first, end))
    }

    fn slip(&self, line: &SlipLine) -> Result<Slip, WorldError> {
        let kind = self.kind("slip.kind", &line.kind)?;
        if let Some(to) = &line.to {
            let lies = [to.as_ref()[0], to.as_ref()[1]];
            if !on_table(self.task, lies, 0.0) {
                let message = "key \"slip.to\": expected a place on the table top, m".into();
                return Err(self.fault(to.span().start, message));
            }
        }
        let after = self.cycles("slip.after", &line.after)?;
        Ok(Slip { kind, after, to: line.to.as_ref().map(|to| *to.as_ref()) })
    }

    fn moved(&self, line: &PartLine, before: &[(usize, [f64; 2])]) -> Result<(usize, [f64; 2]), WorldError> {
        let kind = self.kind("start.part.kind", &line.kind)?;
        let fits = |(index, part): &(usize, &Part)| {
            part.kind == kind
                && part.workspace == line.workspace
                && before.iter().all(|(moved, _)| moved != index)
        };
        let found = self.task.parts.iter().enumerate().find(fits).map(|(index, _)| index);
        let part = found.ok_or_else(|| {
            let message = format!(
                "key \"start.part.kind\": the task lays no (further) \"{}\" in this workspace",
                line.kind.as_ref()
            );
            self.fault(line.kind.span().start, message)
        })?;
        Ok((part, *line.at.as_ref()))
    }

    /// Every subgoal needs a part, and those that come before it.
    fn check_achieved(&self, names: &[Spanned<String>], staging: &Staging) -> Result<(), WorldError> {
        let goals = &self.task.subgoals;
        let achieved = staging.achieved.iter().fold(0, |mask, goal| mask | 1 << goal);
        for (name, &goal) in names.iter().zip(&staging.achieved) {
            let missing = goals[goal].after.iter().find(|before| !staging.achieved.contains(before));
            let missing = missing.map(|&before| &goals[before].name);
            let open = goals[goal].after_choices.iter().map(|&choice| &self.task.choices[choice]);
            let open = open.filter(|choice| !choice.is_made(achieved)).map(|choice| &choice.name).next();
            if let Some(before) = missing.or(open) {
                let message = format!(
                    "key \"start.achieved\": \"{}\" comes after \"{before}\"; expected that one as well",
                    goals[goal].name
                );
                return Err(self.fault(name.span().start, message));
            }
        }
        let mounted = staging.mounted(self.task);
        if let Some(last) = names.last().filter(|_| mounted.len() < names.len()) {
            let message = "key \"start.achieved\": expected each subgoal once, and a part for each".into();
            return Err(self.fault(last.span().start, message));
        }
        Ok(())
    }

    /// Moved parts lie on the table in one of the workspaces, apart from what lies there already.
    fn check_places(&self, lines: &[PartLine], staging: &Staging) -> Result<(), WorldError> {
        let mut task = self.task.clone();
        staging.lay(&mut task);
        let mounted = staging.mounted(&task);
        let lies = |part: &usize| mounted.iter().all(|(_, mounted)| mounted != part);
        for (line, &(part, at)) in lines.iter().zip(&staging.moved) {
            let fault = |message: String| self.fault(line.at.span().start, message);
            let radius = radius(&task, part);
            let within = |[low, high]: &[[f64; 2]; 2]| {
                (0..2).all(|axis| at[axis] >= low[axis] && at[axis] <= high[axis])
            };
            if !on_table(&task, at, radius) || !task.scene.workspace.iter().any(within) {
                let message =
                    "key \"start.part.at\": expected a place on the table, in one of the workspaces";
                return Err(fault(message.into()));
            }
            for other in (0..task.parts.len()).filter(|other| *other != part).filter(lies) {
                let [x, y] = task.parts[other].at;
                let apart = (at[0] - x).hypot(at[1] - y);
                let least = radius + self::radius(&task, other) + ROOM;
                if apart < least {
                    let name = &task.kinds[task.parts[other].kind].name;
                    return Err(fault(format!(
                        "key \"start.part.at\": {apart:.3} m from \"{name}\" at [{x}, {y}]; expected {least:.3} m or more"
                    )));
                }
            }
        }
        Ok(())
    }
}

/// Radius of the circle that a part needs on the table, m.
fn radius(task: &Task, part: usize) -> f64 {
    task.kinds[task.parts[part].kind].shape.radius()
}

fn on_table(task: &Task, at: [f64; 2], radius: f64) -> bool {
    let scene = &task.scene;
    (0..2).all(|axis| (at[axis] - scene.table_centre[axis]).abs() + radius <= 0.5 * scene.table_size[axis])
}
