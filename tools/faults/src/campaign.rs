use crate::judge::judge;
use crate::trial::Trial;
use crate::{Cell, JudgedCell, Outcome, Setup, Trouble, matrix};
use std::collections::VecDeque;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Does cells in as few runs as possible, and judges each.
#[derive(Debug)]
pub struct Campaign<'a> {
    setup: &'a Setup,
    /// No run is begun after this instant.
    until: Option<Instant>,
    /// No run is begun once this is set.
    interrupted: &'a AtomicBool,
}

/// What a campaign tells while it goes on.
#[derive(Debug)]
pub enum Step<'a> {
    /// A run begins with these cells; so many are left after it.
    Run(&'a [Cell], usize),
    /// A cell was judged.
    Judged(&'a JudgedCell),
    /// These cells of a run with several could not be judged; they are done again in two runs, until the one that spoiled the
    /// others' is alone.
    Again(&'a [Cell]),
}

impl<'a> Campaign<'a> {
    /// With this setup; no run is begun after `until`, nor once it is `interrupted`.
    pub fn new(setup: &'a Setup, until: Option<Instant>, interrupted: &'a AtomicBool) -> Self {
        Self { setup, until, interrupted }
    }

    /// Does all cells, and tells each `step`.
    pub fn run(&self, cells: Vec<Cell>, step: &mut dyn FnMut(Step<'_>)) -> Vec<JudgedCell> {
        let order = cells.clone();
        let mut runs = VecDeque::from(matrix::runs(cells));
        let mut judged = Vec::new();
        while let Some(run) = runs.pop_front() {
            let why_not = self.why_not();
            let outcomes = match why_not {
                Some(why_not) => run.iter().map(|cell| not_judged(cell, why_not)).collect(),
                None => {
                    step(Step::Run(&run, runs.len()));
                    self.outcomes(&run)
                }
            };
            let is_told = |cell: &JudgedCell| !matches!(cell.outcome, Outcome::Unknown(_));
            let (mut told, unknown): (Vec<_>, Vec<_>) = outcomes.into_iter().partition(is_told);
            let again: Vec<_> = unknown.iter().map(|judged| judged.cell.clone()).collect();
            if !again.is_empty() && run.len() > 1 && why_not.is_none() {
                step(Step::Again(&again));
                runs.extend(again.chunks(again.len().div_ceil(2)).map(<[Cell]>::to_vec));
            } else {
                told.extend(unknown);
            }
            for cell in told {
                step(Step::Judged(&cell));
                judged.push(cell);
            }
        }
        judged.sort_by_key(|judged| order.iter().position(|cell| *cell == judged.cell));
        judged
    }

    /// Why no run is to be begun any more.
    fn why_not(&self) -> Option<&'static str> {
        if self.interrupted.load(Ordering::Relaxed) {
            return Some("it was interrupted before");
        }
        self.until.is_some_and(|until| Instant::now() >= until).then_some("there was no time left")
    }

    fn outcomes(&self, cells: &[Cell]) -> Vec<JudgedCell> {
        // A thread of its own: what it mounts goes with it.
        let judged = std::thread::scope(|scope| {
            let panicked = |_| Err(Trouble("it panicked".into()));
            scope.spawn(|| self.done(cells)).join().unwrap_or_else(panicked)
        });
        judged.unwrap_or_else(|trouble| cells.iter().map(|cell| not_judged(cell, &trouble.0)).collect())
    }

    /// The cells after a run.
    fn done(&self, cells: &[Cell]) -> Result<Vec<JudgedCell>, Trouble> {
        let (records, evidence, set) = Trial::run(self.setup, cells)?;
        let judged = |record: &crate::record::Record| JudgedCell {
            cell: record.cell.clone(),
            outcome: judge(record, &evidence, &self.setup.rules, cells.len() == 1),
        };
        let judged: Vec<_> = records.iter().map(judged).collect();
        let poor = judged.iter().find(|judged| judged.outcome != Outcome::Green);
        if let (Some(poor), Some(_)) = (poor, &self.setup.kept) {
            // The verdict stands, whether or not its evidence can be kept.
            set.keep(&poor.cell.to_string()).ok();
        }
        Ok(judged)
    }
}

fn not_judged(cell: &Cell, why: &str) -> JudgedCell {
    JudgedCell { cell: cell.clone(), outcome: Outcome::Unknown(why.into()) }
}
