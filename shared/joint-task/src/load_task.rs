//! From the file's names to the task's indices, with every reference checked.

mod actions;
mod chains;
mod choices;
mod ranges;
mod references;
mod scene;
mod subgoals;

use crate::source_file::SourceFile;
use crate::task_file::{KindEntry, Name, TaskFile};
use crate::{Gesture, Kind, Part, PersonGrip, Task, TaskError};
use chains::acts;
use coact_messages::{MAX_ACTS, MAX_GRIPS, MAX_KINDS, MAX_PARTS};
use scene::{corners, scene};
use std::hash::{DefaultHasher, Hasher};
use std::path::{Path, PathBuf};

/// Reads the task file and names the network file beside it, and that of learned connections, if there is one.
pub(crate) fn load(path: &Path) -> Result<(Task, PathBuf, Option<PathBuf>), TaskError> {
    let source = SourceFile::read(path)?;
    let file: TaskFile = source.parse()?;
    ranges::check(&source)?;
    let beside = |name: &Name| path.parent().unwrap_or(Path::new(".")).join(name.get_ref());
    let network = beside(&file.network);
    if !coact_input_file::exists(&network) {
        let problem = format!("no file {}; expected a network file, relative to this one", network.display());
        return Err(source.error(file.network.span(), "network", problem));
    }
    let task = TaskReader { source: &source, file: &file }.task()?;
    Ok((task, network, file.learned.as_ref().map(beside)))
}

/// Turns the entries of a task file into a task.
struct TaskReader<'a> {
    source: &'a SourceFile,
    file: &'a TaskFile,
}

impl TaskReader<'_> {
    fn task(&self) -> Result<Task, TaskError> {
        let kinds = self.kinds()?;
        let subgoals = self.subgoals()?;
        let choices = self.choices(&subgoals)?;
        self.acyclic(&subgoals, &choices)?;
        let grips = self.grips()?;
        let gestures = self.gestures()?;
        let chains = self.chains(&kinds)?;
        let acts = acts(grips.len(), gestures.len(), &chains, kinds.len());
        let what = "observable acts (grips x kinds + gestures + chains that are spoken of x kinds + those that are pointed at x kinds + 4)";
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
            choices,
            subgoals,
            grips,
            gestures,
            acts,
        })
    }

    fn kinds(&self) -> Result<Vec<Kind>, TaskError> {
        self.within("kind", self.file.kind.len(), MAX_KINDS, "kinds of part")?;
        self.distinct("kind", self.file.kind.iter().map(|kind| &kind.name))?;
        let kind = |entry: &KindEntry| Kind {
            name: entry.name.get_ref().clone(),
            width: entry.width,
            shape: entry.shape,
            mass: entry.mass,
        };
        Ok(self.file.kind.iter().map(kind).collect())
    }

    fn parts(&self) -> Result<Vec<Part>, TaskError> {
        self.within("part", self.file.part.len(), MAX_PARTS, "parts")?;
        self.file
            .part
            .iter()
            .enumerate()
            .map(|(index, entry)| {
                let at = *entry.at.get_ref();
                let [min, max] = corners(&self.file.scene, entry.workspace);
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

    fn grips(&self) -> Result<Vec<PersonGrip>, TaskError> {
        self.within("grip", self.file.grip.len(), MAX_GRIPS, "grips")?;
        self.distinct("grip", self.file.grip.iter().map(|grip| &grip.name))?;
        Ok(self
            .file
            .grip
            .iter()
            .map(|grip| PersonGrip { name: grip.name.get_ref().clone(), pitch: grip.pitch.to_radians() })
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
}
