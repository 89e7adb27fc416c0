use coact_perception::PreshapeModel;
use coact_world::Replay;

/// Somebody whose reaches are tested.
pub struct Subject {
    /// Number of the person.
    pub participant: u32,
    /// A model of preshaping that comes from other people.
    pub model: PreshapeModel,
    /// The reaches.
    pub replay: Replay,
}
