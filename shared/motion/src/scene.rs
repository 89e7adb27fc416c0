use crate::{Obstacle, StageKind};

/// What the arm moves among, and how far it keeps away from it.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// All obstacles.
    pub obstacles: Vec<Obstacle>,
    /// Names of the obstacles that the hand, and what it holds, may touch where it leaves: what it has let go, or the table
    /// from which it takes something.
    pub left: Vec<String>,
    /// Names of those that they may touch at the goal: the part that is grasped, or the fixture into which one is put.
    pub sought: Vec<String>,
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
        Self { obstacles: self.obstacles.clone(), left: names.clone(), sought: names }
    }

    pub(crate) fn hand_may_touch(&self, obstacle: usize, stage: StageKind) -> bool {
        let name = &self.obstacles[obstacle].name;
        match stage {
            StageKind::Leave => self.left.contains(name),
            StageKind::Reach => false,
            StageKind::Approach => self.sought.contains(name),
        }
    }
}
