use anyhow::{Context, Result};
use std::path::{Path, PathBuf};

/// Where this installation's programs, configuration and data are.
#[derive(Debug, Clone)]
pub struct Installation {
    /// Folder of the programs: that of this one.
    pub programs: PathBuf,
    /// Folder `rt-config`.
    pub configuration: PathBuf,
    /// Folder of the shipped recorded reaches, beside `rt-config`.
    pub reaches: PathBuf,
}

impl Installation {
    /// Finds it: `rt-config` lies in a folder above this program, or above the current one.
    ///
    /// # Errors
    /// There is no such folder.
    pub fn find() -> Result<Self> {
        let programs = Self::programs()?;
        let here = std::env::current_dir().context("there is no current folder")?;
        let mut above = programs.ancestors().chain(here.ancestors());
        let root = above.find(|folder| folder.join("rt-config/pipeline.toml").is_file()).with_context(|| {
            let (programs, here) = (programs.display(), here.display());
            format!("no rt-config/pipeline.toml above {programs} or {here}; expected it in the checkout's root")
        })?;
        let (configuration, reaches) = (root.join("rt-config"), root.join("data/reaches"));
        Ok(Self { programs, configuration, reaches })
    }

    /// The folder of the programs, whatever else is installed.
    ///
    /// # Errors
    /// The system does not tell this program's own place.
    pub fn programs() -> Result<PathBuf> {
        let program = std::env::current_exe().context("this program's own place is unknown")?;
        Ok(program.parent().unwrap_or(Path::new("/")).to_owned())
    }
}
