use super::examined_task::ExaminedTask;
use super::finding::{Finding, FindingKind};

/// Sentences that stand for two chains.
pub(super) fn find(examined: &ExaminedTask) -> Vec<Finding> {
    let chains = &examined.task.chains;
    let said = |chain: usize| chains[chain].says.iter().map(move |phrase| (chain, phrase));
    let phrases: Vec<(usize, &String)> = (0..chains.len()).flat_map(said).collect();
    let pairs = (0..phrases.len()).flat_map(|one| (0..one).map(move |other| (other, one)));
    pairs
        .map(|(one, other)| (phrases[one], phrases[other]))
        .filter(|((one, phrase), (other, same))| one != other && phrase == same)
        .map(|((one, phrase), (other, _))| finding(examined, one, other, phrase))
        .collect()
}

fn finding(examined: &ExaminedTask, one: usize, other: usize, phrase: &str) -> Finding {
    let task = &examined.task;
    let named =
        |chain: usize| format!("{}: {}", task.chains[chain].name, task.kinds[task.chains[chain].kind].name);
    let span = examined.file.chain[examined.rule_of(other)].says.first().map(|phrase| phrase.span());
    Finding {
        kind: FindingKind::AmbiguousPhrase,
        place: span.map_or_else(|| examined.place_of_chain(other), |span| examined.place(span)),
        what: format!("{phrase:?} stands for both {:?} and {:?}", named(one), named(other)),
        why: "what is said would activate two chains at once, and decide nothing".into(),
        advice: "word one of the phrases differently, or name the kinds of part apart".into(),
    }
}
