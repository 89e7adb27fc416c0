//! From the file's names to the task's indices, with every reference checked.

use crate::error::Source;
use crate::file::{ActionEntry, ChainEntry, Each, Name, SceneEntry, SubgoalEntry, TaskFile};
use crate::{Act, Action, Agent, Chain, Fit, Gesture, Grip, Kind, Part, Scene, Subgoal, Task, TaskError};
use coact_messages::{MAX_ACTS, MAX_KINDS, MAX_PARTS, MAX_SUBGOALS};
use std::hash::{DefaultHasher, Hasher};
use std::path::{Path, PathBuf};

/// Reads the task file and names the network file beside it, and that of learned connections, if there is one.
pub(crate) fn load(path: &Path) -> Result<(Task, PathBuf, Option<PathBuf>), TaskError> {
    let source = Source::read(path)?;
    let file: TaskFile = source.parse()?;
    let beside = |name: &Name| path.parent().unwrap_or(Path::new(".")).join(name.get_ref());
    let network = beside(&file.network);
    if !network.is_file() {
        let problem = format!("no file {}; expected a network file, relative to this one", network.display());
        return Err(source.error(file.network.span(), "network", problem));
    }
    let task = Reader { source: &source, file: &file }.task()?;
    Ok((task, network, file.learned.as_ref().map(beside)))
}

struct Reader<'a> {
    source: &'a Source,
    file: &'a TaskFile,
}

impl Reader<'_> {
    fn task(&self) -> Result<Task, TaskError> {
        let kinds = self.kinds()?;
        let subgoals = self.subgoals()?;
        let grips = self.grips()?;
        let gestures = self.gestures()?;
        let chains = self.chains(&kinds)?;
        let acts = acts(grips.len(), gestures.len(), &chains, kinds.len());
        let what = "observable acts (grips x kinds + gestures + spoken chains x kinds + 4)";
        self.within("grip", acts.len(), MAX_ACTS, what)?;
        let mut hash = DefaultHasher::new();
        hash.write(self.source.text().as_bytes());
        Ok(Task {
            name: self.file.name.clone(),
            parts: self.parts()?,
            chains,
            actions: self.actions(&kinds, &subgoals)?,
            scene: scene(&self.file.scene),
            fingerprint: hash.finish(),
            kinds,
            subgoals,
            grips,
            gestures,
            acts,
        })
    }

    fn kinds(&self) -> Result<Vec<Kind>, TaskError> {
        self.within("kind", self.file.kind.len(), MAX_KINDS, "kinds of part")?;
        self.distinct("kind", self.file.kind.iter().map(|kind| &kind.name))?;
        self.file
            .kind
            .iter()
            .enumerate()
            .map(|(index, entry)| {
                for (key, value) in [("width", &entry.width), ("mass", &entry.mass)] {
                    if !(*value.get_ref() > 0.0 && value.get_ref().is_finite()) {
                        let key = format!("kind[{index}].{key}");
                        return Err(self.source.error(value.span(), key, "expected a number above 0"));
                    }
                }
                Ok(Kind {
                    name: entry.name.get_ref().clone(),
                    width: *entry.width.get_ref(),
                    shape: entry.shape,
                    mass: *entry.mass.get_ref(),
                })
            })
            .collect()
    }

    fn parts(&self) -> Result<Vec<Part>, TaskError> {
        self.within("part", self.file.part.len(), MAX_PARTS, "parts")?;
        self.file
            .part
            .iter()
            .enumerate()
            .map(|(index, entry)| {
                let at = *entry.at.get_ref();
                let RectangleBounds { min, max } = bounds(&self.file.scene, entry.workspace);
                if !(0..2).all(|axis| (min[axis]..=max[axis]).contains(&at[axis])) {
                    let problem =
                        format!("{at:?} lies outside its workspace; expected between {min:?} and {max:?}");
                    return Err(self.source.error(entry.at.span(), format!("part[{index}].at"), problem));
                }
                Ok(Part {
                    kind: self.kind(&format!("part[{index}].kind"), &entry.kind)?,
                    workspace: entry.workspace,
                    at,
                })
            })
            .collect()
    }

    fn subgoals(&self) -> Result<Vec<Subgoal>, TaskError> {
        self.within("subgoal", self.file.subgoal.len(), MAX_SUBGOALS, "subgoals")?;
        self.distinct("subgoal", self.file.subgoal.iter().map(|subgoal| &subgoal.name))?;
        let subgoals = self
            .file
            .subgoal
            .iter()
            .enumerate()
            .map(|(index, entry)| self.subgoal(index, entry))
            .collect::<Result<Vec<_>, _>>()?;
        self.acyclic(&subgoals)?;
        Ok(subgoals)
    }

    fn subgoal(&self, index: usize, entry: &SubgoalEntry) -> Result<Subgoal, TaskError> {
        let names = self.file.subgoal.iter().map(|subgoal| &subgoal.name);
        let after = entry
            .after
            .iter()
            .map(|name| self.find(&format!("subgoal[{index}].after"), name, names.clone()))
            .collect::<Result<Vec<_>, _>>()?;
        let length = entry.socket.axis.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length < 1e-6 || !length.is_finite() {
            let key = format!("subgoal[{index}].socket.axis");
            return Err(self.source.error(
                entry.socket.at.span(),
                key,
                "expected a direction, e.g. [0, 0, 1]",
            ));
        }
        Ok(Subgoal {
            name: entry.name.get_ref().clone(),
            kind: self.kind(&format!("subgoal[{index}].kind"), &entry.kind)?,
            side: entry.side,
            socket: *entry.socket.at.get_ref(),
            axis: entry.socket.axis.map(|x| x / length),
            steadied: entry.steadied,
            after,
        })
    }

    /// Refuses a plan in which a subgoal waits for itself.
    fn acyclic(&self, subgoals: &[Subgoal]) -> Result<(), TaskError> {
        let mut done = vec![false; subgoals.len()];
        for _ in 0..subgoals.len() {
            for (index, subgoal) in subgoals.iter().enumerate() {
                done[index] |= subgoal.after.iter().all(|&before| done[before]);
            }
        }
        match done.iter().position(|&done| !done) {
            None => Ok(()),
            Some(index) => Err(self.source.error(
                self.file.subgoal[index].name.span(),
                format!("subgoal[{index}].after"),
                "the plan runs in a circle here; expected a partial order",
            )),
        }
    }

    fn grips(&self) -> Result<Vec<Grip>, TaskError> {
        self.distinct("grip", self.file.grip.iter().map(|grip| &grip.name))?;
        Ok(self
            .file
            .grip
            .iter()
            .map(|grip| Grip { name: grip.name.get_ref().clone(), pitch: grip.pitch.to_radians() })
            .collect())
    }

    fn gestures(&self) -> Result<Vec<Gesture>, TaskError> {
        self.distinct("gesture", self.file.gesture.iter().map(|gesture| &gesture.name))?;
        Ok(self
            .file
            .gesture
            .iter()
            .map(|gesture| Gesture {
                name: gesture.name.get_ref().clone(),
                pitch: gesture.pitch.to_radians(),
            })
            .collect())
    }

    fn chains(&self, kinds: &[Kind]) -> Result<Vec<Chain>, TaskError> {
        let mut chains = Vec::new();
        for (index, entry) in self.file.chain.iter().enumerate() {
            let answer = entry.answer.as_ref().map(|name| self.answer(index, name)).transpose()?;
            for (kind, Kind { name, .. }) in kinds.iter().enumerate() {
                chains.push(Chain {
                    name: entry.name.get_ref().clone(),
                    act: self.shown_by(index, entry, kind)?,
                    kind,
                    from: entry.from,
                    side: entry.side,
                    answer: answer.clone(),
                    says: self.phrases(index, entry, name)?,
                });
            }
        }
        Ok(chains)
    }

    /// The phrases of a chain for one kind of part, by its name.
    fn phrases(&self, index: usize, entry: &ChainEntry, kind: &str) -> Result<Vec<String>, TaskError> {
        let phrase = |(nth, phrase): (usize, &Name)| {
            if !phrase.get_ref().contains("{kind}") {
                let problem = "expected a phrase with {kind} in it, where the part is named";
                return Err(self.source.error(phrase.span(), format!("chain[{index}].says[{nth}]"), problem));
            }
            Ok(phrase.get_ref().replace("{kind}", kind).to_lowercase())
        };
        entry.says.iter().enumerate().map(phrase).collect()
    }

    fn answer(&self, index: usize, name: &Name) -> Result<String, TaskError> {
        let actions = self.file.action.iter().map(|action| &action.name);
        let action = self.find(&format!("chain[{index}].answer"), name, actions)?;
        Ok(self.file.action[action].name.get_ref().clone())
    }

    fn shown_by(&self, index: usize, entry: &ChainEntry, kind: usize) -> Result<Act, TaskError> {
        match (&entry.grip, &entry.gesture) {
            (Some(grip), None) => {
                let grips = self.file.grip.iter().map(|grip| &grip.name);
                Ok(Act::Grasp { grip: self.find(&format!("chain[{index}].grip"), grip, grips)?, kind })
            }
            (None, Some(gesture)) => {
                let gestures = self.file.gesture.iter().map(|gesture| &gesture.name);
                Ok(Act::Gesture(self.find(&format!("chain[{index}].gesture"), gesture, gestures)?))
            }
            _ => Err(self.source.error(
                entry.name.span(),
                format!("chain[{index}]"),
                "expected either `grip` or `gesture`: what shows this chain",
            )),
        }
    }

    fn actions(&self, kinds: &[Kind], subgoals: &[Subgoal]) -> Result<Vec<Action>, TaskError> {
        self.distinct("action", self.file.action.iter().map(|action| &action.name))?;
        Ok(self.file.action.iter().flat_map(|entry| expand(entry, kinds, subgoals)).collect())
    }

    fn kind(&self, key: &str, name: &Name) -> Result<usize, TaskError> {
        self.find(key, name, self.file.kind.iter().map(|kind| &kind.name))
    }

    fn find<'n>(
        &self,
        key: &str,
        name: &Name,
        known: impl Iterator<Item = &'n Name> + Clone,
    ) -> Result<usize, TaskError> {
        known.clone().position(|candidate| candidate.get_ref() == name.get_ref()).ok_or_else(|| {
            let known: Vec<_> = known.map(|name| format!("{:?}", name.get_ref())).collect();
            let problem =
                format!("{:?} is not defined; expected one of {}", name.get_ref(), known.join(", "));
            self.source.error(name.span(), key, problem)
        })
    }

    fn distinct<'n>(&self, table: &str, names: impl Iterator<Item = &'n Name>) -> Result<(), TaskError> {
        let mut seen = std::collections::HashSet::new();
        for (index, name) in names.enumerate() {
            if !seen.insert(name.get_ref()) {
                let problem = format!("{:?} stands twice; expected a name of its own", name.get_ref());
                return Err(self.source.error(name.span(), format!("{table}[{index}].name"), problem));
            }
        }
        Ok(())
    }

    fn within(&self, key: &str, count: usize, most: usize, what: &str) -> Result<(), TaskError> {
        if count == 0 || count > most {
            let problem = format!("{count} {what}; expected 1 to {most}");
            return Err(self.source.error(0..0, key, problem));
        }
        Ok(())
    }
}

fn acts(grips: usize, gestures: usize, chains: &[Chain], kinds: usize) -> Vec<Act> {
    let spoken = |chain: &usize| !chains[*chain].says.is_empty();
    let grasps = (0..grips).flat_map(|grip| (0..kinds).map(move |kind| Act::Grasp { grip, kind }));
    [Act::Rest, Act::Idle, Act::Reach, Act::Hidden]
        .into_iter()
        .chain((0..gestures).map(Act::Gesture))
        .chain((0..chains.len()).filter(spoken).map(Act::Word))
        .chain(grasps)
        .collect()
}

fn expand(entry: &ActionEntry, kinds: &[Kind], subgoals: &[Subgoal]) -> Vec<Action> {
    let rule = entry.name.get_ref();
    let named = |object: &str, kind, subgoal| Action {
        name: format!("{rule}: {object}"),
        rule: rule.clone(),
        action_type: entry.action_type,
        kind: Some(kind),
        subgoal,
    };
    match entry.each {
        Each::Once => vec![Action {
            name: rule.clone(),
            rule: rule.clone(),
            action_type: entry.action_type,
            kind: None,
            subgoal: None,
        }],
        Each::Kind => kinds.iter().enumerate().map(|(index, kind)| named(&kind.name, index, None)).collect(),
        Each::Subgoal => subgoals
            .iter()
            .enumerate()
            .filter(|(_, subgoal)| entry.side.is_none_or(|side| side == subgoal.side))
            .map(|(index, subgoal)| named(&subgoal.name, subgoal.kind, Some(index)))
            .collect(),
    }
}

struct RectangleBounds {
    min: [f64; 2],
    max: [f64; 2],
}

fn bounds(scene: &SceneEntry, agent: Agent) -> RectangleBounds {
    let rectangle = match agent {
        Agent::Robot => &scene.robot_workspace,
        Agent::Person => &scene.person_workspace,
    };
    RectangleBounds { min: rectangle.min, max: rectangle.max }
}

fn scene(entry: &SceneEntry) -> Scene {
    let corners = |agent| {
        let RectangleBounds { min, max } = bounds(entry, agent);
        [min, max]
    };
    Scene {
        table_height: entry.table.height,
        table_centre: entry.table.centre,
        table_size: entry.table.size,
        platform: entry.platform.at,
        platform_radius: entry.platform.radius,
        platform_height: entry.platform.height,
        steady: entry.steady,
        handover: entry.handover,
        person_rest: entry.person_rest,
        person_shoulder: entry.person_shoulder,
        workspace: [corners(Agent::Robot), corners(Agent::Person)],
        fit: Fit { position: entry.fit.position, angle: entry.fit.angle.to_radians() },
    }
}
