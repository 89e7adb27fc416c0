use crate::ShapeError;
use crate::places::MOST_PLACES;
use coact_messages::MAX_KINDS;

/// What size a random task has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TaskShape {
    subgoals: usize,
    predecessors: usize,
    identical: f64,
    offered: f64,
}

/// With fewer subgoals there is no order to speak of.
const FEWEST: usize = 3;
/// After so many subgoals one may come at most.
const MOST_PREDECESSORS: usize = 16;
/// So many subgoals share one kind of part, and the last such kind one more if one is left over.
const ALIKE: usize = 2;

impl TaskShape {
    /// A task of `subgoals` steps, one of which at least comes after exactly `predecessors` others, and none after more; parts
    /// of the share `identical` of all steps are like that of another step.
    ///
    /// # Errors
    /// [`ShapeError`], if there is no such task.
    pub fn new(subgoals: usize, predecessors: usize, identical: f64) -> Result<Self, ShapeError> {
        if !(FEWEST..=MOST_PLACES).contains(&subgoals) {
            return Err(ShapeError::Subgoals { found: subgoals, least: FEWEST, most: MOST_PLACES });
        }
        let most = MOST_PREDECESSORS.min(subgoals - 1);
        if !(1..=most).contains(&predecessors) {
            return Err(ShapeError::Predecessors { found: predecessors, most });
        }
        if !(0.0..=1.0).contains(&identical) {
            return Err(ShapeError::Share { found: identical, of: "with identical parts" });
        }
        let shape = Self { subgoals, predecessors, identical, offered: 0.0 };
        match shape.kinds() {
            found if found > MAX_KINDS => Err(ShapeError::Kinds { found }),
            _ => Ok(shape),
        }
    }

    /// The same, with choices that offer the share `offered` of all steps, as far as there are steps that can be alternatives to each other. A
    /// step that comes after several alternatives comes after the choice, and so after fewer others.
    ///
    /// # Errors
    /// [`ShapeError::Share`], if it is no share.
    pub fn with_choices(self, offered: f64) -> Result<Self, ShapeError> {
        match (0.0..=1.0).contains(&offered) {
            true => Ok(Self { offered, ..self }),
            false => Err(ShapeError::Share { found: offered, of: "in choices" }),
        }
    }

    /// Share of the steps that choices are to offer.
    pub(crate) fn offered(&self) -> f64 {
        self.offered
    }

    /// How many steps there are.
    pub fn subgoals(&self) -> usize {
        self.subgoals
    }

    /// How many others a step comes after at most.
    pub fn predecessors(&self) -> usize {
        self.predecessors
    }

    /// How many kinds of parts there are: those of which there are several come first.
    pub fn kinds(&self) -> usize {
        let (shared, alike) = self.shared();
        shared + self.subgoals - alike
    }

    /// The kind of the part that the `index`-th step needs, before the steps are shuffled.
    pub(crate) fn kind(&self, index: usize) -> usize {
        let (shared, alike) = self.shared();
        match index < alike {
            true => (index / ALIKE).min(shared - 1),
            false => shared + index - alike,
        }
    }

    /// How many kinds there are several parts of, and of how many steps they are.
    fn shared(&self) -> (usize, usize) {
        let alike = (self.identical * self.subgoals as f64).round() as usize;
        match alike / ALIKE {
            0 => (0, 0),
            shared => (shared, alike),
        }
    }
}
