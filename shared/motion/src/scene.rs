use crate::Obstacle;

/// What the arm moves among, and how far it keeps away from it.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// All obstacles.
    pub obstacles: Vec<Obstacle>,
    /// Names of the obstacles that the hand, and what it holds, may touch now: the part that it grasps, or the fixture
    /// into which it puts one.
    pub touchable: Vec<String>,
}

impl Scene {
    /// The same scene, in which the hand may touch the obstacles of these names.
    pub fn touching(&self, names: &[&str]) -> Self {
        let touchable = names.iter().map(|name| (*name).to_owned()).collect();
        Self { obstacles: self.obstacles.clone(), touchable }
    }

    pub(crate) fn hand_may_touch(&self, obstacle: usize) -> bool {
        self.touchable.contains(&self.obstacles[obstacle].name)
    }
}
