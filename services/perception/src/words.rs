use coact_joint_task::{Act, Task};
use coact_messages::{Heard, MAX_ACTS};
use coact_period::cycles;
use std::time::Duration;

/// How long a sentence is remembered: until the reach that it announces has ended. Chosen by hand.
const STAYS: u64 = cycles(Duration::from_secs(3));
/// Fraction of a phrase's words below which a sentence says nothing of the kind, and from which it counts: half of them
/// may be common to all phrases. Chosen by hand.
const SAYS: (f64, f64) = (0.5, 0.65);
/// How much what fits less well than the best is left out: the exponent of its fraction of the best. Chosen by hand: one
/// word of six fewer leaves 5 %.
const SHARPNESS: i32 = 16;
/// Words that no phrase and no sentence is told apart by.
const ARTICLES: [&str; 3] = ["the", "a", "an"];
/// How the names of parts are written and said.
const NUMBERS: [&str; 10] = ["zero", "one", "two", "three", "four", "five", "six", "seven", "eight", "nine"];
/// Most words of a sentence that are listened to: more than the 256 bytes of a message hold.
const MOST_WORDS: usize = 64;

/// Understands what the person says as far as words go: how well a sentence fits each phrase of the task.
#[derive(Debug, Clone)]
pub(crate) struct Words {
    phrases: Vec<Phrase>,
    /// The sentence that `fit` belongs to: how many came before it and were it, and when it was complete.
    sentence: (u64, u64),
    /// Evidence for each act.
    fit: Vec<f64>,
}

/// One phrase by which a chain is spoken of.
#[derive(Debug, Clone)]
struct Phrase {
    /// Index of the act.
    act: usize,
    /// Its words, and the weight of each: the part's name weighs as much as one word.
    words: Vec<(String, f64)>,
}

impl Words {
    pub fn new(task: &Task) -> Self {
        let spoken = task.acts.iter().enumerate().filter_map(|(act, kind)| match kind {
            Act::Word(chain) => Some((act, &task.chains[*chain])),
            _ => None,
        });
        let phrases = spoken.flat_map(|(act, chain)| {
            let name = task.kinds[chain.kind].name.to_lowercase();
            chain.says.iter().map(move |text| Phrase { act, words: weighed(text, &name) })
        });
        Self { phrases: phrases.collect(), sentence: (0, 0), fit: vec![0.0; task.acts.len().min(MAX_ACTS)] }
    }

    /// Takes in the newest sentence.
    pub fn listen(&mut self, heard: &Heard) {
        if self.sentence != (heard.sentences, heard.cycle) {
            self.sentence = (heard.sentences, heard.cycle);
            self.compare(heard.sentence());
        }
    }

    /// Evidence for each act from what was said just now; none when nothing was.
    pub fn heard(&self, tick: u64) -> Option<&[f64]> {
        let (sentences, cycle) = self.sentence;
        let present = sentences > 0 && cycle <= tick && tick - cycle < STAYS;
        present.then_some(&self.fit[..])
    }

    fn compare(&mut self, sentence: &str) {
        self.fit.fill(0.0);
        for phrase in &self.phrases {
            let fit = &mut self.fit[phrase.act];
            *fit = fit.max(phrase.fraction_in(sentence));
        }
        let best = self.fit.iter().copied().fold(0.0, f64::max);
        for fit in self.fit.iter_mut().filter(|fit| **fit > 0.0) {
            let says = crate::evidence::smooth_step(*fit, SAYS.0, SAYS.1);
            *fit *= says * (*fit / best).powi(SHARPNESS);
        }
    }
}

impl Phrase {
    /// Weight of those of its words that occur in `sentence` in their order, as a fraction of all: the heaviest common
    /// subsequence, whatever other words are between.
    fn fraction_in(&self, sentence: &str) -> f64 {
        let mut row = [0.0_f64; MOST_WORDS + 1];
        for (word, weight) in &self.words {
            let mut diagonal = 0.0;
            for (place, said) in words(sentence).take(MOST_WORDS).enumerate() {
                let above = row[place + 1];
                let with = if is_same(said, word) { diagonal + weight } else { 0.0 };
                row[place + 1] = above.max(row[place]).max(with);
                diagonal = above;
            }
        }
        let all: f64 = self.words.iter().map(|(_, weight)| weight).sum();
        row.iter().copied().fold(0.0, f64::max) / all.max(1e-9)
    }
}

/// The words of `text` with their weights: those of `name` together weigh as much as any other word.
fn weighed(text: &str, name: &str) -> Vec<(String, f64)> {
    let own: Vec<&str> = words(name).collect();
    let weight = |word: &str| if own.contains(&word) { 1.0 / own.len() as f64 } else { 1.0 };
    words(text).map(|word| (word.to_owned(), weight(word))).collect()
}

/// The words of a text that count.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let all = text.split(|letter: char| !letter.is_alphanumeric()).filter(|word| !word.is_empty());
    all.filter(|word| !ARTICLES.iter().any(|article| word.eq_ignore_ascii_case(article)))
}

/// Whether a word was said that is written `written`, in lower case: "one" for "1" as well.
fn is_same(said: &str, written: &str) -> bool {
    let digit = |word: &str| NUMBERS.iter().position(|number| word.eq_ignore_ascii_case(number));
    let number = || written.parse::<usize>().ok().filter(|_| digit(said).is_some());
    let lower = said.chars().flat_map(char::to_lowercase);
    lower.eq(written.chars()) || number().is_some_and(|number| digit(said) == Some(number))
}
