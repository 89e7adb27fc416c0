use super::fake_robot::FakeRobot;
use super::{Out, robot, task};
use crate::{Partner, Settings, World};
use coact_joint_task::Agent;
use coact_messages::{KeypointName, PartnerPhase};
use coact_person::{ActivityPhase, RandomBehaviour, RecordedReaches, RecordedWays};
use coact_pipeline::{Movement, RunSettings, WorldMode};
use glam::DVec3;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

/// A made-up recording of two people: the wrist goes 60 px to the right in 0.6 s, the thumb opens with the size.
fn folder(spoil: impl Fn(&mut String)) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for person in 1..=2 {
        let mut text = String::from("participant,size,trial,t_rel_onset_s,mt_s,rtg");
        for joint in coact_recordings::JOINTS {
            write!(text, ",{joint}.x,{joint}.y,{joint}.p").unwrap();
        }
        for (size, width) in [("S", 5.0), ("M", 10.0), ("L", 14.0)] {
            for frame in -30..60 {
                let time = f64::from(frame) / 60.0;
                let x = 100.0 + 60.0 * (time / 0.6).clamp(0.0, 1.0);
                write!(text, "\n{person},{size},1,{time},0.6,0").unwrap();
                let hand: [(f64, f64); 9] = [
                    (-60.0, 0.0),
                    (-32.0, 0.0),
                    (0.0, 0.0),
                    (3.0, 3.0),
                    (18.0, width),
                    (12.0, 4.0),
                    (18.0, 0.0),
                    (20.0, -2.0),
                    (10.0, -5.0),
                ];
                for (joint, (dx, dy)) in hand.iter().enumerate() {
                    let confidence = if joint == 7 && frame % 5 == 0 { 0.0 } else { 0.8 };
                    write!(text, ",{},{},{confidence}", x + dx, 50.0 + dy).unwrap();
                }
            }
        }
        text.push('\n');
        spoil(&mut text);
        std::fs::write(folder.path().join(format!("p{person}.csv")), text).unwrap();
    }
    folder
}

fn load(folder: &Path) -> Result<Partner, crate::WorldError> {
    Partner::load(&format!("recorded:{}", folder.display()), &task(), 1)
}

#[test]
fn broken_recordings_are_refused_with_file_and_line() {
    let spoils: [fn(&mut String); 3] = [
        |text| *text = text.replacen("0.8", "NaN", 1),
        |text| *text = text.replace("RWrist.x", "RWrist.z"),
        |text| text.push_str("1,S,1,0.1\n"),
    ];
    for spoil in spoils {
        let folder = folder(spoil);
        let message = load(folder.path()).unwrap_err().to_string();
        assert!(message.contains(".csv"), "{message}");
    }
    assert!(load(Path::new("no/such/folder")).unwrap_err().to_string().contains("no/such/folder"));
    let empty = tempfile::tempdir().unwrap();
    assert!(load(empty.path()).is_err());
}

/// Runs two minutes; gives movement times, and mean fraction of lost middle-finger tips while reaching.
fn run(partner: Partner, reaches: Option<RecordedReaches>) -> (Vec<u64>, f64, u64) {
    let settings = Settings { reaches, ..super::settings(2, partner, WorldMode::Kinematic) };
    let (mut world, mut robot) = (World::new(&task(), &robot(), settings).unwrap(), FakeRobot::new());
    let mut out = Out::new();
    let (mut times, mut lost, mut frames) = (Vec::new(), 0.0, 0.0);
    for tick in 1..=200_000 {
        let before = *out.truth;
        let frame = out.sample.hands[0].frame;
        robot.step(tick, &mut world, &mut out);
        assert!(tick == 1 || most_gone(&before.arms, &out.truth.arms) < 0.005, "an arm leaps at {tick}");
        let grasped = out.truth.grasp_cycle != before.grasp_cycle && out.truth.grasp_cycle > 0;
        if grasped && let Some(part) = world.simulation.person.held.get() {
            times.push(out.truth.grasp_cycle - out.truth.onset_cycle);
            let missed = world
                .parts
                .view()
                .centre(part, &world.task)
                .distance(world.person.hand_centre(&world.simulation.person));
            assert!(missed < 0.001, "fingers closed {missed} m beside the part");
        }
        if out.truth.phase == PartnerPhase::Reach as u32 && out.sample.hands[0].frame != frame {
            frames += 1.0;
            lost +=
                f64::from(out.sample.hands[0].keypoints[KeypointName::MiddleTip as usize].confidence == 0.0);
        }
    }
    (times, lost / frames, out.truth.assemblies)
}

/// How far a joint of the arms has gone that has gone farthest, m.
fn most_gone(before: &[[[f64; 3]; 4]; 2], now: &[[[f64; 3]; 4]; 2]) -> f64 {
    let joints = before.as_flattened().iter().zip(now.as_flattened());
    joints.map(|(before, now)| DVec3::from(*before).distance((*now).into())).fold(0.0, f64::max)
}

#[test]
fn recorded_hand_keeps_its_time_course_and_its_drop_outs_and_the_team_still_finishes() {
    let folder = folder(|_| ());
    let (times, lost, assemblies) = run(load(folder.path()).unwrap(), None);
    assert!(assemblies >= 1);
    assert!(times.len() > 10 && times.iter().all(|time| *time == 600), "{times:?}");
    assert!((0.12..0.28).contains(&lost), "{lost} of the middle finger's tips lost, 0.2 in the recording");
}

#[test]
fn real_recordings_drive_the_partner() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/reaches");
    let (times, _, assemblies) = run(load(&folder).unwrap(), None);
    assert!(assemblies >= 1);
    assert!(times.iter().all(|time| (340..=900).contains(time)), "{times:?}");
}

#[test]
fn a_partner_who_errs_reaches_as_the_participant_did() {
    let folder = folder(|_| ());
    let reaches = RecordedReaches::load_participant(folder.path(), 2).unwrap();
    let behaviour = RandomBehaviour::parse("goal=0.3,hidden=0,dropouts=0").unwrap();
    let (times, ..) = run(Partner::Random(behaviour), Some(reaches));
    assert!(times.len() > 10 && times.iter().all(|time| *time == 600), "{times:?}");
    let nobody = RecordedReaches::load_participant(folder.path(), 3).unwrap_err().to_string();
    assert!(nobody.contains("participant 3"), "{nobody}");
}

/// A partner whose hand moves as that of a recorded participant, and who changes the mind in this fraction of reaches.
fn who_changes(fraction: u8, seed: u64) -> World {
    who(&format!("changes={fraction}"), seed)
}

/// One who behaves like this besides.
fn who(behaves: &str, seed: u64) -> World {
    let reaches = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/reaches");
    let reaches = RecordedReaches::load_participant(&reaches, 3).unwrap();
    let behaviour = format!("goal=0,hidden=0,words=0,dropouts=0,{behaves}");
    let partner = Partner::Random(RandomBehaviour::parse(&behaviour).unwrap());
    let settings =
        Settings { reaches: Some(reaches), ..super::settings(seed, partner, WorldMode::Kinematic) };
    World::new(&task(), &robot(), settings).unwrap()
}

#[test]
fn recorded_reach_goes_on_unmodified_beneath_the_turn() {
    for seed in 0..3 {
        let mut worlds = [who_changes(1, seed), who_changes(0, seed)];
        let (mut robots, mut outs) = ([FakeRobot::new(), FakeRobot::new()], [Out::new(), Out::new()]);
        let mut added = DVec3::ZERO;
        for tick in 1..=60_000 {
            for ((world, robot), out) in worlds.iter_mut().zip(&mut robots).zip(&mut outs) {
                robot.step(tick, world, out);
            }
            let [turning, straight] = worlds.each_ref().map(|world| &world.simulation.person);
            let before = std::mem::replace(&mut added, turning.hand.wrist() - straight.hand.wrist());
            let since = tick.saturating_sub(turning.turn.begun);
            match turning.turn.begun {
                0 => assert_eq!(added, DVec3::ZERO),
                // A movement of minimum jerk that takes 0.4 s or longer has covered a thousandth of its way after 20 ms.
                _ if since <= 20 => assert!(added.length() < 1e-3, "seed {seed}, {since} ms: {added}"),
                _ if straight.phase() == ActivityPhase::Reach => {
                    assert!(added.distance(before) < 2.5e-3, "seed {seed}, {since} ms: {added}");
                }
                _ => break,
            }
        }
        assert!(added.length() > 0.01, "seed {seed}: {added}");
    }
}

#[test]
fn recorded_hand_that_turned_has_the_new_part_in_its_fingers() {
    let (mut world, mut robot) = (who_changes(1, 2), FakeRobot::new());
    let (mut out, mut turned) = (Out::new(), 0);
    for tick in 1..=100_000 {
        robot.step(tick, &mut world, &mut out);
        let person = &world.simulation.person;
        if person.turn.begun == 0 || person.grasped != tick {
            continue;
        }
        turned += 1;
        let centre = world.parts.view().centre(person.part.get().unwrap(), &world.task);
        let missed = centre.distance(world.person.hand_centre(person));
        assert!(missed < 0.001, "fingers closed {missed} m beside the part");
        let shown = world.person.recorded_keypoints(person, tick).unwrap();
        let tips = [KeypointName::ThumbTip, KeypointName::IndexTip].map(|name| shown[name as usize]);
        let middle = DVec3::from(tips[0].position).midpoint(tips[1].position.into());
        let seen = tips.iter().all(|tip| tip.confidence > 0.0);
        assert!(!seen || middle.distance(centre) < 0.02, "{} m", middle.distance(centre));
    }
    assert!(turned >= 5, "{turned} reaches turned");
}

#[test]
fn recorded_hand_stands_still_and_goes_on_as_it_would_have() {
    let mut worlds = [who("hesitates=1", 1), who("hesitates=0", 1)];
    let (mut robots, mut outs) = ([FakeRobot::new(), FakeRobot::new()], [Out::new(), Out::new()]);
    let (mut hands, mut shown, mut delay) = (Vec::new(), Vec::new(), 0);
    let seen = |world: &World, tick| {
        let shown = world.person.recorded_keypoints(&world.simulation.person, tick);
        shown.map(|points| points.map(|point| point.position))
    };
    for tick in 0..30_000 {
        for ((world, robot), out) in worlds.iter_mut().zip(&mut robots).zip(&mut outs) {
            robot.step(tick + 1, world, out);
        }
        let [hesitant, straight] = worlds.each_ref().map(|world| &world.simulation.person);
        hands.push(straight.hand);
        shown.push(seen(&worlds[1], tick + 1));
        if hesitant.hesitation.begun == tick + 1 {
            delay = hesitant.movement.start - straight.movement.start;
        }
        if hesitant.grasped > 0 && delay > 0 {
            break;
        }
        let goes_on = tick > hesitant.hesitation.begun + delay + 150;
        if hesitant.hesitation.begun == 0 || goes_on {
            let before = (tick - delay) as usize;
            assert_eq!(hesitant.hand, hands[before], "tick {tick}");
            assert_eq!(seen(&worlds[0], tick + 1), shown[before]);
        }
    }
    assert!(delay >= 450, "{delay}");
}

/// A folder of the checkout.
fn shipped(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(folder)
}

#[test]
fn parts_that_are_carried_along_recorded_ways_are_mounted_where_they_belong() {
    let ways = Some(RecordedWays::load(&shipped("data/carries/carries.csv")).unwrap());
    let settings = super::settings(3, Partner::Synthetic, WorldMode::Kinematic);
    let mut world = World::new(&task(), &robot(), Settings { ways, ..settings }).unwrap();
    let (mut robot, mut out) = (FakeRobot::new(), Out::new());
    let (mut mounted, mut highest, mut before) = (0, 0.0_f64, DVec3::ZERO);
    for tick in 1..=120_000 {
        robot.step(tick, &mut world, &mut out);
        let person = &world.simulation.person;
        let now = person.hand.wrist();
        // A recorded reach's wrist may jump, a way's may not.
        let carries = matches!(person.phase(), ActivityPhase::Carry | ActivityPhase::Withdraw);
        if carries && tick > person.movement.start + 1 {
            highest = highest.max(now.distance(before));
        }
        before = now;
        if person.phase() == ActivityPhase::Mount && person.until == tick + 1 {
            let (part, goal) = (person.held.get().unwrap(), person.subgoal.get().unwrap());
            let at = world.parts.view().position(part);
            let socket = DVec3::from(world.task.subgoals[goal].socket);
            assert!(at.distance(socket) < 1e-6, "{} m beside the socket", at.distance(socket));
            assert_eq!(world.task.subgoals[goal].side, Agent::Person);
            mounted += 1;
        }
        if out.truth.assemblies >= 1 {
            break;
        }
    }
    assert!(out.truth.assemblies >= 1 && mounted >= 2, "{mounted} parts mounted");
    assert!(highest < 1.65e-3, "{highest} m within a millisecond");
}

#[test]
fn a_run_with_recorded_reaches_needs_the_ways_and_one_without_does_not() {
    let absent: PathBuf = "no/such/carries.csv".into();
    let run = RunSettings { carries: absent, ..RunSettings::shipped(&shipped("rt-config")) };
    let drive = super::safety().drive;
    let refused = |run: &RunSettings| Settings::of_run(run, &task(), drive).unwrap_err().to_string();
    assert!(Settings::of_run(&run, &task(), drive).unwrap().ways.is_none());
    let folder = shipped("data/reaches");
    let partner = format!("recorded:{}", folder.display());
    assert!(refused(&RunSettings { partner, ..run.clone() }).contains("no/such/carries.csv: "));
    let recorded = RunSettings { movement: Movement::Recorded { folder, participant: 3 }, ..run };
    assert!(refused(&recorded).contains("no/such/carries.csv: "));
    let shipped = RunSettings { carries: shipped("data/carries/carries.csv"), ..recorded };
    assert!(Settings::of_run(&shipped, &task(), drive).unwrap().ways.is_some());
}
