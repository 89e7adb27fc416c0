use crate::{Posture, Robot, grip};
use nalgebra::{Isometry3, Point3, Vector3};
use std::f64::consts::TAU;

/// Where the hand shall go: a place for the grasp point, a direction of approach, and what is left free.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HandGoal {
    /// Place of the grasp point, m, world.
    pub point: Point3<f64>,
    /// Direction in which the hand approaches, unit, world.
    pub approach: Vector3<f64>,
    /// Direction of the closing axis at roll 0, world.
    pub closing: Vector3<f64>,
    /// How many rolls about the approach serve as well, evenly spaced: 2 for something with two flat sides; 0 = any.
    pub rolls: u32,
    /// Distance along the approach of the pose before (pre-grasp, pre-place), m.
    pub back: f64,
    /// Height that shoulder, elbow and wrist stay above, m, world.
    pub floor: f64,
}

/// The postures found for a [`HandGoal`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Reach {
    /// Before the approach.
    pub before: Posture,
    /// At the goal.
    pub at: Posture,
}

/// The search for the postures that are most comfortable to reach: smallest weighted squared way of the joints from
/// the present posture. Over the swivel angle, the roll that the goal leaves free and all branches, first on a
/// coarse grid, then twice finer around the best. It is spread over ticks; its whole state is here.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PostureSearch {
    /// Next grid point.
    pub cursor: u32,
    /// 1 when something was found.
    pub found: u32,
    /// Cost of the best so far, rad².
    pub cost: f64,
    /// Swivel angle of the best so far, rad.
    pub swivel: f64,
    /// Roll of the best so far, rad.
    pub roll: f64,
    /// Centre of the present refinement: swivel and roll, rad.
    pub centre: [f64; 2],
    /// The best so far.
    pub best: Reach,
}

const SWIVELS: u32 = 24;
const ROLLS: u32 = 12;
/// Grid points of one refinement: FINE x FINE around the best.
const FINE: u32 = 5;
const COARSE_POINTS: u32 = SWIVELS * ROLLS;
const ALL_POINTS: u32 = COARSE_POINTS + 2 * FINE * FINE;
/// Distance from the joint limits that postures keep, rad.
const MARGIN: f64 = 0.05;
/// Largest change of a joint between the pose before and the goal, rad: more is another branch, or a detour.
const LARGEST_STEP: f64 = 0.9;
/// Cost of each joint's way: moving the whole arm costs more than turning the wrist.
const WEIGHT: Posture = [1.0, 1.0, 0.8, 0.8, 0.6, 0.6, 0.4];
/// Radius of the arm at its centres, m.
const ARM_RADIUS: f64 = 0.06;

impl PostureSearch {
    /// Looks at up to `budget` grid points. `Some(Some(_))` when done, `Some(None)` when done without success.
    pub fn advance(
        &mut self,
        robot: &Robot,
        goal: &HandGoal,
        from: &Posture,
        budget: u32,
    ) -> Option<Option<Reach>> {
        for _ in 0..budget {
            if self.cursor >= ALL_POINTS || (self.cursor >= COARSE_POINTS && self.found == 0) {
                return Some((self.found == 1).then_some(self.best));
            }
            let point = self.cursor;
            self.cursor += 1;
            if let Some((swivel, roll)) = self.grid_point(point, goal) {
                self.look_at(robot, goal, from, swivel, roll);
            }
        }
        None
    }

    /// The whole search at once.
    pub fn complete(robot: &Robot, goal: &HandGoal, from: &Posture) -> Option<Reach> {
        Self::default().advance(robot, goal, from, ALL_POINTS + 1).flatten()
    }

    /// Swivel and roll of a grid point; `None` where the goal has fewer rolls.
    fn grid_point(&mut self, point: u32, goal: &HandGoal) -> Option<(f64, f64)> {
        if point < COARSE_POINTS {
            let (swivel, roll) = (point % SWIVELS, point / SWIVELS);
            let rolls = if goal.rolls == 0 { ROLLS } else { goal.rolls.min(ROLLS) };
            return (roll < rolls).then(|| (angle(swivel, SWIVELS), angle(roll, rolls)));
        }
        let (level, index) =
            ((point - COARSE_POINTS) / (FINE * FINE), (point - COARSE_POINTS) % (FINE * FINE));
        if index == 0 {
            self.centre = [self.swivel, self.roll];
        }
        let scale = if level == 0 { 1.0 / 3.0 } else { 1.0 / 9.0 };
        let offset =
            |step: u32, count: u32| (f64::from(step) - f64::from(FINE / 2)) * scale * TAU / f64::from(count);
        let roll_free = if goal.rolls == 0 { 1.0 } else { 0.0 };
        let swivel = self.centre[0] + offset(index % FINE, SWIVELS);
        Some((swivel, self.centre[1] + roll_free * offset(index / FINE, ROLLS)))
    }

    fn look_at(&mut self, robot: &Robot, goal: &HandGoal, from: &Posture, swivel: f64, roll: f64) {
        let palm_at = |back: f64| -> Isometry3<f64> {
            let point = goal.point - goal.approach * back;
            robot.hand.palm_at(&point, &goal.approach, &goal.closing, roll)
        };
        let before = robot.kinematics.solve(&palm_at(goal.back), swivel, MARGIN);
        for candidate in before.as_slice() {
            let cost = cost(candidate, from);
            if (self.found == 1 && cost >= self.cost) || !above(robot, candidate, goal.floor) {
                continue;
            }
            let at = robot.kinematics.solve(&palm_at(0.0), swivel, MARGIN);
            let near = at.as_slice().iter().find(|at| largest_step(at, candidate) <= LARGEST_STEP);
            let Some(at) = near.filter(|at| above(robot, at, goal.floor)) else { continue };
            let best = Reach { before: *candidate, at: *at };
            let Self { cursor, centre, .. } = *self;
            *self = Self { cursor, found: 1, cost, swivel, roll, centre, best };
        }
    }
}

impl HandGoal {
    /// Goal for gripping, or placing, an upright or lying part: `frame` is that of the part (centre of its underside,
    /// its z axis the way out of its socket), `height` its height, m. The hand comes from the top of the part.
    pub fn grip(frame: &Isometry3<f64>, height: f64, rolls: u32, back: f64, floor: f64) -> Self {
        let point = frame * Point3::new(0.0, 0.0, grip::grip_height(height));
        let approach = frame.rotation * -Vector3::z();
        Self { point, approach, closing: frame.rotation * Vector3::x(), rolls, back, floor }
    }

    /// Goal for gripping an upright part from its side: as [`HandGoal::grip`], but the hand comes across the part's z
    /// axis, from where `turn` rad about that axis points, and closes across it.
    pub fn grip_from_side(frame: &Isometry3<f64>, height: f64, turn: f64, back: f64) -> Self {
        let point = frame * Point3::new(0.0, 0.0, grip::grip_height(height));
        let approach = frame.rotation * -Vector3::new(turn.cos(), turn.sin(), 0.0);
        let closing = frame.rotation * Vector3::new(-turn.sin(), turn.cos(), 0.0);
        Self { point, approach, closing, rolls: 2, back, floor: f64::NEG_INFINITY }
    }
}

fn angle(step: u32, count: u32) -> f64 {
    TAU * f64::from(step) / f64::from(count)
}

fn cost(posture: &Posture, from: &Posture) -> f64 {
    (0..7).map(|joint| WEIGHT[joint] * (posture[joint] - from[joint]).powi(2)).sum()
}

fn largest_step(a: &Posture, b: &Posture) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

fn above(robot: &Robot, posture: &Posture, floor: f64) -> bool {
    robot.arm().centres(posture).iter().all(|centre| centre.z >= floor + ARM_RADIUS)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;
    use nalgebra::{Translation3, UnitQuaternion};

    fn robot() -> Robot {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        Robot::load(&root.join("../../rt-config/robots/aros.toml")).unwrap()
    }

    /// The best of 360 x 120 grid points, without refinement.
    fn brute_force(robot: &Robot, goal: &HandGoal) -> f64 {
        let mut search = PostureSearch::default();
        for roll in 0..120 {
            for swivel in 0..360 {
                search.look_at(robot, goal, &robot.park, angle(swivel, 360), angle(roll, 120));
            }
        }
        search.cost
    }

    #[test]
    fn the_search_comes_close_to_the_best_there_is() {
        let robot = robot();
        let towards = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), std::f64::consts::FRAC_PI_2);
        for (place, turn) in [
            ([-0.36, 0.52, 0.80], UnitQuaternion::identity()),
            ([-0.62, 0.30, 0.99], UnitQuaternion::identity()),
            ([-0.49, 0.30, 0.875], towards),
        ] {
            let frame = Isometry3::from_parts(Translation3::from(Vector3::from(place)), turn);
            let goal = HandGoal::grip(&frame, 0.025, 0, 0.15, 0.8);
            let mut search = PostureSearch::default();
            assert!(search.advance(&robot, &goal, &robot.park, ALL_POINTS + 1).unwrap().is_some());
            let best = brute_force(&robot, &goal);
            assert!(search.cost <= 1.05 * best + 0.02, "{place:?}: {} against {best}", search.cost);
        }
    }

    #[test]
    fn a_part_with_flat_sides_is_gripped_across_them() {
        let robot = robot();
        let goal = HandGoal::grip(&Isometry3::translation(-0.4, 0.55, 0.8), 0.04, 2, 0.15, 0.8);
        let reach = PostureSearch::complete(&robot, &goal, &robot.park).unwrap();
        let closing = robot.palm(&reach.at).rotation * Vector3::x();
        assert!((closing.x.abs() - 1.0).abs() < 1e-9, "{closing}");
    }

    #[test]
    fn what_is_out_of_reach_is_not_found() {
        let robot = robot();
        let goal = HandGoal::grip(&Isometry3::translation(-1.1, 0.3, 0.8), 0.04, 0, 0.15, 0.8);
        assert!(PostureSearch::complete(&robot, &goal, &robot.park).is_none());
    }
}
