/// A schema that other programs know messages by, as text of JSON Schema.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct JsonSchema {
    /// Its name, as in `foxglove.Log`.
    pub name: &'static str,
    /// The schema.
    pub text: String,
}
