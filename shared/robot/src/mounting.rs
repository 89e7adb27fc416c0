//! A hand of another URDF on an arm.

use crate::arm_end::ArmEnd;
use crate::{RobotError, Urdf};
use std::collections::HashSet;

impl Urdf {
    /// This arm with the hand of another URDF: in place of its own, or at its end where it has none.
    ///
    /// The root of the hand's URDF stands where the arm's palm stood (z out of the palm), or on the arm's last link. A
    /// palm that a fixed joint holds goes with the hand that is taken off; one that is the arm's last moving link stays.
    /// The hand's links and joints are called `<name of its robot>/<own name>` from then on.
    ///
    /// # Errors
    /// [`RobotError::Malformed`] when either is no tree, or no fingers branch off in the hand's URDF.
    pub fn with_hand(&self, hand: &Self) -> Result<Self, RobotError> {
        hand.palm()?;
        let prefix = format!("{}/", hand.name());
        let root = prefix.clone() + &hand.root()?;
        let mut robot = self.model().clone();
        let end = match self.arm_end()? {
            ArmEnd::Palm(palm) => {
                let gone = self.links_below(&palm);
                robot.links.retain(|link| !gone.contains(&link.name));
                robot.joints.retain(|joint| !gone.contains(&joint.child.link));
                palm
            }
            ArmEnd::Bare(last) => last,
        };
        let holder = robot.joints.iter_mut().find(|joint| joint.child.link == end);
        match holder.filter(|joint| joint.joint_type == urdf_rs::JointType::Fixed) {
            Some(holder) => {
                holder.child.link.clone_from(&root);
                robot.links.retain(|link| link.name != end);
            }
            None => robot.joints.push(rigid(&format!("{prefix}mount"), &end, &root)),
        }
        let hand_robot = hand.model().clone();
        robot.links.extend(hand_robot.links.into_iter().map(|mut link| {
            link.name.insert_str(0, &prefix);
            link
        }));
        robot.joints.extend(hand_robot.joints.into_iter().map(|mut joint| {
            let mimicked = joint.mimic.as_mut().map(|mimic| &mut mimic.joint);
            for name in
                [&mut joint.name, &mut joint.parent.link, &mut joint.child.link].into_iter().chain(mimicked)
            {
                name.insert_str(0, &prefix);
            }
            joint
        }));
        robot.name = format!("{} with {}", self.name(), hand.name());
        Ok(self.mounted(robot, hand, prefix))
    }

    /// Links that this one carries, directly or not.
    fn links_below(&self, link: &str) -> HashSet<String> {
        let (mut found, mut pending) = (HashSet::new(), vec![link]);
        while let Some(next) = pending.pop() {
            let children = self.below(next).map(|joint| joint.child.link.as_str());
            pending.extend(children.filter(|child| found.insert((*child).to_owned())));
        }
        found
    }
}

fn rigid(name: &str, parent: &str, child: &str) -> urdf_rs::Joint {
    urdf_rs::Joint {
        name: name.to_owned(),
        joint_type: urdf_rs::JointType::Fixed,
        origin: urdf_rs::Pose::default(),
        parent: urdf_rs::LinkName { link: parent.to_owned() },
        child: urdf_rs::LinkName { link: child.to_owned() },
        axis: urdf_rs::Axis::default(),
        limit: urdf_rs::JointLimit::default(),
        calibration: None,
        dynamics: None,
        mimic: None,
        safety_controller: None,
    }
}
