use crate::TableEditError;
use coact_monitor::Rules;
use std::path::{Path, PathBuf};
use toml_edit::{DocumentMut, Item, Value};

/// A process table on its way to another folder. Comments stay.
#[derive(Debug, Clone)]
pub struct TableEdit {
    document: DocumentMut,
    /// The verdict's rules, which belong beside it.
    rules: PathBuf,
}

const FILE: &str = "pipeline.toml";

impl TableEdit {
    /// Of the table in a folder such as `rt-config`.
    ///
    /// # Errors
    /// [`TableEditError::File`].
    pub fn of(configuration: &Path) -> Result<Self, TableEditError> {
        let file = configuration.join(FILE);
        let text = std::fs::read_to_string(&file).map_err(|cause| failed(&file, &cause))?;
        let document = text.parse().map_err(|cause| failed(&file, &cause))?;
        Ok(Self { document, rules: configuration.join(Rules::FILE) })
    }

    /// Another value of a key that the section has.
    ///
    /// # Errors
    /// [`TableEditError::Missing`].
    pub fn with(mut self, section: &str, key: &str, value: impl Into<Value>) -> Result<Self, TableEditError> {
        let found = self.document.get_mut(section).and_then(|section| section.get_mut(key));
        let found = found.and_then(Item::as_value_mut);
        let found = found.ok_or_else(|| TableEditError::Missing(format!("{key} in [{section}]")))?;
        // What stands around it, a comment too, is no part of the value.
        let around = found.decor().clone();
        *found = value.into();
        *found.decor_mut() = around;
        Ok(self)
    }

    /// Each of these processes has a standby.
    ///
    /// # Errors
    /// [`TableEditError::Missing`].
    pub fn with_standby(mut self, names: &[&str]) -> Result<Self, TableEditError> {
        for name in names {
            let processes = self.document["process"].as_array_of_tables_mut();
            let named =
                processes.and_then(|all| all.iter_mut().find(|one| one["name"].as_str() == Some(name)));
            let named = named.ok_or_else(|| TableEditError::Missing(format!("process \"{name}\"")))?;
            named["standby"] = toml_edit::value(true);
        }
        Ok(self)
    }

    /// Writes it into the folder, and the verdict's rules beside it; returns the table's file.
    ///
    /// # Errors
    /// [`TableEditError::File`].
    pub fn write(self, folder: &Path) -> Result<PathBuf, TableEditError> {
        let file = folder.join(FILE);
        std::fs::write(&file, self.document.to_string()).map_err(|cause| failed(&file, &cause))?;
        let beside = folder.join(Rules::FILE);
        std::fs::copy(&self.rules, &beside).map_err(|cause| failed(&beside, &cause))?;
        Ok(file)
    }
}

fn failed(file: &Path, cause: &dyn std::fmt::Display) -> TableEditError {
    TableEditError::File { file: file.to_owned(), cause: cause.to_string() }
}
