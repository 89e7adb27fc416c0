//! The judge takes in every message of a topic's writer, whatever is lost on the way, and none that is sent again, comes from
//! another one, or from another time.
#![allow(clippy::unwrap_used)]

use coact_messages::{Header, LAYOUT, Refusal, topic};
use coact_period::PERIOD_NS;
use coact_realtime::{Judge, Origin, Place, Verdict};
use proptest::prelude::*;

/// The process of each generation of the writer has this number and its generation's.
const WRITER: u32 = 1000;

fn origin(generation: u32) -> Origin {
    Origin { publisher: u128::from(WRITER + generation), pid: WRITER + generation }
}

/// What the run knows: the process of each generation that it has started.
fn place_of(newest: u32) -> impl Fn(u32, Origin) -> Option<Place> {
    move |generation, origin| {
        (generation <= newest && origin.pid == WRITER + generation).then_some(Place::Stage)
    }
}

fn time(tick: u64) -> (u64, u64) {
    (tick, tick * PERIOD_NS + PERIOD_NS)
}

fn header(generation: u32, sequence: u64, cycle: u64) -> Header {
    let stamp = cycle * PERIOD_NS;
    let (sensor_ns, published_ns) = (stamp, stamp);
    Header { layout: LAYOUT, generation, sequence, cycle, sensor_ns, published_ns, reserved: 0 }
}

/// Messages of a writer that is killed now and then, of which some are lost: generation, sequence, cycle.
fn sent() -> impl Strategy<Value = Vec<Header>> {
    // Whether the writer was replaced before the message, whether it then found no checkpoint, cycles skipped, messages lost.
    let step = (prop::bool::weighted(0.1), any::<bool>(), 1..5_u64, 0..3_u64);
    prop::collection::vec(step, 1..100).prop_map(|steps| {
        let (mut generation, mut sequence, mut cycle) = (0, 0, 0);
        let next = |(replaced, fresh, skipped, lost): (bool, bool, u64, u64)| {
            generation += u32::from(replaced);
            sequence = if replaced && fresh { 0 } else { sequence + 1 + lost };
            cycle += skipped;
            header(generation, sequence, cycle)
        };
        steps.into_iter().map(next).collect()
    })
}

fn taken_in(
    judge: &mut Judge,
    header: &Header,
    from: Origin,
    tick: u64,
    newest: u32,
) -> Result<Verdict, Refusal> {
    judge.judge(header, from, time(tick), place_of(newest)).inspect(|_| judge.accept(header, from))
}

proptest! {
    #[test]
    fn every_message_of_the_writer_is_taken_in_whatever_is_lost_between(sent in sent(), late in 0..3_u64) {
        let mut judge = Judge::of(topic::PERCEPT);
        for header in &sent {
            let generation = header.generation;
            let verdict = taken_in(&mut judge, header, origin(generation), header.cycle + late, generation);
            prop_assert_eq!(verdict, Ok(Verdict::Next), "{:?}", header);
        }
    }

    #[test]
    fn no_message_is_taken_in_twice_nor_after_a_later_one(sent in sent(), again in any::<prop::sample::Index>()) {
        let mut judge = Judge::of(topic::PERCEPT);
        let last = *sent.last().unwrap();
        for header in &sent {
            taken_in(&mut judge, header, origin(header.generation), header.cycle, header.generation).unwrap();
        }
        let replayed = sent[again.index(sent.len())];
        let verdict = taken_in(&mut judge, &replayed, origin(replayed.generation), last.cycle, last.generation);
        prop_assert!(matches!(verdict, Err(Refusal::Repeated | Refusal::Generation)), "{:?}", verdict);
    }

    #[test]
    fn nothing_of_another_process_is_taken_in_whatever_it_says(
        sent in sent(), generation: u32, sequence: u64, cycle: u64, stamp: u64, layout: u32,
    ) {
        let mut judge = Judge::of(topic::PERCEPT);
        let stranger = Origin { publisher: 7, pid: 7 };
        for good in &sent {
            let tick = time(good.cycle);
            let forged = Header {
                layout, generation, sequence, cycle, sensor_ns: stamp, published_ns: stamp, reserved: 0,
            };
            // What is most like a good message: the next one, of this generation or the one after it.
            let next = Header { sequence: good.sequence + 1, ..*good };
            let usurper = Header { generation: good.generation + 1, ..next };
            for foreign in [forged, next, usurper] {
                prop_assert!(judge.judge(&foreign, stranger, tick, place_of(good.generation)).is_err());
            }
            prop_assert_eq!(taken_in(&mut judge, good, origin(good.generation), good.cycle, good.generation), Ok(Verdict::Next));
        }
    }

    #[test]
    fn nothing_of_another_time_or_layout_is_taken_in(tick in 10_000..1_000_000_u64, off in 1..5_000_u64) {
        let mut judge = Judge::of(topic::PERCEPT);
        let mut judged = |header: Header| judge.judge(&header, origin(0), time(tick), place_of(0));
        let good = header(0, 5, tick);
        prop_assert_eq!(judged(header(0, 5, tick + 1 + off)), Err(Refusal::Future));
        prop_assert_eq!(judged(header(0, 5, tick - 5_000 - off)), Err(Refusal::Stale));
        let sent_later = Header { published_ns: good.published_ns + (2 + off) * PERIOD_NS, ..good };
        prop_assert_eq!(judged(sent_later), Err(Refusal::Future));
        let sensed_later = Header { sensor_ns: good.published_ns + off, ..good };
        prop_assert_eq!(judged(sensed_later), Err(Refusal::Future));
        prop_assert_eq!(judged(Header { layout: LAYOUT ^ off as u32, ..good }), Err(Refusal::Layout));
        prop_assert_eq!(judged(good), Ok(Verdict::Next));
    }
}

#[test]
fn the_run_is_asked_once_about_each_stranger() {
    let mut judge = Judge::of(topic::COMMAND);
    let mut asked = 0;
    for sequence in 0..100 {
        let foreign = header(3, sequence, 1);
        let verdict = judge.judge(&foreign, Origin { publisher: 9, pid: 9 }, time(1), |_, _| {
            asked += 1;
            None
        });
        assert_eq!(verdict, Err(Refusal::Writer));
    }
    assert_eq!(asked, 1);
}

#[test]
fn anybody_may_speak_to_the_robot() {
    let mut judge = Judge::of(topic::HEARD);
    for person in 1..5 {
        let speaker = Origin { publisher: u128::from(person), pid: person };
        assert_eq!(taken_in(&mut judge, &header(0, 0, 0), speaker, 100_000, 0), Ok(Verdict::Next));
    }
}

/// A stage and its standby, as the run knows them: their processes have these numbers.
const STANDBY: u32 = 2000;

fn pair(generation: u32, origin: Origin) -> Option<Place> {
    match origin.pid.wrapping_sub(generation) {
        WRITER => Some(Place::Stage),
        STANDBY => Some(Place::Standby),
        _ => None,
    }
}

#[test]
fn of_stage_and_standby_the_first_message_of_each_cycle_is_taken_in() {
    let standby =
        |generation: u32| Origin { publisher: u128::from(STANDBY + generation), pid: STANDBY + generation };
    let mut judge = Judge::of(topic::COMMAND);
    let mut judged = |header: Header, from: Origin| {
        let verdict = judge.judge(&header, from, time(header.cycle.max(10)), pair);
        if verdict == Ok(Verdict::Next) {
            judge.accept(&header, from);
        }
        verdict
    };
    assert_eq!(judged(header(0, 1, 1), origin(0)), Ok(Verdict::Next));
    assert_eq!(judged(header(0, 1, 1), standby(0)), Ok(Verdict::SentAlready));
    // The stage is silent, the standby goes on; then comes what the stage was late with, and it goes on as well.
    assert_eq!(judged(header(0, 2, 2), standby(0)), Ok(Verdict::Next));
    assert_eq!(judged(header(0, 3, 3), standby(0)), Ok(Verdict::Next));
    assert_eq!(judged(header(0, 2, 2), origin(0)), Ok(Verdict::SentAlready));
    assert_eq!(judged(header(0, 4, 4), origin(0)), Ok(Verdict::Next));
    // Replacements of both are known by their own generations, and what went before is not taken in any more.
    assert_eq!(judged(header(1, 5, 5), standby(1)), Ok(Verdict::Next));
    assert_eq!(judged(header(3, 6, 6), origin(3)), Ok(Verdict::Next));
    assert_eq!(judged(header(0, 7, 7), standby(0)), Err(Refusal::Generation));
    assert_eq!(judged(header(0, 7, 7), origin(0)), Err(Refusal::Generation));
    assert_eq!(judged(header(1, 7, 7), standby(1)), Ok(Verdict::Next));
    assert_eq!(judged(header(1, 7, 7), standby(1)), Err(Refusal::Repeated));
    assert_eq!(judged(header(3, 8, 8), Origin { publisher: 5, pid: 5 }), Err(Refusal::Writer));
}
