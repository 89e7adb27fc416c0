use crate::{Obstacle, SegmentKind};

/// What the arm moves among, and how far it keeps away from it.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// All obstacles.
    pub obstacles: Vec<Obstacle>,
    /// Names of the obstacles that the hand, and what it holds, may touch where it leaves: what it has let go, or the table
    /// from which it takes something.
    pub allowed_leaving: Vec<String>,
    /// Names of those that they may touch at the goal: the part that is grasped, or the fixture into which one is put.
    pub allowed_at_goal: Vec<String>,
}

impl Scene {
    /// The same scene with these obstacles as well.
    pub fn with(&self, obstacles: impl Iterator<Item = Obstacle>) -> Self {
        let mut scene = self.clone();
        scene.obstacles.extend(obstacles);
        scene
    }

    /// The same scene, in which the hand may touch the obstacles of these names where it leaves and at the goal.
    pub fn touching(&self, names: &[&str]) -> Self {
        let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        Self { obstacles: self.obstacles.clone(), allowed_leaving: names.clone(), allowed_at_goal: names }
    }

    pub(crate) fn hand_may_touch(&self, obstacle: usize, segment: SegmentKind) -> bool {
        let name = &self.obstacles[obstacle].name;
        match segment {
            SegmentKind::Leave => self.allowed_leaving.contains(name),
            SegmentKind::Reach => false,
            SegmentKind::Approach => self.allowed_at_goal.contains(name),
        }
    }
}
