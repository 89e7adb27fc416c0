use coact_joint_task::Task;
use coact_messages::{MAX_PARTS, MAX_SUBGOALS, Truth};

/// Which parts are in which hand, and which subgoals' parts are in their places.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct PartLocations {
    /// Parts in the hands of robot and person, bit for bit.
    held: [u64; 2],
    /// Subgoals, bit for bit.
    in_place: u64,
}

/// Robot and person, by their index in the messages, as captions name them.
const WHO: [&str; 2] = ["robot", "person"];

impl From<&Truth> for PartLocations {
    fn from(truth: &Truth) -> Self {
        Self { held: truth.held, in_place: truth.achieved }
    }
}

impl PartLocations {
    /// What has changed since `before`, in words; none when nothing has.
    ///
    /// That a part left a hand is said only where it is neither in the other hand nor in its place now.
    pub fn changes_since(&self, before: &Self, task: &Task) -> Option<String> {
        let mut changes: Vec<String> = Vec::new();
        if before.in_place & !self.in_place != 0 {
            changes.push("the parts are laid out again".into());
        }
        for (who, name) in WHO.iter().enumerate() {
            let other = 1 - who;
            for part in parts(self.held[who] & !before.held[who], task) {
                let from_other = before.held[other] & (1 << part) != 0;
                let from = if from_other { format!(" from the {}", WHO[other]) } else { String::new() };
                changes.push(format!("{name} takes {}{from}", kind(part, task)));
            }
        }
        let done: Vec<_> = subgoals(self.in_place & !before.in_place, task).collect();
        changes.extend(done.iter().map(|&goal| format!("in place: {}", task.subgoals[goal].name)));
        for (who, name) in WHO.iter().enumerate() {
            let left = before.held[who] & !self.held[0] & !self.held[1];
            let placed =
                |part: &usize| done.iter().any(|&goal| task.subgoals[goal].kind == task.parts[*part].kind);
            let lost = parts(left, task).filter(|part| !placed(part));
            changes.extend(lost.map(|part| format!("{} leaves the {name}'s hand", kind(part, task))));
        }
        (!changes.is_empty()).then(|| changes.join("; "))
    }

    /// Names of the kinds of part in the hand of `who`.
    pub fn held_by(&self, who: usize, task: &Task) -> Vec<String> {
        parts(self.held[who], task).map(|part| kind(part, task).to_owned()).collect()
    }

    /// Names of the subgoals whose parts are in their places.
    pub fn names_in_place(&self, task: &Task) -> Vec<String> {
        subgoals(self.in_place, task).map(|goal| task.subgoals[goal].name.clone()).collect()
    }
}

fn kind(part: usize, task: &Task) -> &str {
    &task.kinds[task.parts[part].kind].name
}

fn parts(mask: u64, task: &Task) -> impl Iterator<Item = usize> + use<> {
    (0..task.parts.len().min(MAX_PARTS)).filter(move |part| mask & (1 << part) != 0)
}

fn subgoals(mask: u64, task: &Task) -> impl Iterator<Item = usize> + use<> {
    (0..task.subgoals.len().min(MAX_SUBGOALS)).filter(move |goal| mask & (1 << goal) != 0)
}
