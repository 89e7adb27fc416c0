use crate::{Connection, LearnError};
use std::path::Path;
use toml_edit::{ArrayOfTables, DocumentMut, Item, Table, value};

/// From what the weights were learned.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Provenance {
    /// Name of the task.
    pub task: String,
    /// Assemblies that were watched.
    pub trials: u32,
    /// Seed of the first one.
    pub seed: u64,
    /// Actions of the person that succeeded.
    pub successes: u32,
}

/// Learned connections as a file that a task names with `learned = "FILE"`.
#[derive(Debug, Clone, PartialEq)]
pub struct MappingFile {
    /// From what they were learned.
    pub provenance: Provenance,
    /// From acts to chains.
    pub connections: Vec<Connection>,
}

/// Comment at the head of the file.
const HEAD: &str = "# Connections from observed acts (AOL) to simulated chains (ASL), learned from actions that succeeded.\n\
                    # A task uses them with the key: learned = \"THIS FILE\"\n\n";

impl MappingFile {
    /// Writes it.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), LearnError> {
        std::fs::write(path, self.text()).map_err(|cause| LearnError::File { path: path.to_owned(), cause })
    }

    /// The content of the file.
    pub fn text(&self) -> String {
        let Provenance { task, trials, seed, successes } = &self.provenance;
        let mut provenance = Table::new();
        provenance["task"] = value(task);
        provenance["trials"] = value(i64::from(*trials));
        provenance["seed"] = value(i64::try_from(*seed).unwrap_or(i64::MAX));
        provenance["successes"] = value(i64::from(*successes));
        let mut connections = ArrayOfTables::new();
        for connection in &self.connections {
            let mut entry = Table::new();
            entry["act"] = value(&connection.act);
            entry["chain"] = value(&connection.chain);
            entry["weight"] = value((connection.weight * 1e3).round() / 1e3);
            entry["successes"] = value(i64::from(connection.successes));
            connections.push(entry);
        }
        let mut document = DocumentMut::new();
        document["provenance"] = Item::Table(provenance);
        document["connection"] = Item::ArrayOfTables(connections);
        format!("{HEAD}{document}")
    }
}
