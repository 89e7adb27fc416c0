/// What a [`Note`](crate::Note) is about; each kind has its colour.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoteKind {
    /// Something was achieved: green.
    Achieved,
    /// The robot decided: cyan.
    Decision,
    /// The robot speaks: magenta.
    Speech,
    /// A process died and is replaced, or a fault was injected: yellow.
    Disturbance,
    /// Something that spoils the run or its metrics: red.
    Alarm,
    /// Anything else: plain.
    Plain,
}
