use crate::{JudgedCell, Moment, Outcome, matrix};
use serde::Serialize;

/// What became of a matrix.
#[derive(Debug, Clone, Serialize)]
pub struct MatrixReport {
    /// Every cell that was to be done.
    pub cells: Vec<JudgedCell>,
    /// Faults that no cell has yet, and why.
    pub not_covered: Vec<(&'static str, &'static str)>,
    /// How long it took, s.
    pub duration_s: f64,
}

/// A row of the table: a fault and whom it strikes, with its outcome at each moment.
#[derive(Debug, Clone)]
pub struct Row<'a> {
    /// The fault.
    pub fault: String,
    /// Whom it strikes.
    pub target: String,
    /// In the order of [`Moment::ALL`]; none where there is no cell.
    pub outcomes: [Option<&'a Outcome>; Moment::ALL.len()],
}

impl MatrixReport {
    /// Of these cells.
    pub fn new(cells: Vec<JudgedCell>, duration_s: f64) -> Self {
        Self { cells, not_covered: matrix::NOT_COVERED.to_vec(), duration_s }
    }

    /// Whether the work was done safely in every cell, and with `strict` in time as well: what is unknown does not pass.
    pub fn passes(&self, strict: bool) -> bool {
        self.cells.iter().all(|cell| match cell.outcome {
            Outcome::Green => true,
            Outcome::Late(_) => !strict,
            Outcome::Red(_) | Outcome::Unknown(_) => false,
        })
    }

    /// How many cells are green, late, red and unknown.
    pub fn counts(&self) -> [usize; 4] {
        let count = |is: fn(&Outcome) -> bool| self.cells.iter().filter(|cell| is(&cell.outcome)).count();
        [
            count(|outcome| matches!(outcome, Outcome::Green)),
            count(|outcome| matches!(outcome, Outcome::Late(_))),
            count(|outcome| matches!(outcome, Outcome::Red(_))),
            count(|outcome| matches!(outcome, Outcome::Unknown(_))),
        ]
    }

    /// The table, by faults in the order of their first cells.
    pub fn rows(&self) -> Vec<Row<'_>> {
        let mut rows: Vec<Row<'_>> = Vec::new();
        for judged in &self.cells {
            let (fault, target) = (judged.cell.fault.to_string(), judged.cell.target.to_string());
            let column = Moment::ALL.iter().position(|moment| *moment == judged.cell.moment);
            let place = rows.iter().position(|row| row.fault == fault && row.target == target);
            let place = place.unwrap_or_else(|| {
                rows.push(Row { fault, target, outcomes: [None; Moment::ALL.len()] });
                rows.len() - 1
            });
            if let Some(column) = column {
                rows[place].outcomes[column] = Some(&judged.outcome);
            }
        }
        rows
    }
}
