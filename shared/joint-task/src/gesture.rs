/// A gesture of the empty hand, held out over the middle of the table.
#[derive(Debug, Clone, PartialEq)]
pub struct Gesture {
    /// Its name.
    pub name: String,
    /// Direction from wrist to knuckles against the table plane, rad.
    pub pitch: f64,
}
