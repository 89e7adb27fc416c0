// The page: what the server tells goes to the views, what is done on the page goes to the server.

import { forgetResolved } from "./colours.js";
import { Connection } from "./connection.js";
import { Guide } from "./guide.js";
import { Machine } from "./machine.js";
import { Mind } from "./mind.js";
import { Partner } from "./partner.js";
import { readPicture } from "./picture.js";
import { Plan, layoutInWords, showReport } from "./plan.js";
import { Playback } from "./playback.js";
import { Scene } from "./scene.js";
import { Timeline, told } from "./timeline.js";
import { listenForTurning } from "./turning.js";
import { showWhy } from "./why.js";

const $ = (id) => document.getElementById(id);
const connection = new Connection();
const timeline = new Timeline($("timeline"), (cycle) => lookAt(cycle), () => redraw());
const machine = new Machine($("machine"), $("curves"));
const playback = new Playback((passed) => {
  if (timeline.cursor >= timeline.now) return false;
  goTo(Math.min(timeline.cursor + passed, timeline.now));
  return true;
});
let hello = null, scene = null, mind = null, partner = null, plan = null, guide = null;
/** What is shown: the picture, whether it is of now, how many there were, and what is known of the run. */
const shown = {
  picture: null, live: true, count: 0, drawn: 0, due: false, all: true, asked: false, stopped: false,
  ended: false, again: false, lost: false, role: "watcher", playsSince: null, refusal: null,
};

// ---- what the server tells

connection.addEventListener("hello", ({ detail }) => {
  // Another run has another task and other views.
  if (hello && (hello.run.id !== detail.run.id || hello.run.report !== detail.run.report)) return location.reload();
  const again = hello !== null;
  hello = detail;
  shown.lost = false;
  $("stage").classList.remove("lost");
  if (!again) begin();
  else {
    cover(null);
    if (mind.chosen !== null) connection.send({ why: mind.chosen });
    if (shown.role === "player") connection.send({ play: true });
    if (!shown.live) connection.send({ at: Math.round(timeline.cursor) });
  }
  status();
});
connection.addEventListener("picture", ({ detail }) => {
  const picture = hello && readPicture(detail, hello.sizes);
  if (!picture || picture.past === shown.live) return;
  shown.picture = picture;
  shown.count += 1;
  scene.sharpness.came();
  if (shown.live) {
    timeline.now = Math.max(timeline.now, picture.at);
    timeline.cursor = picture.at;
  }
  redraw(picture.past);
});
connection.addEventListener("events", ({ detail: { first, events } }) => {
  timeline.add(first, events);
  if (shown.playsSince !== null) teach();
  redraw();
});
connection.addEventListener("machine", ({ detail }) => {
  machine.show(detail);
  if (!$("machine-panel").hidden) machine.draw();
});
connection.addEventListener("why", ({ detail }) => detail.population === mind?.chosen && showWhy($("why"), detail));
connection.addEventListener("history", ({ detail: { first_ms, last_ms } }) => {
  timeline.now = Math.max(timeline.now, last_ms);
  if (!hello?.run.recorded || shown.picture !== null) return;
  timeline.showAll();
  goTo(first_ms);
});
connection.addEventListener("role", ({ detail: { role, players } }) => {
  shown.role = role;
  if (role === "player") shown.playsSince ??= timeline.now;
  partner?.become(role === "player");
  text($("play"), role === "player" ? "leave the table" : players > 0 ? "somebody plays" : "be the partner");
  $("play").disabled = role !== "player" && players > 0;
  guide?.saw({ plays: role === "player" });
  status();
});
connection.addEventListener("ended", ({ detail }) => {
  shown.ended = true;
  showReport($("report"), detail);
  guide?.end();
  if (!hello.run.recorded) {
    // Another round is served at the same address: the page then loads itself anew.
    if (!shown.again) connection.finish();
    partner.become(false);
    show("plan");
    for (const id of ["play", "stop", "resume", "inject", "say", "end", "again"]) $(id).hidden = true;
  }
  status();
});
connection.addEventListener("refused", ({ detail: { what, why } }) => {
  text($("refused"), `${what}: ${why}`);
  $("refused").hidden = false;
  clearTimeout(shown.refusal);
  shown.refusal = setTimeout(() => ($("refused").hidden = true), 5000);
});
connection.addEventListener("lost", () => {
  shown.lost = true;
  $("stage").classList.add("lost");
  cover(shown.again ? "Another round begins." : shown.ended ? "The run is over, and its server has gone." : "The line to the robot is lost. It is tried again and again.");
  status();
});
connection.addEventListener("unwanted", () => {
  cover("This address lets nobody in: its token is not that of the run. Open the one that coact has printed.");
});

/** Sets the views up for a run. */
function begin() {
  text($("task"), hello.run.task);
  document.title = `coact: ${hello.run.task}`;
  scene = new Scene($("scene"), $("labels"), hello);
  mind = new Mind($("mind"), hello, (population) => {
    connection.send({ why: population });
    if (population === null) showWhy($("why"), null);
    redraw();
  });
  plan = new Plan(hello);
  partner = new Partner(scene, connection, hello);
  const { recorded } = hello.run;
  const mayPlay = hello.run.partner === "hand" && !recorded;
  shown.live = !recorded;
  $("play").hidden = !mayPlay;
  for (const id of ["stop", "resume", "inject", "say", "end", "live"]) $(id).hidden = recorded;
  $("again").hidden = !mayPlay;
  text($("layout"), `the parts lie ${layoutInWords(hello.run.layout)}`);
  offerSeed();
  options($("again-task"), hello.tasks.map((name) => [name, ""]));
  options($("inject-fault"), hello.faults.map(({ name, description }) => [name, description]));
  options($("inject-process"), hello.processes.map(({ name }) => [name, ""]));
  $("inject-process").value = "fields";
  options($("phrases"), hello.task.phrases.map((phrase) => [phrase, ""]));
  if (mayPlay) guide = new Guide((name) => narrow.matches || show(name));
  scene.clear();
  cover("Nothing has been seen yet.");
}

/** Other places each time, unless somebody wants those of a number again. */
function offerSeed() {
  $("again-seed-label").hidden = $("again-layout").value !== "random";
  $("again-seed").value = String(Math.floor(Math.random() * 1_000_000));
}

function chosenLayout() {
  return $("again-layout").value === "random" ? `random:${$("again-seed").valueAsNumber}` : "task";
}

function options(list, entries) {
  list.replaceChildren(...entries.map(([name, title]) => Object.assign(document.createElement("option"), { value: name, textContent: name, title })));
}

// ---- what is shown

/** Draws at the screen's next picture, once, whatever has changed until then: all, or what moves from one live picture to the next. */
function redraw(all = true) {
  shown.all ||= all;
  if (shown.due) return;
  shown.due = true;
  requestAnimationFrame(() => {
    shown.due = false;
    draw();
  });
}

function draw() {
  const { picture, all } = shown;
  shown.all = false;
  // The line creeps by a pixel or two: ten times a second is enough for it.
  if (all || shown.drawn % 3 === 0) drawTimes();
  if (!picture) return;
  if (!shown.lost) cover(null);
  plan.show(picture);
  scene.draw(picture, plan.states);
  if (!$("mind-panel").hidden && (all || !scene.sharpness.isStrained || shown.drawn % 2 === 0)) mind.draw(picture);
  now(picture);
  if (partner.plays) guide?.saw({ nearPart: isOverPart(picture) });
  shown.drawn += 1;
  scene.sharpness.drew();
}

function drawTimes() {
  timeline.draw();
  const current = timeline.last(() => true);
  text($("event"), current ? told(current) : "nothing has happened yet");
  text($("clock"), `${(timeline.cursor / 1000).toFixed(1)} s`);
}

/** What is decided, said and expected, in words. */
function now(picture) {
  const phase = hello.phases?.[picture.state.phase];
  const decided = plan.standing("AEL", picture);
  const error = plan.standing("EML", picture);
  const expected = picture.state.hidden ? "your hand is not seen" : "nothing certain";
  text($("decided"), decided ? `${decided}${phase && phase !== "rest" ? ` (${phase})` : ""}` : "nothing");
  text($("said"), timeline.last(({ sort }) => sort === "said")?.text ?? "nothing yet");
  text($("expects"), error ? `\u26A0 wrong: ${error}` : plan.standing("IL", picture) ?? expected);
  if (picture.state.stopped === shown.stopped) return;
  shown.stopped = picture.state.stopped;
  status();
}

/** What the partner has done since it sits at the table leads on in the first round. */
function teach() {
  const own = timeline.events.filter(({ at_ms }) => at_ms >= shown.playsSince);
  const count = (sort) => own.filter((event) => event.sort === sort).length;
  const asks = own.some(({ sort, text: words }) => sort === "action" && words?.startsWith("request"));
  guide?.saw({ grasps: count("action"), achieved: count("achieved"), asks });
}

function isOverPart({ parts }) {
  for (let index = 0; index < parts.length; index += 9) {
    if (Math.hypot(parts[index + 1] - partner.hand.x, parts[index + 2] - partner.hand.y) < 0.05) return true;
  }
  return false;
}

function status() {
  const say = () => {
    if (shown.ended && !hello?.run.recorded) return ["ended", "the run is over"];
    if (shown.lost) return ["lost", "line lost"];
    if (!hello) return ["connecting", "connecting"];
    if (hello.run.recorded) return ["past", "a recording"];
    if (!shown.live) return ["past", "in the past"];
    if (shown.stopped) return ["stopped", "robot stopped"];
    return ["live", shown.role === "player" ? "live: you play" : "live"];
  };
  const [state, words] = say();
  $("status").dataset.state = state;
  text($("status"), words);
  const moves = shown.live || playback.runs;
  text($("pause"), moves ? "pause" : "play on");
  $("pause").setAttribute("aria-pressed", String(!moves));
  $("live").setAttribute("aria-pressed", String(shown.live));
  if (partner) partner.looksBack = !shown.live;
}

function cover(words) {
  $("cover").hidden = words === null;
  if (words !== null) text($("cover-text"), words);
}

function text(place, words) {
  if (place.textContent === words) return;
  place.textContent = words;
  // What is cut off for want of room is told in full under the pointer.
  if (place.tagName === "DD") place.title = words;
}

// ---- which instant is shown

/** Shows an instant of the past, and stays there. */
function lookAt(cycle) {
  playback.stop();
  goTo(cycle);
}

/** Shows an instant of the past; at most 30 are asked for in a second. */
function goTo(cycle) {
  shown.live = false;
  timeline.cursor = Math.max(0, cycle);
  timeline.follow();
  status();
  redraw();
  if (shown.asked) return;
  shown.asked = true;
  setTimeout(() => {
    shown.asked = false;
    if (!shown.live) connection.send({ at: Math.round(timeline.cursor) });
  }, 34);
}

function goLive() {
  if (!hello || hello.run.recorded) return;
  playback.stop();
  shown.live = true;
  timeline.end = null;
  connection.send({ live: true });
  status();
}

function pause() {
  if (!hello) return;
  if (shown.live) lookAt(timeline.cursor);
  else if (playback.runs) playback.stop();
  else playback.start();
  status();
}

/** Opens one of the panels; that of the scene is one only where there is no room for two. */
function show(name) {
  for (const tab of ["scene", "mind", "plan", "machine"]) {
    const panel = $(`${tab}-panel`);
    if (panel) panel.hidden = tab !== name;
    $(`tab-${tab}`).setAttribute("aria-selected", String(tab === name));
  }
  $("views").dataset.tab = name;
  if (name === "machine") machine.draw();
  redraw();
}

// ---- what is done on the page

const TABS = ["scene", "mind", "plan", "machine"];
for (const name of TABS) $(`tab-${name}`).addEventListener("click", () => show(name));
for (const view of ["person", "top", "side"]) {
  $(`view-${view}`).addEventListener("click", () => {
    scene?.camera.look(view);
    redraw();
  });
}
for (const [id, what] of [["show-true", "truth"], ["show-raw", "raw"]]) {
  $(id).addEventListener("change", ({ target }) => {
    if (scene) scene.shows[what] = target.checked;
    redraw();
  });
}
$("by-name").addEventListener("change", ({ target }) => {
  if (mind) mind.byName = target.checked;
  redraw();
});
$("play").addEventListener("click", () => {
  connection.send({ play: shown.role !== "player" });
  $("scene").focus();
});
$("stop").addEventListener("click", () => connection.send({ stop: true }));
$("resume").addEventListener("click", () => connection.send({ resume: true }));
$("end").addEventListener("click", () => confirm("Finish the run, and see how you were understood?") && connection.send({ end: true }));
$("pause").addEventListener("click", pause);
$("live").addEventListener("click", goLive);
$("before").addEventListener("click", () => timeline.jump(-1));
$("after").addEventListener("click", () => timeline.jump(1));
for (const [id, change] of [["nearer", () => timeline.zoom(0.6)], ["farther", () => timeline.zoom(1.6)], ["earlier", () => timeline.scroll(-0.3)], ["later", () => timeline.scroll(0.3)]]) {
  $(id).addEventListener("click", () => (change(), redraw()));
}
$("again").addEventListener("submit", (event) => {
  event.preventDefault();
  shown.again = true;
  connection.send({ again: { task: $("again-task").value, layout: chosenLayout() } });
});
$("again-layout").addEventListener("change", offerSeed);
$("inject").addEventListener("submit", (event) => {
  event.preventDefault();
  connection.send({ inject: { process: $("inject-process").value, fault: $("inject-fault").value } });
});
$("say").addEventListener("submit", (event) => {
  event.preventDefault();
  const sentence = $("say-text").value.trim();
  if (sentence) connection.send({ say: sentence });
  $("say-text").value = "";
});
$("theme").addEventListener("click", () => {
  const next = { undefined: "light", light: "dark", dark: undefined }[document.documentElement.dataset.theme];
  if (next) document.documentElement.dataset.theme = next;
  else delete document.documentElement.dataset.theme;
  text($("theme"), `colours: ${next ?? "system"}`);
  takeColours();
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", takeColours);
addEventListener("resize", () => {
  if (!$("machine-panel").hidden) machine.draw();
  redraw();
});

function takeColours() {
  forgetResolved();
  scene?.colours();
  if (!shown.picture) scene?.clear();
  if (!$("machine-panel").hidden) machine.draw();
  redraw();
}

const HOTKEYS = {
  p: pause,
  l: goLive,
  t: () => $("say-text").focus(),
  "?": () => $("help").showModal(),
  ",": () => timeline.jump(-1),
  ".": () => timeline.jump(1),
};
addEventListener("keydown", (event) => {
  if (event.key === "Escape" && event.target === $("say-text")) $("scene").focus();
  if (/^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName) || event.ctrlKey || event.metaKey || event.altKey) return;
  if (!HOTKEYS[event.key] || $("help").open) return;
  // The key must not become the first letter of a sentence.
  event.preventDefault();
  HOTKEYS[event.key]();
});
$("help-open").addEventListener("click", () => $("help").showModal());

listenForTurning($("scene"), {
  camera: () => scene?.camera,
  movesHand: () => partner?.plays && shown.live,
  lift: (by) => partner.lift(by),
  changed: () => redraw(),
});
/** As the style has it: where there is no room for scene and panel beside one another. */
const narrow = matchMedia("(max-width: 1060px)");
narrow.addEventListener("change", arrange);
arrange();

function arrange() {
  show(narrow.matches ? "scene" : "mind");
}

/** For tests: what the page shows, and where a place of the world is on it. */
window.coact = {
  state: () => ({
    connected: connection.isOpen, role: shown.role, at_ms: shown.picture?.at ?? null, live: shown.live, pictures: shown.count,
    drawn: shown.drawn, events: timeline.events, decided: $("decided").textContent, ended: shown.ended, hand: partner?.hand,
  }),
  project: (place) => {
    const { left, top } = $("scene").getBoundingClientRect();
    const at = scene?.camera.project(place);
    return at && { x: at.x + left, y: at.y + top };
  },
  handPlane: () => scene?.handPlane,
  hello: () => hello,
  picture: () => shown.picture,
  end: () => connection.send({ end: true }),
};
