/// A grip of the person's that tells what is meant.
#[derive(Debug, Clone, PartialEq)]
pub struct PersonGrip {
    /// Its name.
    pub name: String,
    /// Direction from wrist to knuckles against the table plane, rad; -pi/2 is straight down.
    pub pitch: f64,
}
