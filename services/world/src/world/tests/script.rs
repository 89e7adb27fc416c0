use super::{Out, config, robot, task};
use crate::{Partner, Scenario, World};
use coact_messages::{KeypointName, PartnerPhase};
use coact_period::CYCLES_PER_SECOND;
use coact_pipeline::WorldMode;
use std::io::Write;

fn refusal(text: &str) -> String {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    file.write_all(text.as_bytes()).unwrap();
    let message = Scenario::load(file.path(), &task()).unwrap_err().to_string();
    message.replace(&file.path().display().to_string(), "FILE")
}

#[test]
fn mistakes_are_named_with_line_key_and_what_was_expected() {
    let good = "[[action]]\nidle = 1\n\n";
    let cases = [
        (
            "[[action]]\nchain = \"insrt\"\nkind = \"wheel\"\n",
            "FILE:5: key \"chain\": \"insrt\" is unknown",
            "\"insert\"",
        ),
        (
            "[[action]]\nchain = \"insert\"\nkind = \"whel\"\n",
            "FILE:6: key \"kind\": \"whel\" is unknown",
            "\"wheel\"",
        ),
        ("[[action]]\nchain = \"insert\"\n", "FILE:5: key \"kind\" is missing", "chain"),
        ("[[action]]\nidle = -1\n", "FILE:5: key \"idle\": -1 is out of range", "0 to 86400"),
        ("[[action]]\nidle = nan\n", "FILE:5: key \"idle\"", "0 to 86400"),
        ("[[action]]\nat = 1\nafter = 2\nidle = 1\n", "FILE:5: keys \"at\" and \"after\"", "only one"),
        ("[[action]]\nat = 1\n", "FILE:4: expected either \"idle\", or \"chain\"", "kind"),
        ("[[action]]\nidel = 1\n", "FILE:5: ", "idel"),
        ("[[action]]\nidle = \"x\"\n", "FILE:5: ", "[[action]]"),
        ("[[action]\n", "FILE:4: ", "[[action]]"),
    ];
    for (bad, begins, names) in cases {
        let message = refusal(&format!("{good}{bad}"));
        assert!(message.starts_with(begins) && message.contains(names), "{bad}\n-> {message}");
    }
    assert!(
        Scenario::load(std::path::Path::new("no/such.toml"), &task())
            .unwrap_err()
            .to_string()
            .contains("such.toml")
    );
}

#[test]
fn unknown_partner_is_refused_with_the_known_ones() {
    let message = Partner::load("scripted:x", &task(), 0).unwrap_err().to_string();
    assert!(message.contains("scripted:x") && message.contains("script:FILE"), "{message}");
}

/// Chain names, onset and grasp ticks of the first actions of a script.
fn actions(partner: Partner, seconds: u64) -> Vec<(String, u64, u64)> {
    let settings = super::settings(1, partner, WorldMode::Kinematic);
    let (mut world, mut out) = (World::new(&task(), &robot(), settings).unwrap(), Out::new());
    let mut begun = Vec::new();
    for tick in 1..=seconds * CYCLES_PER_SECOND {
        let before = *out.truth;
        world.step(tick, None, &mut out.sample, &mut out.truth, &mut out.state);
        if out.truth.actions != before.actions {
            let chain = &world.task.chains[out.truth.chain as usize];
            begun.push((chain.name.clone(), out.truth.onset_cycle, 0));
        }
        if out.truth.phase == PartnerPhase::Act as u32 {
            begun.last_mut().unwrap().2 = out.truth.grasp_cycle;
        }
    }
    begun
}

#[test]
fn proactive_scenario_is_idle_insert_idle_hand_over() {
    let scenario = format!("script:{}", config("scenarios/proactive.toml").display());
    let begun = actions(Partner::load(&scenario, &task(), 0).unwrap(), 40);
    let names: Vec<_> = begun.iter().map(|action| action.0.as_str()).collect();
    assert_eq!(names, ["insert", "hand over"]);
    assert!((6000..6400).contains(&begun[0].1), "first onset at {}", begun[0].1);
    assert!(begun[1].1 > begun[0].2 + 6000, "{begun:?}");
    assert!(begun.iter().all(|action| action.2 > action.1), "{begun:?}");
}

pub(super) fn scenario(file: &str) -> World {
    let task = coact_joint_task::Task::load(&config("tasks/toy-vehicle.toml")).unwrap();
    let name = format!("script:{}", config("scenarios").join(file).display());
    let partner = Partner::load(&name, &task, 0).unwrap();
    World::new(&task, &robot(), super::settings(1, partner, WorldMode::Kinematic)).unwrap()
}

/// Runs `seconds`; `look` sees the world and its messages after each tick.
fn run(world: &mut World, seconds: u64, mut look: impl FnMut(u64, &World, &Out)) {
    let mut out = Out::new();
    for tick in 0..seconds * CYCLES_PER_SECOND {
        world.step(tick, None, &mut out.sample, &mut out.truth, &mut out.state);
        look(tick, world, &out);
    }
}

#[test]
fn every_shipped_scenario_loads() {
    for file in std::fs::read_dir(config("scenarios")).unwrap() {
        scenario(file.unwrap().file_name().to_str().unwrap());
    }
}

#[test]
fn mistakes_in_the_scene_are_named() {
    let cases = [
        ("[start]\nachieved = [\"weel\"]\n", "FILE:2: key \"start.achieved\": \"weel\" is unknown"),
        (
            "[start]\nachieved = [\"nut on the robot's side\"]\n",
            "FILE:2: key \"start.achieved\": \"nut on the robot's side\" comes after",
        ),
        (
            "[[start.part]]\nkind = \"wheel\"\nworkspace = \"robot\"\nat = [-0.3, 0.0]\n",
            "FILE:2: key \"start.part.kind\": the task lays no",
        ),
        (
            "[[start.part]]\nkind = \"wheel\"\nworkspace = \"person\"\nat = [3.0, 0.0]\n",
            "FILE:4: key \"start.part.at\": expected a place on the table",
        ),
        (
            "[[start.part]]\nkind = \"wheel\"\nworkspace = \"person\"\nat = [-0.30, -0.3]\n",
            "FILE:4: key \"start.part.at\": 0.000 m from \"nut\"",
        ),
        (
            "[[occluder]]\ncentre = [0, 0, 0]\nsize = [1, 1, 0]\nfrom = 1\n",
            "FILE:3: key \"occluder.size\": expected three extents above 0",
        ),
        ("[[blind]]\nfrom = 2\nuntil = 1\n", "FILE:3: key \"blind.until\": expected a time after"),
        ("[[blind]]\nfrom = 2\nwhat = \"words\"\n", "FILE:3: "),
        ("[[slip]]\nkind = \"nut\"\nafter = 1\nto = [9, 9]\n", "FILE:4: key \"slip.to\": expected a place"),
        ("[[action]]\nsay = \" \"\n", "FILE:2: key \"say\": expected a sentence"),
        ("[[action]]\nidle = 1\nclarity = 1\n", "FILE:3: key \"clarity\": expected beside \"chain\""),
        (
            "[[action]]\nchain = \"insert\"\nkind = \"nut\"\nclarity = 2\n",
            "FILE:4: key \"clarity\": 2 is out of range",
        ),
    ];
    for (bad, begins) in cases {
        let message = refusal(bad);
        assert!(message.starts_with(begins), "{bad}\n-> {message}");
    }
}

#[test]
fn the_scene_begins_as_the_scenario_says() {
    let world = scenario("errors-and-requests.toml");
    assert_eq!(world.parts.achieved(), 0b1111);
    let world = scenario("means-error.toml");
    assert_eq!(world.parts.achieved(), 0b1);
    let nut = world.task.kinds.iter().position(|kind| kind.name == "nut").unwrap();
    for owner in [coact_joint_task::Agent::Robot, coact_joint_task::Agent::Person] {
        assert!(world.parts.view().nearest_free(nut, owner, glam::DVec3::ZERO, &world.task).is_some());
    }
}

#[test]
fn an_occluder_hides_the_part_and_the_hand_that_takes_it_and_nothing_else() {
    let mut world = scenario("occlusion.toml");
    let wheel = 0;
    let wheels = |out: &Out| {
        out.sample.scene.sighting.iter().filter(|seen| seen.kind == wheel && seen.confidence > 0.0).count()
    };
    let (mut before, mut behind, mut frames) = (0, 0, 0);
    let mut mounted = false;
    run(&mut world, 12, |tick, world, out| {
        before = before.max(if tick < 500 { wheels(out) } else { 0 });
        behind = behind.max(if (600..700).contains(&tick) { wheels(out) } else { 0 });
        let grasped = out.truth.grasp_cycle;
        let hidden = grasped > 0 && (grasped..grasped + 60).contains(&tick);
        let shows_the_hand = out.sample.hands[0].keypoints[KeypointName::Wrist as usize..]
            .iter()
            .any(|point| point.confidence > 0.0);
        frames += usize::from(hidden && shows_the_hand && out.sample.hands[0].captured_cycle == tick - 1);
        assert!(
            !(200..=700).contains(&tick) || out.sample.hands[0].captured_cycle + 100 > tick,
            "hand lost at {tick}"
        );
        mounted |= world.parts.achieved() & 1 == 1;
    });
    assert_eq!((before, behind, frames), (2, 1, 0));
    assert!(mounted);
}

#[test]
fn the_person_gives_up_and_puts_the_part_back() {
    let mut world = scenario("errors-and-requests.toml");
    let part =
        world.task.parts.iter().position(|part| world.task.kinds[part.kind].name == "column 4").unwrap();
    let home = world.parts.position(part);
    let (mut farthest, mut actions) = (0.0_f64, 0);
    run(&mut world, 7, |_, world, out| {
        farthest = farthest.max(world.parts.position(part).distance(home));
        actions = out.truth.actions;
    });
    assert!(farthest > 0.1 && world.parts.position(part).distance(home) < 0.02, "{farthest}");
    assert!(world.parts.achieved() & (1 << 6) == 0 && actions >= 1);
}

#[test]
fn blind_trackers_deliver_nothing_and_sentences_arrive() {
    let (mut seen, mut said) = (0, String::new());
    run(&mut scenario("absent.toml"), 5, |_, _, out| seen = seen.max(out.sample.hands[0].captured_cycle));
    assert_eq!(seen, 0);
    run(&mut scenario("words.toml"), 3, |tick, _, out| {
        assert_eq!(out.sample.heard.sentences, u64::from(tick >= 2000));
        said = out.sample.heard.sentence().to_owned();
    });
    assert_eq!(said, "Could you give me the nut, please?");
    let mut world = scenario("absent.toml");
    world.hear("hello");
    run(&mut world, 1, |_, _, out| assert_eq!(out.sample.heard.sentence(), "hello"));
}

#[test]
fn an_action_without_a_part_is_left_out_and_told() {
    let text = "[[action]]\nchain = \"insert\"\nkind = \"column 3\"\nsay = \"now\"\n";
    let mut file = tempfile::NamedTempFile::new().unwrap();
    file.write_all(text.as_bytes()).unwrap();
    let partner = Partner::Script(Scenario::load(file.path(), &task()).unwrap());
    let mut world = World::new(&task(), &robot(), super::settings(1, partner, WorldMode::Kinematic)).unwrap();
    run(&mut world, 19, |_, _, _| {});
    assert_eq!(world.skipped(), 0);
    run(&mut world, 3, |_, _, _| {});
    let mut last = 0;
    run(&mut world, 25, |_, _, out| last = out.sample.heard.sentences);
    assert_eq!((world.skipped(), last), (1, 0), "left out, and not spoken");
}
