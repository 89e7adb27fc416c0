use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus};
use coact_robot::Posture;

/// A step of sequential quadratic programming: the change of up to seven joints that costs least, keeps within a box,
/// and satisfies linear constraints as well as it can. Two slacks (the largest violations of the inequalities and of the
/// equalities) keep it solvable.
#[derive(Debug, Clone)]
pub(crate) struct QuadraticProgram {
    /// The cost of a change x is sum w (x - c)²: weight and centre of each joint.
    pub weight: Posture,
    pub centre: Posture,
    /// Box of the change.
    pub lower: Posture,
    pub upper: Posture,
    /// `row . x >= bound`.
    pub above: Vec<(Posture, f64)>,
    /// `row . x = value`.
    pub equal: Vec<(Posture, f64)>,
    /// Cost of each unit of the two slacks.
    pub penalty: f64,
}

/// Variables: the changes of seven joints, then the slacks of the inequalities and of the equalities.
const VARIABLES: usize = 9;
const INEQUALITIES: usize = 7;
const EQUALITIES: usize = 8;
/// Iterations of the interior-point solver at most. Chosen by hand: a bound on time.
const ITERATIONS: u32 = 40;

impl QuadraticProgram {
    /// The best change; none when the solver fails.
    pub fn solve(&self) -> Option<Posture> {
        let mut rows = Rows::default();
        for (row, bound) in &self.above {
            rows.push(row, INEQUALITIES, *bound);
        }
        for (row, value) in &self.equal {
            rows.push(row, EQUALITIES, *value);
            rows.push(&row.map(|entry| -entry), EQUALITIES, -value);
        }
        for joint in 0..7 {
            let unit = |sign: f64| std::array::from_fn(|other| if other == joint { sign } else { 0.0 });
            rows.push_hard(&unit(1.0), self.lower[joint]);
            rows.push_hard(&unit(-1.0), -self.upper[joint]);
        }
        rows.push_slack(INEQUALITIES);
        rows.push_slack(EQUALITIES);
        let quadratic = self.weight.iter().enumerate().map(|(joint, weight)| (joint, joint, 2.0 * weight));
        let p = CscMatrix::new_from_triplets(
            VARIABLES,
            VARIABLES,
            quadratic.clone().map(|(row, ..)| row).collect(),
            quadratic.clone().map(|(_, column, _)| column).collect(),
            quadratic.map(|(.., value)| value).collect(),
        );
        let mut q: Vec<f64> = (0..7).map(|joint| -2.0 * self.weight[joint] * self.centre[joint]).collect();
        q.extend([self.penalty; 2]);
        let count = rows.bounds.len();
        let a = CscMatrix::new_from_triplets(count, VARIABLES, rows.row, rows.column, rows.value);
        let settings = DefaultSettings {
            verbose: false,
            max_iter: ITERATIONS,
            presolve_enable: false,
            ..Default::default()
        };
        let mut solver =
            DefaultSolver::new(&p, &q, &a, &rows.bounds, &[NonnegativeConeT(count)], settings).ok()?;
        solver.solve();
        let solved = matches!(solver.solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved);
        solved.then(|| std::array::from_fn(|joint| solver.solution.x[joint]))
    }
}

/// Rows of `A x + s = b`, `s >= 0`.
#[derive(Default)]
struct Rows {
    row: Vec<usize>,
    column: Vec<usize>,
    value: Vec<f64>,
    bounds: Vec<f64>,
}

impl Rows {
    /// `row . x + slack >= bound`
    fn push(&mut self, row: &Posture, slack: usize, bound: f64) {
        self.entry(slack, -1.0);
        self.push_hard(row, bound);
    }

    /// `row . x >= bound`
    fn push_hard(&mut self, row: &Posture, bound: f64) {
        for (column, &value) in row.iter().enumerate().filter(|(_, value)| **value != 0.0) {
            self.entry(column, -value);
        }
        self.bounds.push(-bound);
    }

    /// The slack itself is not negative.
    fn push_slack(&mut self, slack: usize) {
        self.entry(slack, -1.0);
        self.bounds.push(0.0);
    }

    fn entry(&mut self, column: usize, value: f64) {
        self.row.push(self.bounds.len());
        self.column.push(column);
        self.value.push(value);
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]
    use super::*;

    #[test]
    fn the_nearest_point_of_a_half_space_is_found() {
        let mut row = [0.0; 7];
        (row[0], row[1]) = (1.0, 1.0);
        let problem = QuadraticProgram {
            weight: [1.0; 7],
            centre: [0.0; 7],
            lower: [-1.0; 7],
            upper: [1.0; 7],
            above: vec![(row, 1.0)],
            equal: vec![],
            penalty: 100.0,
        };
        let found = problem.solve().unwrap();
        assert!((found[0] - 0.5).abs() < 1e-6 && (found[1] - 0.5).abs() < 1e-6 && found[2].abs() < 1e-6);
    }

    #[test]
    fn what_cannot_be_met_is_met_as_well_as_possible() {
        let mut row = [0.0; 7];
        row[0] = 1.0;
        let problem = QuadraticProgram {
            weight: [1.0; 7],
            centre: [0.0; 7],
            lower: [-0.1; 7],
            upper: [0.1; 7],
            above: vec![],
            equal: vec![(row, 1.0)],
            penalty: 100.0,
        };
        assert!((problem.solve().unwrap()[0] - 0.1).abs() < 1e-6);
    }
}
