// The page: what the server tells goes to the views, what is done on the page goes to the server.

import { Connection } from "./connection.js";
import { Guide } from "./guide.js";
import { Machine } from "./machine.js";
import { Mind } from "./mind.js";
import { Partner } from "./partner.js";
import { readPicture } from "./picture.js";
import { Plan, showReport } from "./plan.js";
import { Scene } from "./scene.js";
import { Timeline, told } from "./timeline.js";
import { showWhy } from "./why.js";

const $ = (id) => document.getElementById(id);
const connection = new Connection();
const timeline = new Timeline($("timeline"), (cycle) => goTo(cycle));
const machine = new Machine($("machine"), $("curves"));
let hello = null, scene = null, mind = null, partner = null, plan = null, guide = null;
/** What is shown: the picture, whether it is of now, how many there were, and what is known of the run. */
const shown = { picture: null, live: true, count: 0, ended: false, lost: false, role: "watcher", asked: null };

connection.addEventListener("hello", ({ detail }) => {
  const again = hello?.run.id === detail.run.id;
  hello = detail;
  shown.lost = false;
  if (!again) begin();
  $("stage").classList.remove("lost");
  cover(null);
  if (again && mind.chosen !== null) connection.send({ why: mind.chosen });
  if (again && shown.role === "player") connection.send({ play: true });
  if (!shown.live) connection.send({ at: Math.round(timeline.cursor) });
  status();
});
connection.addEventListener("picture", ({ detail }) => {
  const picture = hello && readPicture(detail, hello.sizes);
  if (!picture || (!picture.past && !shown.live)) return;
  shown.picture = picture;
  shown.count += 1;
  if (!picture.past) timeline.now = Math.max(timeline.now, picture.at);
  if (shown.live) timeline.cursor = picture.at;
  requestAnimationFrame(draw);
});
connection.addEventListener("events", ({ detail: { first, events } }) => {
  timeline.add(first, events);
  const count = (sort) => timeline.events.filter((event) => event.sort === sort).length;
  guide?.saw({ grasps: count("action"), achieved: count("achieved"), asks: timeline.events.some(({ sort, text }) => sort === "action" && text.startsWith("request")) });
  requestAnimationFrame(draw);
});
connection.addEventListener("machine", ({ detail }) => {
  machine.show(detail);
  if (!$("machine-panel").hidden) machine.draw();
});
connection.addEventListener("why", ({ detail }) => detail.population === mind?.chosen && showWhy($("why"), detail));
connection.addEventListener("history", ({ detail: { first_ms, last_ms } }) => {
  timeline.now = Math.max(timeline.now, last_ms);
  if (hello?.run.recorded && shown.picture === null) goTo(first_ms);
});
connection.addEventListener("role", ({ detail: { role, players } }) => {
  shown.role = role;
  partner?.become(role === "player");
  $("play").textContent = role === "player" ? "leave the table" : players > 0 ? "somebody plays" : "be the partner";
  $("play").disabled = role !== "player" && players > 0;
  guide?.saw({ plays: role === "player" });
  status();
});
connection.addEventListener("ended", ({ detail }) => {
  shown.ended = true;
  if (!hello.run.recorded) connection.finish();
  showReport($("report"), detail);
  if (!hello.run.recorded) show("plan");
  guide?.saw({});
  $("guide").hidden = true;
  status();
});
connection.addEventListener("refused", ({ detail: { why } }) => {
  $("refused").textContent = why;
  $("refused").hidden = false;
  clearTimeout(shown.refusal);
  shown.refusal = setTimeout(() => ($("refused").hidden = true), 5000);
});
connection.addEventListener("lost", ({ detail: { tries, everOpen } }) => {
  shown.lost = true;
  $("stage").classList.add("lost");
  const token = !everOpen && tries > 1 && !hello;
  cover(token ? "This address lets nobody in: its token is not that of the run. The address that coact has printed does." : "The line is lost. It is tried again.");
  status();
});

/** Sets the views up for a run. */
function begin() {
  $("task").textContent = hello.task.subgoals.length ? hello.run.task : "";
  document.title = `coact: ${hello.run.task}`;
  scene = new Scene($("scene"), $("labels"), hello);
  mind = new Mind($("mind"), hello, (population) => {
    connection.send({ why: population });
    if (population === null) showWhy($("why"), null);
    requestAnimationFrame(draw);
  });
  plan = new Plan(hello);
  partner = new Partner(scene, connection, hello);
  const { recorded } = hello.run;
  const mayPlay = hello.run.partner === "hand" && !recorded;
  $("play").hidden = !mayPlay;
  $("end").hidden = recorded;
  for (const id of ["stop", "resume", "inject", "say"]) $(id).hidden = recorded;
  guide = mayPlay ? new Guide() : null;
  scene.camera.look("person");
  options($("inject-fault"), hello.faults.map(({ name, description }) => [name, description]));
  options($("inject-process"), hello.processes.map(({ name }) => [name, ""]));
  $("inject-process").value = "fields";
  $("phrases").replaceChildren(...hello.task.phrases.map((phrase) => Object.assign(document.createElement("option"), { value: phrase })));
  if (recorded) timeline.span = 60_000;
  cover("Nothing has been seen yet.");
}

function options(select, entries) {
  select.replaceChildren(...entries.map(([name, title]) => Object.assign(document.createElement("option"), { value: name, textContent: name, title })));
}

/** Draws all views of the picture that is shown, once for each picture. */
function draw() {
  const { picture } = shown;
  timeline.draw();
  const current = timeline.current();
  text($("event"), current ? told(current) : "");
  text($("clock"), `${(timeline.cursor / 1000).toFixed(1)} s`);
  if (!picture) return;
  if (!shown.lost) cover(null);
  plan.show(picture);
  scene.draw(picture, plan.achieved);
  if (!$("mind-panel").hidden) mind.draw(picture);
  now(picture);
  if (partner.plays) guide?.saw({ nearPart: isOverPart(picture) });
}

/** What is decided, said and expected, in words. */
function now(picture) {
  const at = (sort) => timeline.events.filter((event) => event.sort === sort && event.at_ms <= timeline.cursor).pop()?.text;
  const phase = hello.phases[picture.state.phase];
  const decided = plan.standing("AEL", picture);
  text($("decided"), decided ? `${decided}${phase && phase !== "rest" ? ` (${phase})` : ""}` : "nothing");
  text($("said"), at("said") ?? "nothing yet");
  const error = plan.standing("EML", picture);
  text($("expects"), error ? `something is wrong: ${error}` : plan.standing("IL", picture) ?? (picture.state.hidden ? "your hand is not seen" : "nothing certain"));
  if (picture.state.stopped !== shown.stopped) {
    shown.stopped = picture.state.stopped;
    status();
  }
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
    if (shown.stopped) return ["stopped", "the robot is stopped"];
    return ["live", shown.role === "player" ? "live: you play" : "live"];
  };
  const [state, words] = say();
  $("status").dataset.state = state;
  text($("status"), words);
  $("pause").setAttribute("aria-pressed", String(!shown.live));
}

function cover(words) {
  $("cover").hidden = words === null;
  if (words !== null) text($("cover-text"), words);
}

function text(place, words) {
  if (place.textContent !== words) place.textContent = words;
}

/** Shows an instant of the past; at most one is asked for in each picture of the screen. */
function goTo(cycle) {
  shown.live = false;
  timeline.cursor = cycle;
  status();
  if (shown.asked === null) {
    requestAnimationFrame(() => {
      connection.send({ at: Math.round(timeline.cursor) });
      shown.asked = null;
      draw();
    });
  }
  shown.asked = cycle;
}

function goLive() {
  if (!hello || hello.run.recorded) return;
  shown.live = true;
  timeline.end = null;
  connection.send({ live: true });
  status();
}

function show(name) {
  for (const tab of ["mind", "plan", "machine"]) {
    $(`${tab}-panel`).hidden = tab !== name;
    $(`tab-${tab}`).setAttribute("aria-selected", String(tab === name));
  }
  if (name === "machine") machine.draw();
  requestAnimationFrame(draw);
}

// ---- what is done on the page

for (const name of ["mind", "plan", "machine"]) $(`tab-${name}`).addEventListener("click", () => show(name));
for (const view of ["person", "top", "side"]) {
  $(`view-${view}`).addEventListener("click", () => {
    scene?.camera.look(view);
    requestAnimationFrame(draw);
  });
}
$("show-true").addEventListener("change", ({ target }) => scene && (scene.shows.truth = target.checked));
$("show-raw").addEventListener("change", ({ target }) => scene && (scene.shows.raw = target.checked));
$("play").addEventListener("click", () => {
  connection.send({ play: shown.role !== "player" });
  $("scene").focus();
});
$("stop").addEventListener("click", () => connection.send({ stop: true }));
$("resume").addEventListener("click", () => connection.send({ resume: true }));
$("end").addEventListener("click", () => confirm("Finish the run, and see how you were understood?") && connection.send({ end: true }));
$("pause").addEventListener("click", () => (shown.live ? goTo(timeline.cursor) : goLive()));
$("live").addEventListener("click", goLive);
$("before").addEventListener("click", () => timeline.jump(-1));
$("after").addEventListener("click", () => timeline.jump(1));
$("nearer").addEventListener("click", () => (timeline.zoom(0.6), requestAnimationFrame(draw)));
$("farther").addEventListener("click", () => (timeline.zoom(1.6), requestAnimationFrame(draw)));
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
  $("theme").setAttribute("aria-label", `colours: ${next ?? "as the system has them"}`);
  scene?.colours();
  requestAnimationFrame(draw);
});
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => scene?.colours());
addEventListener("resize", () => requestAnimationFrame(draw));
addEventListener("keydown", ({ target, key }) => {
  if (/^(INPUT|SELECT|TEXTAREA)$/.test(target.tagName)) return;
  if (key === "p") $("pause").click();
  if (key === "l") goLive();
  if (key === "t") setTimeout(() => $("say-text").focus());
});

/** Turning and zooming: right button, or any button where the page does not play; two fingers or the wheel zoom. */
const fingers = new Map();
$("scene").addEventListener("contextmenu", (event) => event.preventDefault());
$("scene").addEventListener("pointerdown", (event) => fingers.set(event.pointerId, event));
for (const kind of ["pointerup", "pointercancel", "pointerleave"]) {
  $("scene").addEventListener(kind, (event) => fingers.delete(event.pointerId));
}
$("scene").addEventListener("pointermove", (event) => {
  const before = fingers.get(event.pointerId);
  if (!before || !scene) return;
  const turns = event.buttons & 2 || shown.role !== "player";
  if (fingers.size === 2) {
    const other = [...fingers.values()].find(({ pointerId }) => pointerId !== event.pointerId);
    const apart = (one) => Math.hypot(one.offsetX - other.offsetX, one.offsetY - other.offsetY);
    scene.camera.zoom(apart(before) / Math.max(apart(event), 1));
  } else if (turns) {
    scene.camera.turn(event.offsetX - before.offsetX, event.offsetY - before.offsetY);
  }
  fingers.set(event.pointerId, event);
  if (!shown.live) requestAnimationFrame(draw);
});
$("scene").addEventListener("wheel", (event) => {
  event.preventDefault();
  if (event.shiftKey && partner?.plays) partner.lift(-Math.sign(event.deltaY || event.deltaX));
  else scene?.camera.zoom(event.deltaY > 0 ? 1.1 : 0.9);
  if (!shown.live) requestAnimationFrame(draw);
}, { passive: false });

/** For tests: what the page shows, and where a place of the world is on it. */
window.coact = {
  state: () => ({
    connected: connection.isOpen, role: shown.role, at_ms: shown.picture?.at ?? null, live: shown.live, pictures: shown.count,
    events: timeline.events, decided: $("decided").textContent, ended: shown.ended, hand: partner?.hand,
  }),
  project: (place) => {
    const { left, top } = $("scene").getBoundingClientRect();
    const at = scene?.camera.project(place);
    return at && { x: at.x + left, y: at.y + top };
  },
  hello: () => hello,
  picture: () => shown.picture,
  handPlane: () => scene?.handPlane,
  end: () => connection.send({ end: true }),
};
