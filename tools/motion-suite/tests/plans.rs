//! What holds for every movement of the suite.
#![allow(clippy::unwrap_used)]

use coact_joint_task::Task;
use coact_motion::Plan;
use coact_motion_suite::{Quality, Scenario, Setting};
use coact_robot::Robot;
use rand::SeedableRng;
use rand_pcg::Pcg64;
use std::path::Path;

#[test]
fn plans_are_of_bounded_size_and_keep_the_limits_and_come_to_their_goals() {
    let config = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../rt-config");
    let robot = Robot::load(&config.join("robots/aros.toml")).unwrap();
    let setting = Setting::of(&robot, Task::load(&config.join("tasks/toy-vehicle.toml")).unwrap()).unwrap();
    for scenario in Scenario::ALL {
        let mut random = Pcg64::seed_from_u64(3);
        for _ in 0..8 {
            let Some(case) = scenario.case(&setting, &mut random) else { continue };
            let problem = case.problem(&setting.mechanism);
            let Ok(plan) = problem.plan() else { continue };
            assert!(plan.knots.len() <= Plan::KNOTS, "{}: {}", scenario.name(), plan.knots.len());
            assert_eq!(plan.broken(&setting.mechanism.limits()), None, "{}", scenario.name());
            assert!(Quality::of(&problem, &plan).position_error < 1e-3, "{}", scenario.name());
        }
    }
}
