/// As what a process writes a topic.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// As the stage that the table of topics names.
    Stage,
    /// As the standby of that stage.
    Standby,
}
