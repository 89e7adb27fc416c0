//! A hand that carries, gives or withdraws as a recorded one did.

use crate::reach_profile::minimum_jerk;
use crate::recorded_way::RecordedWay;
use crate::{HandMovement, HandPose, Person, PersonState};
use coact_messages::ArmSide;
use coact_period::CYCLES_PER_SECOND;
use coact_random::Stream;
use coact_recordings::WayKind;
use coact_stage_state::Slot;
use glam::DVec3;
use rand::RngExt;

/// Shortest distance along which a recorded way leads, m: below it there is no direction to speak of.
const SHORTEST: f64 = 0.02;
/// No wrist goes faster along a way, m/s: what was extracted is no faster.
const FASTEST: f64 = 1.5;
/// At so many places of a way its speed is looked at: two for each interval of its points.
const LOOKS: u64 = 64;
/// How gradually a way goes over into the arch of a straight movement, in units of the arch's own height: at the crossing the hand
/// is a tenth of that higher than both.
const EASE: f64 = 0.2;
/// A line that is steeper has its sideways direction from where the person faces; sine.
const STEEP: f64 = 0.97;

impl Person {
    /// Has the present movement follow one of the recorded ways of this kind, if the person has any, for as long as that takes.
    pub(crate) fn choose_way(&self, kind: WayKind, state: &mut PersonState) {
        state.way = Slot::EMPTY;
        let Some(ways) = &self.ways else { return };
        let movement = state.movement;
        let distance = movement.from.wrist().distance(movement.to.wrist());
        let turn = self.random.at(Stream::Way, movement.start).random_range(0..ways.count_of(kind).max(1));
        let Some(index) = ways.nth_of(kind, turn).filter(|_| distance >= SHORTEST) else { return };
        let way = &ways.ways[index];
        let time = ways.duration(way, distance).max(self.shortest_time(way, state.side, &movement));
        state.way = Slot::of(index);
        state.movement.end = movement.start + (time * CYCLES_PER_SECOND as f64).ceil() as u64;
    }

    /// The hand at `tick` on its present movement, which is no reach, and the fraction of the distance that it has covered.
    pub(crate) fn moving_pose(&self, state: &PersonState, tick: u64) -> (HandPose, f64) {
        let movement = &state.movement;
        let time = movement.time(tick as f64);
        let way = state.way.get().and_then(|index| self.ways.as_ref()?.ways.get(index));
        match way {
            None => (movement.pose(tick), minimum_jerk(time)),
            Some(_) if movement.is_over(tick) => (movement.to, 1.0),
            Some(way) => {
                let (wrist, covered) = self.wrist_on(way, state.side, movement, time);
                let pose = movement.from.towards(&movement.to, minimum_jerk(time));
                (HandPose { wrist: wrist.into(), ..pose }, covered)
            }
        }
    }

    /// Where the wrist is at fraction `time` of a movement along `way`, and the fraction of the distance that it has covered.
    ///
    /// The way is turned into the line from start to end, scaled to it, and mirrored for the left hand. It never leads lower than a straight movement that
    /// has covered as much would with its arch: recorded hands passed over nothing, this one passes over parts that lie.
    fn wrist_on(&self, way: &RecordedWay, side: ArmSide, movement: &HandMovement, time: f64) -> (DVec3, f64) {
        let (from, to) = (movement.from.wrist(), movement.to.wrist());
        let line = to - from;
        let (along, point) = (line.normalize_or(DVec3::X), way.at(time));
        let arm = &self.arms[side as usize];
        let upright = if along.z.abs() < STEEP { DVec3::Z } else { arm.ahead() };
        let up = upright.reject_from_normalized(along).normalize_or(DVec3::Z);
        let aside = arm.mirror() * point.y;
        let mut wrist = from + point.x * line + line.length() * (aside * along.cross(up) + point.z * up);
        let covered = point.x.clamp(0.0, 1.0);
        let within = 4.0 * covered * (1.0 - covered);
        let arched = from.z + covered * line.z + movement.arch * within * within;
        wrist.z = higher(wrist.z, arched, EASE * movement.arch * within);
        (wrist, covered)
    }

    /// The time that keeps a movement along `way` from being faster than a hand is, s.
    fn shortest_time(&self, way: &RecordedWay, side: ArmSide, movement: &HandMovement) -> f64 {
        let wrist = |look: u64| self.wrist_on(way, side, movement, look as f64 / LOOKS as f64).0;
        let farthest = (0..LOOKS).map(|look| wrist(look).distance(wrist(look + 1))).fold(0.0, f64::max);
        farthest * LOOKS as f64 / FASTEST
    }
}

/// The higher of two heights; where they are about `ease` apart, somewhat higher than both, so that there is no kink.
fn higher(one: f64, other: f64, ease: f64) -> f64 {
    0.5 * (one + other + (one - other).hypot(ease))
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use crate::{ActivityPhase, Habits, Policy, RecordedWays};
    use bytemuck::Zeroable;
    use coact_joint_task::Task;
    use coact_period::PERIOD_S;
    use coact_random::RandomStreams;
    use proptest::prelude::*;
    use std::path::{Path, PathBuf};
    use std::sync::LazyLock;

    fn root() -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
    }

    static WAYS: LazyLock<RecordedWays> =
        LazyLock::new(|| RecordedWays::load(&root().join("data/carries/carries.csv")).unwrap());
    static TASK: LazyLock<Task> =
        LazyLock::new(|| Task::load(&root().join("rt-config/tasks/toy-vehicle.toml")).unwrap());

    fn person(seed: u64) -> Person {
        let habits = Habits::load(&root().join("rt-config/person.toml"), &TASK).unwrap();
        Person::new(&TASK.scene, &habits, Policy::Synthetic, RandomStreams::new(seed), None)
            .with_ways(Some(WAYS.clone()))
    }

    /// A person whose hand has just begun to move from one place to another.
    fn moving(seed: u64, from: DVec3, to: DVec3, arch: f64, kind: WayKind) -> (Person, PersonState) {
        let (person, mut state) = (person(seed), PersonState::zeroed());
        let rest = person.arm(&state).rest();
        let pose = |wrist: DVec3| HandPose { wrist: wrist.into(), ..rest };
        let start = 1000 + seed % 1000;
        let end = start + 700;
        let (peak_aperture, peak_time) = (0.0, 0.0);
        let (from, to) = (pose(from), pose(to));
        state.movement = HandMovement { from, to, start, onset: start, end, arch, peak_aperture, peak_time };
        person.choose_way(kind, &mut state);
        state.enter(ActivityPhase::Carry, state.movement.end);
        (person, state)
    }

    fn place() -> impl Strategy<Value = DVec3> {
        (-0.5..0.5, -0.5..0.5, 0.7..1.1).prop_map(|(x, y, z)| DVec3::new(x, y, z))
    }

    fn kind() -> impl Strategy<Value = WayKind> {
        (0..WayKind::ALL.len()).prop_map(|kind| WayKind::ALL[kind])
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        #[test]
        fn hand_goes_from_exactly_its_start_to_exactly_its_end_and_never_too_fast(
            (seed, from, to) in (any::<u64>(), place(), place()),
            (arch, kind) in (0.03..0.06, kind()),
        ) {
            let (person, state) = moving(seed, from, to, arch, kind);
            let movement = state.movement;
            let wrist = |tick| person.moving_pose(&state, tick).0.wrist();
            prop_assert!(wrist(movement.start).distance(from) < 1e-12);
            prop_assert_eq!(person.moving_pose(&state, movement.end), (movement.to, 1.0));
            let shortest = (from.distance(to) / FASTEST * CYCLES_PER_SECOND as f64) as u64;
            prop_assert!((shortest..6000).contains(&(movement.end - movement.start)), "{:?}", movement);
            let mut last = [from, from];
            for tick in movement.start..=movement.end + 1 {
                let (pose, covered) = person.moving_pose(&state, tick);
                let now = pose.wrist();
                prop_assert!(now.is_finite() && (0.0..=1.0).contains(&covered));
                let straight = movement.from.wrist[2] + covered * (to.z - from.z);
                prop_assert!(now.z >= straight - 1e-9, "it dips {} m", straight - now.z);
                let velocity = (now - last[1]) / PERIOD_S;
                prop_assert!(velocity.length() < 1.1 * FASTEST, "{} m/s", velocity.length());
                let change = velocity - (last[1] - last[0]) / PERIOD_S;
                prop_assert!(change.length() < 0.05, "a kick of {} m/s", change.length());
                last = [last[1], now];
            }
        }
    }

    #[test]
    fn ways_differ_from_movement_to_movement_and_are_the_same_for_the_same_seed() {
        let (from, to) = (DVec3::new(0.0, 0.3, 0.8), DVec3::new(0.3, 0.1, 0.8));
        let ways = |kind| (0..40).map(|seed| moving(seed, from, to, 0.06, kind).1.way).collect::<Vec<_>>();
        for kind in WayKind::ALL {
            let own = ways(kind);
            assert_eq!(own, ways(kind));
            assert!(own.iter().all(|way| WAYS.ways[way.get().unwrap()].kind == kind));
            assert!(own.iter().any(|way| *way != own[0]), "{own:?}");
        }
    }

    #[test]
    fn a_hand_that_is_there_already_does_not_look_for_a_way() {
        let at = DVec3::new(0.0, 0.3, 0.8);
        let (_, state) = moving(1, at, at + 0.01 * DVec3::X, 0.06, WayKind::Carry);
        assert_eq!((state.way, state.movement.end - state.movement.start), (Slot::EMPTY, 700));
    }

    #[test]
    fn a_file_that_lacks_a_kind_is_refused_with_what_is_missing() {
        let text = std::fs::read_to_string(root().join("data/carries/carries.csv")).unwrap();
        let without: Vec<&str> = text.lines().filter(|line| !line.starts_with("give,")).collect();
        let folder = tempfile::tempdir().unwrap();
        let file = folder.path().join("carries.csv");
        std::fs::write(&file, without.join("\n")).unwrap();
        let error = RecordedWays::load(&file).unwrap_err().to_string();
        assert!(error.contains("carries.csv: holds no way of the kind give"), "{error}");
    }
}
