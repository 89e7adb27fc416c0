//! A person at the console, in a real browser: sees the run, plays a whole vehicle with the mouse, breaks a process, goes back in
//! time, comes back after leaving the page, and looks at the recording. Where no browser is installed the test says so and ends.
#![allow(clippy::unwrap_used)]

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use coact_joint_task::Task;
use coact_pipeline::Layout;
use coact_tests::{Browser, Course, EndedWithTest, Launched, alone, checkout, coact, wait_for, wait_within};
use coact_world::laid_out;
use glam::{DVec2, DVec3};
use rustix::process::Signal;
use serde_json::Value;
use std::io::{BufRead, BufReader};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

const WINDOW: [u32; 2] = [1440, 900];
/// From one movement of the mouse to the next: 60 Hz.
const FRAME: Duration = Duration::from_micros(16_667);
/// How long anything is waited for.
const PATIENCE: Duration = Duration::from_secs(60);
/// How long somebody looks whether the hand has done what it was to do, and how often it tries.
const LOOKS: Duration = Duration::from_secs(4);
const TRIES: usize = 5;

/// Somebody at the page, who moves the mouse as a recorded person reached.
struct Player {
    browser: Browser,
    courses: Vec<Course>,
    turn: usize,
    at: DVec2,
    pressed: bool,
}

impl Player {
    fn new(browser: Browser, person: u32) -> Self {
        Self { browser, courses: Course::of_person(person), turn: 0, at: DVec2::ZERO, pressed: false }
    }

    fn sit_down(&mut self) {
        self.browser.click("play");
        self.wait_for("the role of the partner", "coact.state().role === 'player'");
        self.browser.click("guide-skip");
        self.at = self.rest();
        self.mouse("mouseMoved");
        // The button of the finger that points, on and off again.
        for shown in ["'pointing'", "null"] {
            self.browser.click("gesture-pointing");
            self.wait_for("the finger", &format!("coact.state().hand.gesture === {shown}"));
        }
    }

    fn wait_for(&mut self, what: &str, expression: &str) {
        let there = format!("typeof coact !== 'undefined' && ({expression})");
        wait_within(PATIENCE, what, || {
            std::thread::sleep(Duration::from_millis(30));
            self.browser.value(&there).as_bool().filter(|is_so| *is_so)
        });
    }

    fn rest(&mut self) -> DVec2 {
        let rest = place(&self.browser.value("coact.hello().task.scene.person_rest"));
        rest.truncate() + DVec2::new(0.14, 0.0)
    }

    fn handover(&mut self) -> DVec2 {
        place(&self.browser.value("coact.hello().task.scene.handover")).truncate()
    }

    fn mouse(&mut self, what: &str) {
        let pixels = self.pixels(&[self.at]);
        self.browser.mouse(what, pixels[0], self.pressed);
    }

    /// What the page shows, for whoever reads why a test has failed.
    fn state(&mut self) -> Value {
        self.browser.value(
            "({...coact.state(), events: coact.state().events.slice(-4), parts: [...coact.picture().parts].map((n) => +n.toFixed(2))})",
        )
    }

    /// Where places of the hand's plane are on the page.
    fn pixels(&mut self, places: &[DVec2]) -> Vec<[f64; 2]> {
        let places: Vec<[f64; 2]> = places.iter().map(|place| place.to_array()).collect();
        let places = serde_json::to_string(&places).unwrap();
        let expression = format!(
            "{places}.map(([x, y]) => coact.project([x, y, coact.handPlane()])).map(({{x, y}}) => [x, y])"
        );
        serde_json::from_value(self.browser.value(&expression)).unwrap()
    }

    /// Moves the mouse there as the person's next reach went.
    fn go(&mut self, to: DVec2) {
        self.turn += 1;
        let course = self.courses[self.turn % self.courses.len()].clone();
        let frames = (course.duration() / FRAME.as_secs_f64()) as u32;
        let time = |frame: u32| f64::from(frame) * FRAME.as_secs_f64();
        let mut way: Vec<DVec2> = (0..frames).map(|frame| course.between(self.at, to, time(frame))).collect();
        way.push(to);
        let begun = Instant::now();
        for (frame, pixel) in self.pixels(&way).into_iter().enumerate() {
            self.browser.mouse("mouseMoved", pixel, self.pressed);
            std::thread::sleep((FRAME * frame as u32).saturating_sub(begun.elapsed()));
        }
        self.at = to;
    }

    /// The part of a kind that lies nearest to a place; with whoever holds it, 0 being nobody.
    fn part(&mut self, kind: &str, near: DVec2, held_by: u32) -> Option<DVec3> {
        let expression = format!(
            "(() => {{ const kind = coact.hello().task.kinds.findIndex(({{name}}) => name === {kind:?}); const {{parts}} = \
             coact.picture(); const found = []; for (let i = 0; i < parts.length; i += 9) if (parts[i] === kind && parts[i + 8] === \
             {held_by}) found.push([parts[i + 1], parts[i + 2], parts[i + 3]]); return found; }})()"
        );
        let found: Vec<[f64; 3]> = serde_json::from_value(self.browser.value(&expression)).unwrap();
        let away = |place: &DVec3| place.truncate().distance(near);
        let places = found.into_iter().map(DVec3::from);
        places.min_by(|one, other| away(one).total_cmp(&away(other)))
    }

    /// The part of a kind that lies nearest to where the hand rests, once it is seen: single frames lack it.
    fn lying(&mut self, kind: &str) -> DVec3 {
        let near = self.rest();
        wait_within(PATIENCE, kind, || self.part(kind, near, 0))
    }

    fn grip(&mut self, number: u32) {
        self.browser.click(&format!("grip-{number}"));
    }

    fn grasp(&mut self, place: DVec2, grip: u32) {
        self.grip(grip);
        self.go(place);
        std::thread::sleep(Duration::from_millis(150));
        self.pressed = true;
        self.mouse("mousePressed");
        std::thread::sleep(Duration::from_millis(700));
    }

    fn let_go_and_rest(&mut self) {
        self.pressed = false;
        self.mouse("mouseReleased");
        std::thread::sleep(Duration::from_millis(500));
        let rest = self.rest();
        self.go(rest);
        std::thread::sleep(Duration::from_millis(800));
    }

    /// The place of a subgoal, and its number.
    fn subgoal(&mut self, name: &str) -> (DVec2, usize) {
        let subgoals = self.browser.value("coact.hello().task.subgoals");
        let subgoals = subgoals.as_array().unwrap();
        let index = subgoals.iter().position(|subgoal| subgoal["name"] == name).unwrap();
        (place(&subgoals[index]["socket"]["at"]).truncate(), index)
    }

    fn wait_for_achieved(&mut self, name: &str) {
        let so = format!(
            "coact.state().events.some(({{sort, text}}) => sort === 'achieved' && text === {name:?})"
        );
        self.wait_for(name, &so);
    }

    /// Where a part of the kind is that the person holds.
    fn in_hand(&mut self, kind: &str) -> Option<DVec2> {
        let near = self.at;
        self.part(kind, near, 2).map(DVec3::truncate)
    }

    /// Takes a part from the table, looks whether the hand has it, and tries again if not: on a busy machine the fingers close late.
    fn takes(&mut self, kind: &str, grip: u32) {
        for _ in 0..TRIES {
            let part = self.lying(kind);
            self.grasp(part.truncate(), grip);
            if self.sees(LOOKS, |player| player.in_hand(kind).is_some()) {
                return;
            }
            self.pressed = false;
            self.mouse("mouseReleased");
            std::thread::sleep(Duration::from_millis(500));
        }
        panic!("the {kind} is not taken: {}", self.state());
    }

    /// Takes a part and brings it there, looks whether it has come there, or is in the robot's hand already, and tries again if not: on a
    /// busy machine fingers that seem to have it may have closed beside it.
    fn brings(&mut self, kind: &str, grip: u32, to: DVec2) {
        for _ in 0..TRIES {
            self.takes(kind, grip);
            // What is in the hand comes along; an open hand over the middle that has lost its part would ask for one.
            self.go(self.at + 0.08 * (to - self.at).normalize());
            let comes =
                |player: &mut Self| player.in_hand(kind).is_some_and(|at| at.distance(player.at) < 0.04);
            let is_there = |at: DVec2| at.distance(to) < 0.03;
            let came = |player: &mut Self| {
                player.in_hand(kind).is_some_and(is_there) || player.part(kind, to, 1).is_some()
            };
            if self.sees(LOOKS, comes) {
                self.go(to);
                if self.sees(LOOKS, came) {
                    return;
                }
            }
            self.pressed = false;
            self.mouse("mouseReleased");
            std::thread::sleep(Duration::from_millis(500));
        }
        panic!("the {kind} is not where the hand is: {}", self.state());
    }

    /// Whether somebody who looks for so long sees this.
    fn sees(&mut self, within: Duration, what: impl Fn(&mut Self) -> bool) -> bool {
        let begun = Instant::now();
        while begun.elapsed() < within {
            if what(self) {
                return true;
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        false
    }

    fn takes_and_inserts(&mut self, kind: &str, name: &str) {
        let (socket, _) = self.subgoal(name);
        self.brings(kind, 0, socket);
        self.insert(name);
    }

    fn insert(&mut self, name: &str) {
        std::thread::sleep(Duration::from_millis(1000));
        self.let_go_and_rest();
        self.wait_for_achieved(name);
    }

    fn hands_over(&mut self, kind: &str, for_subgoal: &str) {
        let handover = self.handover();
        self.brings(kind, 1, handover);
        let is_taken = self.sees(PATIENCE, |player| player.part(kind, handover, 1).is_some());
        assert!(is_taken, "the robot does not take the {kind}: {}", self.state());
        std::thread::sleep(Duration::from_millis(300));
        self.let_go_and_rest();
        self.wait_for_achieved(for_subgoal);
    }

    fn requests_and_inserts(&mut self, kind: &str, name: &str) {
        let handover = self.handover();
        self.browser.click("gesture-0");
        self.go(handover - DVec2::new(0.10, 0.0));
        let is_near = |part: DVec3| part.truncate().distance(handover) < 0.05;
        let is_given = self.sees(PATIENCE, |player| player.part(kind, handover, 1).is_some_and(is_near));
        assert!(is_given, "the robot does not give the {kind}: {}", self.state());
        std::thread::sleep(Duration::from_millis(1000));
        let given = wait_within(PATIENCE, "the part that is given", || self.part(kind, handover, 1));
        self.grasp(given.truncate(), 0);
        let is_mine = self.sees(PATIENCE, |player| player.part(kind, handover, 2).is_some());
        assert!(is_mine, "the robot does not let the {kind} go: {}", self.state());
        let (socket, _) = self.subgoal(name);
        self.go(socket);
        self.insert(name);
    }

    /// Breaks a process by the page's own buttons, and sees that it is back.
    fn breaks_fields(&mut self) {
        self.browser.value("document.getElementById('inject-process').value = 'fields'");
        self.browser.value("document.getElementById('inject-fault').value = 'kill'");
        self.browser.value("document.getElementById('inject').requestSubmit()");
        self.wait_for("the replacement", "coact.state().events.some(({sort}) => sort === 'restart')");
    }

    /// Every view shows something, and something else a moment later.
    fn sees_everything_move(&mut self) {
        self.wait_for("pictures", "coact.state().pictures > 20 && coact.state().live");
        self.browser.click("tab-mind");
        let canvas = |id: &str| format!("document.getElementById({id:?}).toDataURL().length");
        for id in ["mind", "timeline"] {
            let before = self.browser.value(&format!("document.getElementById({id:?}).toDataURL()"));
            assert!(self.browser.value(&canvas(id)).as_u64() > Some(2_000), "{id} is empty");
            self.wait_for(id, &format!("document.getElementById({id:?}).toDataURL() !== {before}"));
        }
        let before = self.browser.picture();
        wait_for("a scene that moves", || (self.browser.picture() != before).then_some(()));
        self.browser.click("tab-machine");
        self.wait_for("durations", "document.querySelectorAll('#machine tr').length > 10");
        self.browser.click("tab-plan");
        self.wait_for("the plan", "document.querySelectorAll('#plan li').length === 9");
        self.browser.click("tab-mind");
        self.browser.value("document.getElementById('scene').focus()");
    }

    fn asks_why(&mut self) {
        self.browser.value(
            "document.getElementById('mind').dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowDown', bubbles: true}))",
        );
        self.wait_for("an explanation", "/stand/.test(document.getElementById('why').textContent)");
    }

    /// Writes what the page shows to the documentation.
    fn draws(&mut self, name: &str) {
        let picture = STANDARD.decode(self.browser.picture()).unwrap();
        std::fs::write(checkout().join("docs/console").join(format!("{name}.png")), picture).unwrap();
    }

    /// The page shows the beginning of the run, then goes on with what is now.
    fn goes_back(&mut self) {
        self.browser.click("pause");
        self.browser.value("document.getElementById('timeline').focus()");
        for _ in 0..200 {
            self.browser.click("before");
        }
        self.wait_for("the beginning", "!coact.state().live && coact.state().at_ms < 10000");
        self.browser.click("live");
        self.wait_for("now", "coact.state().live && coact.state().at_ms > 20000");
    }

    /// The report says for how long each waited, and shows as many waits as there were; the robot came to hold the base meanwhile.
    fn sees_who_waited(&mut self) {
        let waits = self
            .browser
            .value("coact.state().events.filter(({sort}) => sort === 'wait').map(({who}) => who)");
        let waits: Vec<String> = serde_json::from_value(waits).unwrap();
        for who in ["person", "robot"] {
            let shown = format!("document.querySelectorAll('#waits .wait-{who} span').length");
            let count = waits.iter().filter(|own| *own == who).count();
            assert_eq!(self.browser.value(&shown).as_u64(), Some(count as u64), "{who}");
            assert!(count > 0, "{who} has waited for nobody: {waits:?}");
        }
        let told = self.browser.value("document.getElementById('waits').textContent");
        assert!(told.as_str().unwrap().contains("longest: "), "{told}");
    }

    /// Each part is seen where this seed has it, and the page says by which it is.
    fn sees_parts_laid_out_by(&mut self, seed: u64) {
        let file = checkout().join("rt-config/tasks/electronics-box.toml");
        let laid = laid_out(&Task::load(&file).unwrap(), Layout::Random(seed)).unwrap();
        assert_eq!(self.browser.value("coact.hello().run.layout"), format!("random:{seed}"));
        let told = self.browser.value("document.getElementById('layout').textContent");
        assert!(told.as_str().unwrap().contains(&seed.to_string()), "{told}");
        for part in &laid.parts {
            let (kind, at) = (laid.kinds[part.kind].name.clone(), DVec2::from(part.at));
            let seen = self.part(&kind, at, 0).unwrap_or_else(|| panic!("no {kind} is seen"));
            assert!(seen.truncate().distance(at) < 0.02, "{kind}: seen at {seen}, laid out at {at}");
        }
    }

    fn comes_back(&mut self) {
        let known = self.browser.value("coact.state().events.length").as_u64().unwrap();
        self.browser.call("Page.reload", serde_json::json!({}));
        self.wait_for("the page again", "coact.state().pictures > 5");
        self.wait_for("all events", &format!("coact.state().events.length >= {known}"));
    }
}

fn place(value: &Value) -> DVec3 {
    DVec3::from(serde_json::from_value::<[f64; 3]>(value.clone()).unwrap())
}

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
    // A hand that had lost its part on the way has asked for one that nobody meant.
    let meant = told.events.iter().filter(|action| action.chain != "request" || action.kind == "nut");
    let kinds: Vec<_> = meant.map(|action| action.chain.as_str()).collect();
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
        Launched::start(&["--partner", &partner, "--world", "kinematic", "--duration", "40"]).finish();
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
