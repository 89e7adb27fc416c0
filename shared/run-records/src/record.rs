use serde::{Serialize, de::DeserializeOwned};

/// One line of a log in the report directory.
pub trait Record: Serialize + DeserializeOwned {
    /// Name of the log's file in the report directory.
    const FILE: &'static str;
}
