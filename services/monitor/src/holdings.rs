use crate::Moment;
use coact_joint_task::Task;
use coact_messages::{MAX_KINDS, MAX_SUBGOALS, PERSON, Percept, ROBOT};

/// Which kind of part is in whose hand, and which subgoals' parts are in their places.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Holdings {
    /// Kinds in the hands of robot and person, bit for bit.
    held: [u32; 2],
    /// Those of them of which a part has come into its place since it was taken.
    placed: [u32; 2],
    /// Subgoals, bit for bit.
    in_place: u64,
}

/// Evidence from which on a hand holds a part, and up to which it does not any more.
const HELD: f64 = 0.9;
const FREE: f64 = 0.1;
/// Robot and person, by their index, as captions name them.
const WHO: [&str; 2] = ["robot", "person"];

impl Holdings {
    /// Those that a moment of the album shows.
    pub fn of(moment: &Moment, task: &Task) -> Self {
        let kinds = |names: &[String]| mask(task.kinds.iter().map(|kind| names.contains(&kind.name)));
        let subgoals = task.subgoals.iter().map(|goal| moment.in_place.contains(&goal.name));
        Self {
            held: [kinds(&moment.robot_holds) as u32, kinds(&moment.person_holds) as u32],
            placed: [0; 2],
            in_place: mask(subgoals),
        }
    }

    /// Takes in what perception makes of the hands.
    pub fn percept(&mut self, percept: &Percept) {
        for (who, evidence) in [(ROBOT, &percept.robot_holds), (PERSON, &percept.person_holds)] {
            for (kind, evidence) in evidence.iter().enumerate() {
                match *evidence {
                    HELD.. => self.held[who] |= 1 << kind,
                    ..FREE => self.held[who] &= !(1 << kind),
                    _ => {}
                }
            }
            self.placed[who] &= self.held[who];
        }
    }

    /// Takes in which subgoals' parts are in their places.
    pub fn in_place(&mut self, achieved: u64, task: &Task) {
        let new = achieved & !self.in_place;
        let kinds = subgoals(new, task).fold(0, |kinds, goal| kinds | 1_u32 << task.subgoals[goal].kind);
        for (placed, held) in self.placed.iter_mut().zip(self.held) {
            *placed |= held & kinds;
        }
        self.in_place = achieved;
    }

    /// What has changed since `before`, in words; none when nothing has that tells something new.
    ///
    /// A hand that lets a part go tells nothing new when the part is in its place then, or in the other hand.
    pub fn news_since(&self, before: &Self, task: &Task) -> Option<String> {
        let mut news: Vec<String> = Vec::new();
        if before.in_place & !self.in_place != 0 {
            news.push("the parts are laid out again".into());
        }
        for (who, name) in WHO.iter().enumerate() {
            let other = 1 - who;
            for kind in kinds(self.held[who] & !before.held[who], task) {
                let from_other = before.held[other] & (1 << kind) != 0;
                let from = if from_other { format!(" from the {}", WHO[other]) } else { String::new() };
                news.push(format!("{name} takes {}{from}", task.kinds[kind].name));
            }
        }
        let done = subgoals(self.in_place & !before.in_place, task);
        news.extend(done.map(|goal| format!("in place: {}", task.subgoals[goal].name)));
        for (who, name) in WHO.iter().enumerate() {
            let let_go = before.held[who] & !self.held[who];
            let told = before.placed[who] | self.held[1 - who];
            news.extend(
                kinds(let_go & !told, task)
                    .map(|kind| format!("{name} lets go of {}", task.kinds[kind].name)),
            );
        }
        (!news.is_empty()).then(|| news.join("; "))
    }

    /// Names of the kinds in the hand of `who`.
    pub fn held_by(&self, who: usize, task: &Task) -> Vec<String> {
        kinds(self.held[who], task).map(|kind| task.kinds[kind].name.clone()).collect()
    }

    /// Names of the subgoals whose parts are in their places.
    pub fn names_in_place(&self, task: &Task) -> Vec<String> {
        subgoals(self.in_place, task).map(|goal| task.subgoals[goal].name.clone()).collect()
    }
}

fn mask(bits: impl Iterator<Item = bool>) -> u64 {
    bits.enumerate().fold(0, |mask, (index, set)| mask | u64::from(set) << index)
}

fn kinds(mask: u32, task: &Task) -> impl Iterator<Item = usize> + use<> {
    (0..task.kinds.len().min(MAX_KINDS)).filter(move |kind| mask & (1 << kind) != 0)
}

fn subgoals(mask: u64, task: &Task) -> impl Iterator<Item = usize> + use<> {
    (0..task.subgoals.len().min(MAX_SUBGOALS)).filter(move |goal| mask & (1 << goal) != 0)
}
