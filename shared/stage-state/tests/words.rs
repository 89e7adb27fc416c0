//! A state as words: what was stored is loaded, and nothing else is.
#![allow(clippy::unwrap_used)]

use bytemuck::{CheckedBitPattern, NoUninit, Zeroable};
use coact_stage_state::{Blank, Flag, Implausible, Slot, StageState, StateError, ensure, finite};
use proptest::prelude::*;

const WORDS: usize = 16;

#[repr(u64)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
enum Phase {
    Idle = 0,
    Move = 1,
    Wait = 2,
}

#[repr(C, u64)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
enum Query {
    Closed(Blank) = 0,
    Open { since: u64 } = 1,
}

#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
struct State {
    phase: Phase,
    query: Query,
    held: Flag,
    part: Slot,
    angles: [f64; 3],
    elapsed: f64,
}

impl StageState for State {
    const STAGE: &'static str = "test";
    const LAYOUT: u32 = 3;

    fn check(&self) -> Result<(), Implausible> {
        finite("angles", &self.angles)?;
        ensure(self.elapsed >= 0.0, "elapsed", "a time from 0 s on")
    }
}

/// The same words as a later version would read them.
#[repr(transparent)]
#[derive(Debug, Clone, Copy, PartialEq, CheckedBitPattern, NoUninit, Zeroable)]
struct Later(State);

impl StageState for Later {
    const STAGE: &'static str = "test";
    const LAYOUT: u32 = 4;

    fn check(&self) -> Result<(), Implausible> {
        Ok(())
    }
}

fn example() -> State {
    State {
        phase: Phase::Wait,
        query: Query::Open { since: 7 },
        held: Flag::Set,
        part: Slot::of(5),
        angles: [0.1, -0.0, 1e300],
        elapsed: 0.25,
    }
}

fn stored(state: &State) -> [f64; WORDS] {
    let mut words = [f64::NAN; WORDS];
    state.store(&mut words);
    words
}

fn refusal(change: impl Fn(&mut [f64; WORDS])) -> StateError {
    let mut words = stored(&example());
    change(&mut words);
    State::load(&words).unwrap_err()
}

#[test]
fn words_behind_the_state_are_zero() {
    assert!(stored(&example())[11..].iter().all(|word| word.to_bits() == 0));
}

#[test]
fn words_of_nobody_and_of_another_version_are_refused() {
    let others = State::load(&[0.0; WORDS]).unwrap_err();
    assert!(matches!(others, StateError::Mark { found: 0, .. }), "{others}");
    let later = Later::load(&stored(&example())).unwrap_err();
    assert!(matches!(later, StateError::Mark { layout: 4, .. }), "{later}");
}

#[test]
fn the_word_that_is_no_value_of_its_type_is_named() {
    // Phase, tag of the query, flag.
    for word in [1, 2, 4] {
        let refused = refusal(|words| words[word] = f64::from_bits(9));
        assert_eq!(refused, StateError::NoValue { stage: "test", word, found: 9 });
    }
    // A blank that holds something.
    let closed = refusal(|words| words[2] = f64::from_bits(0));
    assert_eq!(closed, StateError::NoValue { stage: "test", word: 3, found: 7 });
}

#[test]
fn an_implausible_field_is_named() {
    assert!(refusal(|words| words[7] = f64::INFINITY).to_string().contains("angles"));
    assert!(refusal(|words| words[9] = -1.0).to_string().contains("elapsed"));
}

#[test]
fn any_word_that_was_changed_is_found_out() {
    for word in 0..=10 {
        for bit in 0..64 {
            let changed =
                |words: &mut [f64; WORDS]| words[word] = f64::from_bits(words[word].to_bits() ^ 1 << bit);
            refusal(changed);
        }
    }
}

#[test]
fn a_slot_is_an_index_or_none() {
    assert_eq!((Slot::of(3).get(), Slot::EMPTY.get()), (Some(3), None));
    assert_eq!((Slot::of(3).or(9), Slot::EMPTY.or(9)), (3, 9));
    assert_eq!((Slot::from(Some(0)), Slot::from(None)), (Slot::of(0), Slot::EMPTY));
    assert_eq!([Slot::EMPTY, Slot::of(1), Slot::of(2)].map(|slot| slot.is_below(2)), [true, true, false]);
}

fn states() -> impl Strategy<Value = State> {
    let phase = prop_oneof![Just(Phase::Idle), Just(Phase::Move), Just(Phase::Wait)];
    let query =
        prop_oneof![Just(Query::Closed(Blank::Zero)), any::<u64>().prop_map(|since| Query::Open { since })];
    let part = prop::option::of(0_usize..usize::MAX);
    (phase, query, any::<bool>(), part, any::<[f64; 3]>(), 0.0..f64::MAX).prop_map(
        |(phase, query, held, part, angles, elapsed)| State {
            phase,
            query,
            held: held.into(),
            part: part.into(),
            angles,
            elapsed,
        },
    )
}

proptest! {
    #[test]
    fn what_is_stored_is_loaded(state in states()) {
        prop_assert_eq!(State::load(&stored(&state)), Ok(state));
    }

    #[test]
    fn whatever_the_words_are_loading_never_panics(bits in any::<[u64; WORDS]>(), own_mark in any::<bool>()) {
        let mut words = bits.map(f64::from_bits);
        if own_mark {
            words[0] = stored(&example())[0];
        }
        if let Ok(state) = State::load(&words) {
            prop_assert!(state.check().is_ok());
        }
    }

    #[test]
    fn one_damaged_word_is_refused_or_loaded_as_it_is(word in 0..WORDS, bits in any::<u64>()) {
        let mut words = stored(&example());
        words[word] = f64::from_bits(bits);
        if let Ok(state) = State::load(&words) {
            prop_assert_eq!(stored(&state)[..10].to_vec(), words[..10].to_vec());
        }
    }
}
