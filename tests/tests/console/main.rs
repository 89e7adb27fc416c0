//! A person at the console, in a real browser: sees the run, plays a whole vehicle with the mouse, breaks a process, goes back in
//! time, comes back after leaving the page, and looks at the recording. Where no browser is installed the test says so and ends.
#![allow(clippy::unwrap_used)]

mod player;

use coact_tests::{Browser, EndedWithTest, Launched, alone, checkout, coact, wait_for, wait_within};
use player::{PATIENCE, Player};
use rustix::process::Signal;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

const WINDOW: [u32; 2] = [1440, 900];

/// The address that the console has printed.
fn address(said: &str) -> Option<String> {
    let begin = said.find("open http://")? + "open ".len();
    said[begin..].split_whitespace().next().map(str::to_owned)
}

/// A browser that has opened the console of a running set; where none is installed it says so, and there is none.
fn browser_at(launched: &mut Launched) -> Option<Browser> {
    launched.when_started();
    let address = wait_for("the console's address", || address(&launched.said()));
    let browser = Browser::open(&address, WINDOW);
    if browser.is_none() {
        println!("skipped: no browser is installed; expected chromium");
    }
    browser
}

fn console_of(recording: &Path) -> (EndedWithTest, String) {
    let mut command = Command::new(coact());
    command.arg("console").arg(recording).current_dir(checkout()).stderr(Stdio::piped()).stdin(Stdio::null());
    let mut child = EndedWithTest(command.spawn().unwrap());
    let mut lines = BufReader::new(child.0.stderr.take().unwrap()).lines();
    let address = lines.find_map(|line| address(&line.unwrap())).unwrap();
    std::thread::spawn(move || lines.count());
    (child, address)
}

#[test]
fn somebody_at_the_page_builds_the_vehicle_breaks_a_process_and_looks_back() {
    let _alone = alone();
    let mut launched = Launched::start(&["--console", "--world", "kinematic"]);
    let folder = launched.folder();
    let Some(browser) = browser_at(&mut launched) else { return };
    let mut player = Player::new(browser, 2);
    player.sees_everything_move();
    player.asks_why();
    player.sit_down();
    player.takes_and_inserts("wheel", "wheel on the person's side");
    player.requests_and_inserts("nut", "nut on the person's side");
    player.hands_over("wheel", "wheel on the robot's side");
    player.wait_for_achieved("nut on the robot's side");
    player.breaks_fields();
    player.goes_back();
    player.hands_over("column 1", "column 1 in its hole");
    player.takes_and_inserts("column 2", "column 2 in its hole");
    player.takes_and_inserts("column 4", "column 4 in its hole");
    player.wait_for_achieved("top floor on the columns");
    player.comes_back();
    assert_eq!(player.browser.complaints(), [""; 0]);
    player.browser.value("coact.end()");
    player.wait_for("the report", "coact.state().ended && !document.getElementById('report').hidden");
    player.sees_who_waited();
    let report = launched.report();
    let finished = launched.finish();
    let told = &finished.summary().anticipation;
    let kinds: Vec<_> = told.events.iter().map(|action| action.chain.as_str()).collect();
    assert_eq!(&kinds[..4], ["insert", "request", "insert", "hand over"], "{:?}", told.events);
    assert!(finished.summary().work.passes(), "{:?}", finished.summary().work);
    drop(player);

    let (console, address) = console_of(&report.join("run.mcap"));
    let mut player = Player::new(Browser::open(&address, WINDOW).unwrap(), 2);
    player.wait_for("a picture of the past", "coact.state().pictures > 0 && !coact.state().live");
    player.wait_for("its events", "coact.state().events.filter(({sort}) => sort === 'action').length >= 7");
    player.browser.click("after");
    player.wait_for("the person as she really was", "Number.isFinite(coact.picture().truth[0])");
    assert_eq!(player.browser.complaints(), [""; 0]);
    drop((player, console));
    the_recorded_hand_comes_again(&report.join("run.mcap"));
    drop(folder);
}

/// What the person's hand did in the recording it does again, in a world of its own.
fn the_recorded_hand_comes_again(recording: &Path) {
    let partner = format!("recorded:{}", recording.display());
    let finished =
        Launched::start(&["--partner", &partner, "--world", "kinematic", "--duration", "20"]).finish();
    let told = &finished.summary().anticipation.events;
    let first = told.first().unwrap_or_else(|| panic!("the hand took nothing: {}", finished.stderr));
    assert_eq!((first.chain.as_str(), first.kind.as_str()), ("insert", "wheel"), "{told:?}");
}

/// The pictures of the documentation: each view, and what is seen of the past and at the end.
#[test]
#[ignore = "draws docs/console/*.png: cargo test --release --workspace --test console -- --ignored"]
fn pictures_of_the_documentation() {
    let _alone = alone();
    let mut launched = Launched::start(&["--console", "--world", "kinematic"]);
    let mut player = Player::new(browser_at(&mut launched).unwrap(), 2);
    player.sit_down();
    player.takes_and_inserts("wheel", "wheel on the person's side");
    player.browser.click("tab-mind");
    player.asks_why();
    let handover = player.handover();
    let asked = wait_within(PATIENCE, "nut", || player.part("nut", handover, 0));
    player.browser.click("gesture-pointing");
    player.go(asked.truncate());
    std::thread::sleep(Duration::from_millis(900));
    for scheme in ["dark", "light"] {
        player.browser.prefer(scheme);
        std::thread::sleep(Duration::from_millis(300));
        player.draws(scheme);
    }
    player.browser.click("view-top");
    for tab in ["plan", "machine"] {
        player.browser.click(&format!("tab-{tab}"));
        std::thread::sleep(Duration::from_millis(1000));
        player.draws(tab);
    }
    player.browser.click("tab-mind");
    player.browser.click("pause");
    (0..3).for_each(|_| player.browser.click("before"));
    std::thread::sleep(Duration::from_millis(500));
    player.draws("past");
    player.browser.click("live");
    player.browser.value("coact.end()");
    player.wait_for("the report", "coact.state().ended && !document.getElementById('report').hidden");
    player.browser.click("tab-plan");
    std::thread::sleep(Duration::from_millis(500));
    player.draws("report");
}

#[test]
fn another_round_with_another_task_begins_at_the_same_address() {
    let _alone = alone();
    let mut launched = Launched::start(&["--console", "--world", "kinematic"]);
    let Some(browser) = browser_at(&mut launched) else { return };
    let mut player = Player::new(browser, 3);
    player.wait_for("pictures", "coact.state().pictures > 10");
    player.browser.click("tab-plan");
    player.browser.value("document.getElementById('again-task').value = 'electronics-box'");
    player.browser.value("document.getElementById('again-layout').value = 'random'");
    player.browser.value("document.getElementById('again-layout').dispatchEvent(new Event('change'))");
    player.browser.value("document.getElementById('again-seed').value = '4711'");
    player.browser.value("document.getElementById('again').requestSubmit()");
    let begun = "coact.state().pictures > 10 && coact.hello().run.task === 'electronics box'";
    player.wait_for("the next round", begun);
    player.sees_parts_laid_out_by(4711);
    let next: Vec<_> = std::fs::read_dir(launched.report().parent().unwrap()).unwrap().collect();
    assert!(next.len() > 3, "a report of its own: {next:?}");
    launched.signal(Signal::INT);
    launched.finish();
}
