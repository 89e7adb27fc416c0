use crate::{Obstacle, SegmentKind};

/// What the arm moves among.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// All obstacles.
    pub obstacles: Vec<Obstacle>,
    /// Names of the obstacles that the hand, and what it holds, may touch while it leaves: what it has let go, or the table
    /// from which it lifts something.
    pub allowed_leaving: Vec<String>,
    /// Names of those that they may touch while the hand approaches its goal: the part that it grasps, or the fixture into
    /// which it puts one.
    pub allowed_at_goal: Vec<String>,
}

impl Scene {
    /// The same scene with these obstacles as well.
    pub fn with(&self, obstacles: impl Iterator<Item = Obstacle>) -> Self {
        let mut scene = self.clone();
        scene.obstacles.extend(obstacles);
        scene
    }

    /// The same scene, in which the hand may touch the obstacles of these names while it leaves and while it approaches.
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
