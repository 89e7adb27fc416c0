use coact_seen_parts::SeenParts;

/// What the camera has shown beside the person: of fixed size.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Surroundings {
    /// The parts.
    pub parts: SeenParts,
    obstacles: [[f64; 6]; MOST_OBSTACLES],
    obstacle_count: usize,
}

/// Most obstacles of a scene view.
const MOST_OBSTACLES: usize = 4;

impl Surroundings {
    /// These parts, and obstacles, as many as there is room for.
    pub fn of(parts: SeenParts, obstacles: &[[f64; 6]]) -> Self {
        let mut surroundings = Self { parts, obstacles: [[0.0; 6]; MOST_OBSTACLES], obstacle_count: 0 };
        for (slot, obstacle) in surroundings.obstacles.iter_mut().zip(obstacles) {
            *slot = *obstacle;
            surroundings.obstacle_count += 1;
        }
        surroundings
    }

    /// The obstacles: centre and half extents, m.
    pub fn obstacles(&self) -> &[[f64; 6]] {
        &self.obstacles[..self.obstacle_count]
    }
}
