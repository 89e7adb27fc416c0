use crate::LearnError;
use std::path::{Component, Path, PathBuf};
use toml_edit::{Array, DocumentMut, Item, Value};

/// A task file as text: comments and layout stay, only what was learned is replaced.
#[derive(Debug, Clone)]
pub struct TaskText {
    path: PathBuf,
    document: DocumentMut,
}

impl TaskText {
    /// Reads the task file at `path`, whose content has been checked by loading it.
    ///
    /// # Errors
    /// It cannot be read, or is no TOML.
    pub fn read(path: &Path) -> Result<Self, LearnError> {
        let text = coact_input_file::read_text(path)
            .map_err(|cause| LearnError::File { path: path.to_owned(), cause })?;
        Self::parse(&text, path)
    }

    /// The task of this text, as if it stood in the file at `path`.
    ///
    /// # Errors
    /// It is no TOML.
    pub fn parse(text: &str, path: &Path) -> Result<Self, LearnError> {
        let document = text
            .parse()
            .map_err(|error: toml_edit::TomlError| LearnError::content(path.display(), error.message()))?;
        Ok(Self { path: path.to_owned(), document })
    }

    /// Replaces the plan: `plan` holds the direct predecessors of each subgoal, by the order of the file; the choices that it comes after stay.
    pub fn set_plan(&mut self, plan: &[Vec<usize>]) {
        let Some(goals) = self.document.get_mut("subgoal").and_then(Item::as_array_of_tables_mut) else {
            return;
        };
        let name =
            |goal: &toml_edit::Table| goal.get("name").and_then(Item::as_str).unwrap_or_default().to_owned();
        let names: Vec<String> = goals.iter().map(name).collect();
        for (goal, predecessors) in goals.iter_mut().zip(plan) {
            // A step may come after choices as well, which no plan of subgoals tells of.
            let written = goal.get("after").and_then(Item::as_array).into_iter().flatten();
            let choices =
                written.filter_map(Value::as_str).filter(|name| !names.iter().any(|own| own == name));
            let choices: Vec<String> = choices.map(str::to_owned).collect();
            let subgoals = predecessors.iter().map(|&index| names[index].as_str());
            let after: Array = subgoals.chain(choices.iter().map(String::as_str)).collect();
            if after.is_empty() {
                goal.remove("after");
                continue;
            }
            match goal.get_mut("after").and_then(Item::as_value_mut) {
                // What stands behind the value, a comment perhaps, stays.
                Some(old) => {
                    let decor = old.decor().clone();
                    *old = Value::Array(after);
                    *old.decor_mut() = decor;
                }
                None => {
                    goal.insert("after", toml_edit::value(after));
                }
            }
        }
    }

    /// Writes the task to `out`; files that it names are still found from there.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write(mut self, out: &Path) -> Result<(), LearnError> {
        let file = |cause| LearnError::File { path: out.to_owned(), cause };
        let (from, to) = (folder(&self.path).map_err(file)?, folder(out).map_err(file)?);
        for key in ["network", "learned"] {
            let Some(value) = self.document.get_mut(key).and_then(Item::as_value_mut) else { continue };
            let Some(name) = value.as_str().map(PathBuf::from) else { continue };
            if from != to && name.is_relative() {
                let decor = value.decor().clone();
                *value = Value::from(relative(&to, &from.join(name)).display().to_string());
                *value.decor_mut() = decor;
            }
        }
        std::fs::write(out, self.document.to_string()).map_err(file)
    }
}

/// The absolute folder of a file that exists, or is to be written.
fn folder(file: &Path) -> std::io::Result<PathBuf> {
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    std::fs::canonicalize(folder.unwrap_or(Path::new(".")))
}

/// The path of the absolute `file` relative to the absolute `folder`.
fn relative(folder: &Path, file: &Path) -> PathBuf {
    let file = plain(file);
    let common = folder.components().zip(file.components()).take_while(|(one, other)| one == other).count();
    let up = folder.components().skip(common).map(|_| Component::ParentDir);
    up.chain(file.components().skip(common)).collect()
}

/// The path without `..`: its folders are known to be no links.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for component in path.components() {
        match component {
            Component::ParentDir => {
                plain.pop();
            }
            Component::CurDir => {}
            other => plain.push(other),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_is_found_from_another_folder() {
        let path = relative(Path::new("/a/b/out"), Path::new("/a/b/tasks/../net.toml"));
        assert_eq!(path, Path::new("../net.toml"));
    }
}
