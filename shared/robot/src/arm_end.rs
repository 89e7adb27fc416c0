//! Where in a URDF the arm ends and the hand begins.

use crate::{RobotError, Urdf};

/// The end of an arm.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum ArmEnd {
    /// The link from which the fingers branch off.
    Palm(String),
    /// The last link of an arm without a hand.
    Bare(String),
}

impl Urdf {
    /// Follows the only chain of joints from the root, up to where moving joints branch or end.
    ///
    /// # Errors
    /// [`RobotError::Malformed`] when the links are not a tree.
    pub fn arm_end(&self) -> Result<ArmEnd, RobotError> {
        let root = self.root()?;
        let mut at = root.as_str();
        for _ in 0..=self.model().joints.len() {
            let children: Vec<_> = self.below(at).collect();
            let moving: Vec<_> = children.iter().filter(|joint| self.has_motion(joint)).collect();
            match (moving.as_slice(), children.as_slice()) {
                ([only], _) => at = &only.child.link,
                // A fixed frame, such as one at which tools are mounted.
                ([], [only]) => at = &only.child.link,
                ([], _) => return Ok(ArmEnd::Bare(at.to_owned())),
                _ => return Ok(ArmEnd::Palm(at.to_owned())),
            }
        }
        Err(self.fault(&root, "is part of a loop of joints; expected a tree"))
    }

    /// The link from which the fingers branch off.
    ///
    /// # Errors
    /// [`RobotError::Malformed`] when there is none.
    pub fn palm(&self) -> Result<String, RobotError> {
        match self.arm_end()? {
            ArmEnd::Palm(palm) => Ok(palm),
            ArmEnd::Bare(last) => Err(self.fault(
                &last,
                "ends the chain of joints, and no fingers branch off; expected a hand, or one mounted with --hand FILE",
            )),
        }
    }

    /// Joints that this link carries.
    pub(crate) fn below<'a>(&'a self, link: &'a str) -> impl Iterator<Item = &'a urdf_rs::Joint> {
        self.model().joints.iter().filter(move |joint| joint.parent.link == link)
    }

    /// Whether this joint, or one below it, moves.
    fn has_motion(&self, joint: &urdf_rs::Joint) -> bool {
        let mut below = vec![joint];
        let mut seen = 0;
        while let Some(next) = below.pop() {
            seen += 1;
            if next.joint_type != urdf_rs::JointType::Fixed {
                return true;
            }
            if seen <= self.model().joints.len() {
                below.extend(self.below(&next.child.link));
            }
        }
        false
    }
}
