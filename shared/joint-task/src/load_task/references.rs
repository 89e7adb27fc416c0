use super::TaskReader;
use crate::TaskError;
use crate::task_file::Name;

/// Checks of what the entries of a task file say about each other.
impl TaskReader<'_> {
    /// Index of the kind of part that `name` means.
    pub(super) fn kind(&self, key: &str, name: &Name) -> Result<usize, TaskError> {
        self.find(key, name, self.file.kind.iter().map(|kind| &kind.name))
    }

    /// Index of `name` among the `known` ones.
    pub(super) fn find<'n>(
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

    /// Refuses a name that stands twice in one table.
    pub(super) fn distinct<'n>(
        &self,
        table: &str,
        names: impl Iterator<Item = &'n Name>,
    ) -> Result<(), TaskError> {
        let mut seen = std::collections::HashSet::new();
        for (index, name) in names.enumerate() {
            if !seen.insert(name.get_ref()) {
                let problem = format!("{:?} stands twice; expected a name of its own", name.get_ref());
                return Err(self.source.error(name.span(), format!("{table}[{index}].name"), problem));
            }
        }
        Ok(())
    }

    /// Refuses an empty table, and one with more entries than messages have room for.
    pub(super) fn within(&self, key: &str, count: usize, most: usize, what: &str) -> Result<(), TaskError> {
        if count == 0 || count > most {
            let problem = format!("{count} {what}; expected 1 to {most}");
            return Err(self.source.error(0..0, key, problem));
        }
        Ok(())
    }
}
