//! Somebody at the page.

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use coact_joint_task::Task;
use coact_pipeline::Layout;
use coact_tests::{Browser, Course, checkout, wait_for, wait_within};
use coact_world::laid_out;
use glam::{DVec2, DVec3};
use serde_json::Value;
use std::time::{Duration, Instant};

/// From one movement of the mouse to the next: 60 Hz.
const FRAME: Duration = Duration::from_micros(16_667);
/// How long anything is waited for.
pub const PATIENCE: Duration = Duration::from_secs(60);
/// How long somebody looks whether the hand has done what it was to do, and how often it tries.
const LOOKS: Duration = Duration::from_secs(4);
const TRIES: usize = 5;
/// How many pictures somebody looks at who wants to know where a part lies.
const PICTURES: usize = 12;

/// Somebody at the page, who moves the mouse as a recorded person reached.
pub struct Player {
    pub browser: Browser,
    courses: Vec<Course>,
    turn: usize,
    at: DVec2,
    pressed: bool,
}

impl Player {
    pub fn new(browser: Browser, person: u32) -> Self {
        Self { browser, courses: Course::of_person(person), turn: 0, at: DVec2::ZERO, pressed: false }
    }

    pub fn sit_down(&mut self) {
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

    pub fn wait_for(&mut self, what: &str, expression: &str) {
        let there = format!("typeof coact !== 'undefined' && ({expression})");
        let is_there = |player: &mut Self| player.browser.value(&there).as_bool() == Some(true);
        assert!(self.sees(PATIENCE, is_there), "timed out: {what}: {}", self.state());
    }

    fn rest(&mut self) -> DVec2 {
        let rest = place(&self.browser.value("coact.hello().task.scene.person_rest"));
        rest.truncate() + DVec2::new(0.14, 0.0)
    }

    pub fn handover(&mut self) -> DVec2 {
        place(&self.browser.value("coact.hello().task.scene.handover")).truncate()
    }

    fn mouse(&mut self, what: &str) {
        let pixels = self.pixels(&[self.at]);
        self.browser.mouse(what, pixels[0], self.pressed);
    }

    /// What the page shows, for whoever reads why a test has failed.
    fn state(&mut self) -> Value {
        self.browser.value(
            "typeof coact !== 'undefined' && {...coact.state(), events: coact.state().events.slice(-4), now: coact.picture()?.state, \
             parts: [...coact.picture()?.parts ?? []].map((n) => +n.toFixed(2))}",
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
    pub fn go(&mut self, to: DVec2) {
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

    /// Where one picture shows parts of a kind; with whoever holds them, 0 being nobody.
    fn shown(&mut self, kind: &str, held_by: u32) -> Vec<DVec3> {
        let expression = format!(
            "(() => {{ const kind = coact.hello().task.kinds.findIndex(({{name}}) => name === {kind:?}); const {{parts}} = \
             coact.picture(); const found = []; for (let i = 0; i < parts.length; i += 9) if (parts[i] === kind && parts[i + 8] === \
             {held_by}) found.push([parts[i + 1], parts[i + 2], parts[i + 3]]); return found; }})()"
        );
        let found: Vec<[f64; 3]> = serde_json::from_value(self.browser.value(&expression)).unwrap();
        found.into_iter().map(DVec3::from).collect()
    }

    /// The part of a kind that one picture shows nearest to a place; with whoever holds it, 0 being nobody.
    pub fn part(&mut self, kind: &str, near: DVec2, held_by: u32) -> Option<DVec3> {
        nearest(self.shown(kind, held_by), near)
    }

    /// Where parts of a kind lie by most of several pictures: single ones lack a part, or show one where there is none.
    fn steadily_shown(&mut self, kind: &str) -> Vec<DVec3> {
        let mut pictures: Vec<Vec<DVec3>> = Vec::new();
        for _ in 0..PICTURES {
            pictures.push(self.shown(kind, 0));
            std::thread::sleep(Duration::from_millis(60));
        }
        let shows = |picture: &[DVec3], place: DVec3| picture.iter().any(|own| own.distance(place) < 0.02);
        let is_steady =
            |place: &DVec3| 2 * pictures.iter().filter(|picture| shows(picture, *place)).count() > PICTURES;
        pictures.iter().flatten().copied().filter(is_steady).collect()
    }

    /// The part of a kind that lies nearest to where the hand rests, and not in its place, once it is seen.
    fn lying(&mut self, kind: &str) -> DVec3 {
        let near = self.rest();
        let sockets = self.browser.value("coact.hello().task.subgoals.map(({socket}) => socket.at)");
        let sockets: Vec<[f64; 3]> = serde_json::from_value(sockets).unwrap();
        wait_within(PATIENCE, kind, || {
            let mut places = self.steadily_shown(kind);
            places.retain(|place| sockets.iter().all(|socket| place.distance(DVec3::from(*socket)) > 0.05));
            nearest(places, near)
        })
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
        self.opens();
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

    pub fn wait_for_achieved(&mut self, name: &str) {
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

    /// Takes a part from where it is, looks whether the hand has it, and tries again if not: on a busy machine the fingers close late.
    fn takes_from(&mut self, kind: &str, grip: u32, place: impl Fn(&mut Self) -> DVec3) -> DVec3 {
        for _ in 0..TRIES {
            let part = place(self);
            self.grasp(part.truncate(), grip);
            if self.sees(LOOKS, |player| player.in_hand(kind).is_some()) {
                return part;
            }
            self.opens();
        }
        panic!("the {kind} is not taken: {}", self.state());
    }

    /// Takes a part, brings it there, and sees that it has come there, is in the robot's hand already, or is at least not where it was:
    /// hands may cover it. If it is, tries again: on a busy machine the hand leaves before its fingers have closed.
    fn brings(&mut self, kind: &str, grip: u32, to: DVec2) {
        self.brings_from(kind, grip, to, |player| player.lying(kind));
    }

    fn brings_from(&mut self, kind: &str, grip: u32, to: DVec2, place: impl Fn(&mut Self) -> DVec3) {
        for _ in 0..TRIES {
            let from = self.takes_from(kind, grip, &place);
            self.go(to);
            let is_there = |at: DVec2| at.distance(to) < 0.03;
            let is_beside = |at: DVec3| at.truncate().distance(to) < 0.15;
            let came = |player: &mut Self| {
                player.in_hand(kind).is_some_and(is_there) || player.part(kind, to, 1).is_some_and(is_beside)
            };
            if self.sees(LOOKS, came) || !self.is_left(kind, from) {
                return;
            }
            self.opens();
        }
        panic!("the {kind} is not where the hand is: {}", self.state());
    }

    /// Whether a part of the kind is still where the fingers were to close on it: on the table, or in the robot's hand.
    fn is_left(&mut self, kind: &str, from: DVec3) -> bool {
        let is_there = |at: DVec3| at.distance(from) < 0.03;
        let with_robot = self.shown(kind, 1);
        with_robot.into_iter().chain(self.steadily_shown(kind)).any(is_there)
    }

    fn opens(&mut self) {
        self.pressed = false;
        self.mouse("mouseReleased");
        std::thread::sleep(Duration::from_millis(500));
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

    pub fn takes_and_inserts(&mut self, kind: &str, name: &str) {
        let (socket, _) = self.subgoal(name);
        self.brings(kind, 0, socket);
        self.insert(name);
    }

    fn insert(&mut self, name: &str) {
        std::thread::sleep(Duration::from_millis(1000));
        self.let_go_and_rest();
        self.wait_for_achieved(name);
    }

    pub fn hands_over(&mut self, kind: &str, for_subgoal: &str) {
        let handover = self.handover();
        self.brings(kind, 1, handover);
        let is_taken = self.sees(PATIENCE, |player| player.part(kind, handover, 1).is_some());
        assert!(is_taken, "the robot does not take the {kind}: {}", self.state());
        std::thread::sleep(Duration::from_millis(300));
        self.let_go_and_rest();
        self.wait_for_achieved(for_subgoal);
    }

    pub fn requests_and_inserts(&mut self, kind: &str, name: &str) {
        let handover = self.handover();
        self.browser.click("gesture-0");
        self.go(handover - DVec2::new(0.10, 0.0));
        let is_near = |part: DVec3| part.truncate().distance(handover) < 0.05;
        let is_given = self.sees(PATIENCE, |player| player.part(kind, handover, 1).is_some_and(is_near));
        assert!(is_given, "the robot does not give the {kind}: {}", self.state());
        std::thread::sleep(Duration::from_millis(1000));
        let (socket, _) = self.subgoal(name);
        // Where the hand left before its fingers had closed, the robot has the part still.
        self.brings_from(kind, 0, socket, |player| {
            wait_within(PATIENCE, "the part that is given", || player.part(kind, handover, 1))
        });
        self.insert(name);
    }

    /// Breaks a process by the page's own buttons, and sees that it is back.
    pub fn breaks_fields(&mut self) {
        self.browser.value("document.getElementById('inject-process').value = 'fields'");
        self.browser.value("document.getElementById('inject-fault').value = 'kill'");
        self.browser.value("document.getElementById('inject').requestSubmit()");
        self.wait_for("the replacement", "coact.state().events.some(({sort}) => sort === 'restart')");
    }

    /// Every view shows something, and something else a moment later.
    pub fn sees_everything_move(&mut self) {
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

    pub fn asks_why(&mut self) {
        self.browser.value(
            "document.getElementById('mind').dispatchEvent(new KeyboardEvent('keydown', {key: 'ArrowDown', bubbles: true}))",
        );
        self.wait_for("an explanation", "/stand/.test(document.getElementById('why').textContent)");
    }

    /// Writes what the page shows to the documentation.
    pub fn draws(&mut self, name: &str) {
        let picture = STANDARD.decode(self.browser.picture()).unwrap();
        std::fs::write(checkout().join("docs/console").join(format!("{name}.png")), picture).unwrap();
    }

    /// The page shows the beginning of the run, then goes on with what is now.
    pub fn goes_back(&mut self) {
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
    pub fn sees_who_waited(&mut self) {
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
    pub fn sees_parts_laid_out_by(&mut self, seed: u64) {
        let file = checkout().join("rt-config/tasks/electronics-box.toml");
        let laid = laid_out(&Task::load(&file).unwrap(), Layout::Random(seed)).unwrap();
        assert_eq!(self.browser.value("coact.hello().run.layout"), format!("random:{seed}"));
        let told = self.browser.value("document.getElementById('layout').textContent");
        assert!(told.as_str().unwrap().contains(&seed.to_string()), "{told}");
        for part in &laid.parts {
            let (kind, at) = (laid.kinds[part.kind].name.clone(), DVec2::from(part.at));
            // Single frames miss a part, or take it for another.
            let what = format!("{kind} where it is laid out, at {at}");
            wait_within(PATIENCE, &what, || {
                self.part(&kind, at, 0).filter(|seen| seen.truncate().distance(at) < 0.02)
            });
        }
    }

    pub fn comes_back(&mut self) {
        let known = self.browser.value("coact.state().events.length").as_u64().unwrap();
        self.browser.call("Page.reload", serde_json::json!({}));
        self.wait_for("the page again", "coact.state().pictures > 5");
        self.wait_for("all events", &format!("coact.state().events.length >= {known}"));
    }
}

fn nearest(places: Vec<DVec3>, near: DVec2) -> Option<DVec3> {
    let away = |place: &DVec3| place.truncate().distance(near);
    places.into_iter().min_by(|one, other| away(one).total_cmp(&away(other)))
}

fn place(value: &Value) -> DVec3 {
    DVec3::from(serde_json::from_value::<[f64; 3]>(value.clone()).unwrap())
}
