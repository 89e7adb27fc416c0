use crate::Reach;
use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_pcg::Pcg64;

/// In which order a person's reaches are replayed: it matters, for perception learns from them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Order {
    /// By the number of the trial, sizes mixed by a seed within each: slow drifts of posture are shared by trials of
    /// the same number, so this is the order of the experiment as far as the recordings tell.
    Trial {
        /// Seed of the order within equal trial numbers.
        seed: u64,
    },
    /// As in the file, which stands sorted by size: a person who reaches for large things only, then for others.
    File,
}

impl Order {
    /// The reaches of each person, people in the order of the folder.
    pub fn people<'a>(&self, reaches: &'a [Reach]) -> Vec<Vec<&'a Reach>> {
        let mut people: Vec<Vec<&Reach>> = Vec::new();
        for reach in reaches {
            match people.iter_mut().find(|person| person[0].participant == reach.participant) {
                Some(person) => person.push(reach),
                None => people.push(vec![reach]),
            }
        }
        if let Self::Trial { seed } = *self {
            for person in &mut people {
                person.shuffle(&mut Pcg64::seed_from_u64(seed));
                person.sort_by_key(|reach| reach.trial);
            }
        }
        people
    }
}
