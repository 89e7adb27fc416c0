use crate::state::SeenParts;

/// What the camera has shown beside the person: of fixed size.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Surroundings {
    /// The parts.
    pub parts: SeenParts,
    occluders: [[f64; 6]; MOST_OCCLUDERS],
    occluder_count: usize,
}

/// Most occluders of a scene view.
const MOST_OCCLUDERS: usize = 4;

impl Surroundings {
    /// These parts, and occluders, as many as there is room for.
    pub fn of(parts: SeenParts, occluders: &[[f64; 6]]) -> Self {
        let mut surroundings = Self { parts, occluders: [[0.0; 6]; MOST_OCCLUDERS], occluder_count: 0 };
        for (slot, occluder) in surroundings.occluders.iter_mut().zip(occluders) {
            *slot = *occluder;
            surroundings.occluder_count += 1;
        }
        surroundings
    }

    /// The occluders: centre and half extents, m.
    pub fn occluders(&self) -> &[[f64; 6]] {
        &self.occluders[..self.occluder_count]
    }
}
