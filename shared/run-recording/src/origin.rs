use coact_input_file::Files;
use coact_pipeline::RunSettings;
use std::collections::BTreeMap;

/// What a recording was made of: all that is needed to compute the same again, wherever that is.
#[derive(Debug, Clone, Default)]
pub struct Origin {
    /// The run's settings. Their files are those of `files`.
    pub settings: RunSettings,
    /// The files that the stages read, by the paths by which they read them.
    pub files: Files,
    /// How often the recorder had been restarted.
    pub generation: u32,
    /// When cycle 0 of the run began, ns of `CLOCK_MONOTONIC`.
    pub start_ns: u64,
    /// What the times of the file, ns since 1970, are more than those of `CLOCK_MONOTONIC`.
    pub clock_offset_ns: u64,
    /// Version of the program that recorded.
    pub version: String,
    /// Fingerprint of the sources that decide what stages compute.
    pub code: String,
}

impl Origin {
    /// Version of this program, for what it records.
    pub const VERSION: &str = env!("CARGO_PKG_VERSION");
    /// Fingerprint of this program's sources.
    pub const CODE: &str = env!("COACT_CODE");
    /// Name of the record in the file.
    pub(crate) const NAME: &str = "coact";

    /// Whether it was recorded by the code that this program was built of.
    pub fn is_of_this_code(&self) -> bool {
        self.code == Self::CODE
    }

    pub(crate) fn to_metadata(&self) -> Result<BTreeMap<String, String>, serde_json::Error> {
        let Self { settings, generation, start_ns, clock_offset_ns, version, code, files: _ } = self;
        let settings = serde_json::to_string(settings)?;
        let numbers = [generation.to_string(), start_ns.to_string(), clock_offset_ns.to_string()];
        let [generation, start_ns, clock_offset_ns] = numbers;
        let entries = [
            ("settings", settings),
            ("generation", generation),
            ("start_ns", start_ns),
            ("clock_offset_ns", clock_offset_ns),
            ("version", version.clone()),
            ("code", code.clone()),
        ];
        Ok(entries.into_iter().map(|(key, value)| (key.to_owned(), value)).collect())
    }

    /// # Errors
    /// The name of the entry that is missing or malformed.
    pub(crate) fn from_metadata(entries: &BTreeMap<String, String>) -> Result<Self, &'static str> {
        let text = |key| entries.get(key).map(String::as_str).ok_or(key);
        let number = |key: &'static str| text(key)?.parse::<u64>().map_err(|_| key);
        Ok(Self {
            settings: serde_json::from_str(text("settings")?).map_err(|_| "settings")?,
            files: Files::default(),
            generation: text("generation")?.parse().map_err(|_| "generation")?,
            start_ns: number("start_ns")?,
            clock_offset_ns: number("clock_offset_ns")?,
            version: text("version")?.to_owned(),
            code: text("code")?.to_owned(),
        })
    }
}
