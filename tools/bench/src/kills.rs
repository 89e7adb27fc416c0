use coact_supervisor::{Fault, Injection};
use std::time::Duration;

/// Each process of the chain is killed once in this time.
const MINUTE: Duration = Duration::from_secs(60);

/// One SIGKILL of each process a minute, at equal distances, for as long as the run lasts. The last kill comes so early that its
/// recovery is seen.
pub fn kills(chain: &[String], duration: Duration) -> Vec<Injection> {
    let pause = MINUTE / (chain.len() as u32 + 1);
    let minutes = (0..).map(|minute| MINUTE * minute).take_while(|begin| *begin < duration);
    let of_minute = |begin: Duration| {
        let at = move |place: usize| begin + pause * (place as u32 + 1);
        chain.iter().enumerate().map(move |(place, process)| Injection {
            process: process.clone(),
            fault: Fault::Kill,
            at: at(place),
        })
    };
    minutes.flat_map(of_minute).filter(|kill| kill.at + pause / 2 < duration).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_process_dies_once_a_minute_and_not_at_the_end() {
        let chain = ["world", "perception", "fields", "control"].map(str::to_owned);
        let killed = |seconds| kills(&chain, Duration::from_secs(seconds));
        assert_eq!(killed(120).len(), 8);
        assert_eq!(killed(20).iter().map(|kill| kill.process.as_str()).collect::<Vec<_>>(), ["world"]);
        assert_eq!(killed(15), []);
    }
}
