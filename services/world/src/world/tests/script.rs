use super::{Out, config, robot, task};
use crate::{BodyKind, Partner, Script, Settings, World};
use coact_messages::PartnerPhase;
use std::io::Write;

fn refusal(text: &str) -> String {
    let mut file = tempfile::NamedTempFile::new().unwrap();
    file.write_all(text.as_bytes()).unwrap();
    let message = Script::load(file.path(), &task()).unwrap_err().to_string();
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
        Script::load(std::path::Path::new("no/such.toml"), &task())
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
    let settings = Settings { seed: 1, partner, body: BodyKind::Kinematic };
    let (mut world, mut out) = (World::new(&task(), &robot(), settings).unwrap(), Out::new());
    let mut begun = Vec::new();
    for tick in 1..=seconds * 1000 {
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
