// The scene in three dimensions: table, robot, parts and person, and what the robot plans and expects.

import { Camera } from "./camera.js";
import { fitted } from "./canvas.js";
import { BLUE, GREEN, GREY, ORANGE, PURPLE, VERMILION, kindColour, resolved, rgb } from "./colours.js";
import { Forms } from "./forms.js";
import { placeAt } from "./picture.js";
import { add } from "./vectors.js";

/** How thick a person's upper arm, forearm and hand are drawn, m. */
const LIMBS = [0.045, 0.036, 0.026];
/** Bones between keypoints: from, to. */
const BONES = [[0, 1], [1, 2], [2, 3], [3, 5], [3, 8], [5, 6], [3, 7], [3, 4]];
/** Of a person who may be farther away than this nothing but that is drawn, m. */
const UNCERTAIN = 0.05;
const UPRIGHT = [0, 0, 0, 1];

export class Scene {
  /** @param {object} hello what the server has told first */
  constructor(canvas, labels, hello) {
    this.canvas = canvas;
    this.labels = labels;
    this.hello = hello;
    this.gl = canvas.getContext("webgl2", { antialias: true, alpha: false, powerPreference: "low-power" });
    this.forms = this.gl && new Forms(this.gl);
    const { table } = hello.task.scene;
    this.camera = new Camera([table.centre[0] + 0.08, table.centre[1], table.height + 0.1]);
    this.shows = { truth: false, raw: false };
    /** Height of the plane on which a pointer moves a hand, m. */
    this.handPlane = table.height + 0.08;
    /** Where the partner's pointer is, on that plane. */
    this.pointer = null;
    this.colours();
  }

  /** Takes the page's colours anew. */
  colours() {
    const numbers = (name) => resolved(name).match(/[\d.]+/g).slice(0, 3).map((value) => value / 255);
    [this.back, this.ink] = [numbers("--back"), resolved("--ink")];
    this.table = this.back.map((value) => 0.25 * value + (this.back[0] > 0.5 ? 0.62 : 0.22));
  }

  /** @param {object} picture what `readPicture` gives; `achieved` says of each subgoal whether it is */
  draw(picture, achieved) {
    if (!this.forms) return this.#unable();
    const { gl, camera, canvas } = this;
    const ratio = Math.min(devicePixelRatio || 1, 1.5);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    const [dots, rows] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (canvas.width !== dots || canvas.height !== rows) [canvas.width, canvas.height] = [dots, rows];
    camera.size = [width, height];
    gl.viewport(0, 0, dots, rows);
    gl.clearColor(...this.back, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    const words = [];
    this.#putWorkplace(achieved);
    this.#putRobot(picture);
    this.#putParts(picture, words);
    this.#putPerson(picture);
    this.#putThoughts(picture, words);
    const matrix = camera.matrix;
    this.forms.draw(matrix);
    this.#write(words, matrix);
  }

  #unable() {
    const { context, width, height } = fitted(this.labels);
    context.fillStyle = this.ink;
    context.textAlign = "center";
    context.fillText("this browser draws no three dimensions (WebGL 2); everything else works", width / 2, height / 2);
  }

  #putWorkplace(achieved) {
    const { forms } = this;
    const { scene, subgoals, kinds } = this.hello.task;
    const [across, along] = scene.table.size;
    const table = [scene.table.centre[0], scene.table.centre[1], scene.table.height - 0.03];
    forms.shape({ box: [across, along, 0.03] }, table, UPRIGHT, this.table);
    const { at, radius, height } = scene.platform;
    forms.shape({ cylinder: { radius, height } }, at, UPRIGHT, rgb("#a58a6a"));
    forms.rod([at[0], at[1], scene.table.height], at, 0.02, rgb("#8a7358"));
    subgoals.forEach(({ kind, socket }, index) => {
      if (achieved[index]) return;
      forms.shape(kinds[kind].shape, socket.at, turnTo(socket.axis), rgb(kindColour(kind)), 0.16);
    });
  }

  #putRobot({ links, state }) {
    const colour = rgb(state.stopped ? VERMILION : "#7b8796");
    for (let index = 0; index < links.length; index += 7) {
      const [from, to] = [placeAt(links, index), placeAt(links, index + 3)];
      if (from && to) this.forms.capsule(from, to, links[index + 6], colour);
    }
  }

  #putParts({ parts }, words) {
    const { kinds } = this.hello.task;
    for (let index = 0; index < parts.length; index += 9) {
      const [kind, place] = [kinds[parts[index]], placeAt(parts, index + 1)];
      if (!kind || !place) continue;
      const turn = [parts[index + 4], parts[index + 5], parts[index + 6], parts[index + 7]];
      this.forms.shape(kind.shape, place, turn, rgb(kindColour(parts[index])));
      words.push({ text: kind.name, place: add(place, [0, 0, (kind.shape.cylinder?.height ?? kind.shape.box[2]) + 0.03]) });
    }
  }

  #putPerson({ arm, truth, keypoints, state }) {
    const { forms, shows } = this;
    const points = [0, 1, 2, 3].map((index) => placeAt(arm, 5 * index));
    const seen = !state.hidden;
    for (let limb = 0; limb < 3; limb += 1) {
      const [from, to] = [points[limb], points[limb + 1]];
      if (from && to) forms.capsule(from, to, LIMBS[limb], rgb(ORANGE), seen ? 1 : 0.3);
    }
    points.forEach((place, index) => {
      const radius = arm[5 * index + 3];
      if (place && radius > UNCERTAIN) forms.ball(place, Math.min(radius, 1.2), rgb(ORANGE), 0.08);
    });
    if (shows.truth) {
      const true_ = [0, 1, 2, 3].map((index) => placeAt(truth, 3 * index));
      for (let limb = 0; limb < 3; limb += 1) {
        if (true_[limb] && true_[limb + 1]) forms.capsule(true_[limb], true_[limb + 1], 0.012, rgb(GREEN));
      }
    }
    if (shows.raw) {
      const raw = Array.from({ length: 9 }, (_, index) => (keypoints[4 * index + 3] > 0 ? placeAt(keypoints, 4 * index) : null));
      for (const [from, to] of BONES) if (raw[from] && raw[to]) forms.rod(raw[from], raw[to], 0.004, rgb(PURPLE));
      raw.filter(Boolean).forEach((place) => forms.ball(place, 0.009, rgb(PURPLE)));
    }
    if (this.pointer) {
      forms.rod(this.pointer, add(this.pointer, [0, 0, -0.075]), 0.004, rgb(BLUE), 0.7);
      forms.ball(this.pointer, 0.012, rgb(BLUE), 0.7);
    }
  }

  /** The way that is planned, where the person is expected, and how near the two are. */
  #putThoughts({ path, nearest, expected }, words) {
    const { forms } = this;
    let before = null;
    for (let index = 0; index < path.length; index += 3) {
      const place = placeAt(path, index);
      if (before && place) forms.rod(before, place, 0.005, rgb(BLUE), 0.75);
      before = place;
    }
    if (before) forms.ball(before, 0.014, rgb(BLUE), 0.75);
    const place = placeAt(expected, 0);
    if (place) {
      forms.ball(add(place, [0, 0, 0.03]), 0.07, rgb(PURPLE), 0.15 + 0.25 * Math.min(Math.max(expected[3], 0), 1));
      words.push({ text: "expected here", place: add(place, [0, 0, 0.13]), strong: true });
    }
    const [from, to] = [placeAt(nearest, 0), placeAt(nearest, 3)];
    if (from && to && nearest[6] < 0.6) {
      const near = nearest[6] < 0.1;
      forms.rod(from, to, 0.003, rgb(near ? VERMILION : GREY), 0.9);
      const middle = from.map((value, axis) => (value + to[axis]) / 2);
      words.push({ text: `${Math.max(0, Math.round(nearest[6] * 1000))} mm`, place: middle, strong: near });
    }
  }

  #write(words, matrix) {
    const { context } = fitted(this.labels);
    context.textAlign = "center";
    context.lineJoin = "round";
    for (const { text, place, strong } of words) {
      const at = this.camera.project(place, matrix);
      if (!at) continue;
      context.font = `${strong ? "600 " : ""}14px system-ui, sans-serif`;
      context.strokeStyle = `rgb(${this.back.map((value) => value * 255)})`;
      context.lineWidth = 4;
      context.strokeText(text, at.x, at.y);
      context.fillStyle = this.ink;
      context.fillText(text, at.x, at.y);
    }
  }
}

/** The quaternion that turns the z axis to this direction. */
function turnTo([x, y, z]) {
  if (z < -0.9999) return [1, 0, 0, 0];
  const w = 1 + z;
  const length = Math.hypot(-y, x, w);
  return [-y / length, x / length, 0, w / length];
}
