use super::finding::{Finding, FindingKind};
use super::subject::Subject;

/// Sentences that stand for two chains.
pub(super) fn alike(subject: &Subject) -> Vec<Finding> {
    let chains = &subject.task.chains;
    let said = |chain: usize| chains[chain].says.iter().map(move |phrase| (chain, phrase));
    let phrases: Vec<(usize, &String)> = (0..chains.len()).flat_map(said).collect();
    let pairs = (0..phrases.len()).flat_map(|one| (0..one).map(move |other| (other, one)));
    pairs
        .map(|(one, other)| (phrases[one], phrases[other]))
        .filter(|((one, phrase), (other, same))| one != other && phrase == same)
        .map(|((one, phrase), (other, _))| finding(subject, one, other, phrase))
        .collect()
}

fn finding(subject: &Subject, one: usize, other: usize, phrase: &str) -> Finding {
    let task = &subject.task;
    let named =
        |chain: usize| format!("{}: {}", task.chains[chain].name, task.kinds[task.chains[chain].kind].name);
    let span = subject.file.chain[subject.rule_of(other)].says.first().map(|phrase| phrase.span());
    Finding {
        kind: FindingKind::AmbiguousPhrase,
        place: span.map_or_else(|| subject.place_of_chain(other), |span| subject.place(span)),
        what: format!("{phrase:?} stands for both {:?} and {:?}", named(one), named(other)),
        why: "what is said would activate two chains at once, and decide nothing".into(),
        advice: "word one of the phrases differently, or name the kinds of part apart".into(),
    }
}
