use coact_messages::{MAX_PARTS, Sighting};

/// What the camera has shown beside the person: of fixed size.
#[derive(Debug, Clone, Copy)]
pub(crate) struct InSight {
    parts: [Sighting; MAX_PARTS],
    part_count: usize,
    occluders: [[f64; 6]; MOST_OCCLUDERS],
    occluder_count: usize,
}

/// Most occluders of a scene view.
const MOST_OCCLUDERS: usize = 4;

impl InSight {
    /// These parts, those of the newest camera frame first, and occluders, as many as there is room for.
    pub fn of(parts: &[Sighting], occluders: &[[f64; 6]]) -> Self {
        let mut in_sight = Self {
            parts: [bytemuck::Zeroable::zeroed(); MAX_PARTS],
            part_count: 0,
            occluders: [[0.0; 6]; MOST_OCCLUDERS],
            occluder_count: 0,
        };
        in_sight.part_count = fill(&mut in_sight.parts, parts);
        in_sight.occluder_count = fill(&mut in_sight.occluders, occluders);
        in_sight
    }

    /// The parts.
    pub fn parts(&self) -> &[Sighting] {
        &self.parts[..self.part_count]
    }

    /// The occluders: centre and half extents, m.
    pub fn occluders(&self) -> &[[f64; 6]] {
        &self.occluders[..self.occluder_count]
    }
}

/// Copies what there is room for; how many that is.
fn fill<T: Copy>(slots: &mut [T], values: &[T]) -> usize {
    let count = values.len().min(slots.len());
    slots[..count].copy_from_slice(&values[..count]);
    count
}
