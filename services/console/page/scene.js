// The scene in three dimensions: table, robot, parts and person, and what the robot plans and expects.

import { Camera } from "./camera.js";
import { BLUE, GREEN, GREY, ORANGE, PURPLE, VERMILION, kindColour, resolved, rgb } from "./colours.js";
import { Forms } from "./forms.js";
import { edges } from "./outline.js";
import { placeAt } from "./picture.js";
import { Sharpness, drawsByCard } from "./sharpness.js";
import { add, axes, scale } from "./vectors.js";
import { Words } from "./words.js";

/** How thick a person's upper arm, forearm and hand are drawn, m. */
const LIMBS = [0.04, 0.032, 0.02];
/** Bones between keypoints: from, to. */
const BONES = [[0, 1], [1, 2], [2, 3], [3, 5], [3, 8], [5, 6], [3, 7], [3, 4]];
/** Of a person who may be farther away than this nothing but that is drawn, m. */
const UNCERTAIN = 0.05;
/** Who holds a part that something covers: it was there when it was seen last. */
const COVERED = 3;
const UPRIGHT = [0, 0, 0, 1];

export class Scene {
  /** @param {object} hello what the server has told first */
  constructor(canvas, labels, hello) {
    this.canvas = canvas;
    this.words = new Words(labels);
    this.hello = hello;
    this.gl = canvas.getContext("webgl2", { antialias: drawsByCard(), alpha: false, powerPreference: "low-power" });
    this.forms = this.gl && new Forms(this.gl);
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.forms = null;
    });
    canvas.addEventListener("webglcontextrestored", () => (this.forms = new Forms(this.gl)));
    const { table } = hello.task.scene;
    this.camera = new Camera([table.centre[0] + 0.08, table.centre[1], table.height + 0.1]);
    this.sharpness = new Sharpness();
    this.shows = { truth: false, raw: false };
    /** Height of the plane on which a pointer moves a hand, m. */
    this.handPlane = table.height + 0.08;
    /** Where the partner's pointer is, `at` a place on that plane, and whether its hand `closes`. */
    this.pointer = null;
    this.colours();
  }

  /** Takes the page's colours anew. */
  colours() {
    const numbers = (name) => resolved(name).match(/[\d.]+/g).slice(0, 3).map((value) => value / 255);
    this.back = numbers("--back");
    this.table = this.back.map((value) => 0.25 * value + (this.back[0] > 0.5 ? 0.62 : 0.22));
  }

  /** Shows nothing but the page's ground: a canvas that was never drawn is black. */
  clear() {
    this.gl?.clearColor(...this.back, 1);
    this.gl?.clear(this.gl.COLOR_BUFFER_BIT);
  }

  /** @param {object} picture what `readPicture` gives; `states` says of each subgoal whether it is "done", "open", "later" or "spared" */
  draw(picture, states) {
    if (this.canvas.clientWidth === 0) return;
    if (!this.forms) return this.words.say("This browser draws no three dimensions (WebGL 2). Everything else works.");
    const { gl, camera, canvas } = this;
    const ratio = this.sharpness.ratio;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    const [dots, rows] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (canvas.width !== dots || canvas.height !== rows) [canvas.width, canvas.height] = [dots, rows];
    camera.size = [width, height];
    gl.viewport(0, 0, dots, rows);
    gl.clearColor(...this.back, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    const words = [];
    this.#putWorkplace(states);
    this.#putRobot(picture);
    this.#putParts(picture, words);
    this.#putPerson(picture);
    this.#putPointer();
    this.#putDestinations(picture);
    this.#putThoughts(picture, words);
    const matrix = camera.matrix;
    this.forms.draw(matrix);
    this.words.show(words, (place) => camera.project(place, matrix));
  }

  #putWorkplace(states) {
    const { forms } = this;
    const { scene, subgoals, kinds } = this.hello.task;
    const [across, along] = scene.table.size;
    const table = [scene.table.centre[0], scene.table.centre[1], scene.table.height - 0.03];
    forms.shape({ box: [across, along, 0.03] }, table, UPRIGHT, this.table);
    const { at, radius, height } = scene.platform;
    forms.shape({ cylinder: { radius, height } }, at, UPRIGHT, rgb("#a58a6a"));
    forms.rod([at[0], at[1], scene.table.height], at, 0.02, rgb("#8a7358"));
    subgoals.forEach(({ kind, socket }, index) => {
      if (states[index] === "done" || !kinds[kind]) return;
      const [turn, colour] = [turnTo(socket.axis), rgb(kindColour(kind))];
      forms.shape(kinds[kind].shape, socket.at, turn, colour, states[index] === "open" ? 0.3 : 0.08);
      if (states[index] === "open") this.#putOutline(kinds[kind].shape, socket.at, axes(turn), colour);
    });
  }

  #putOutline(shape, at, [x, y, z], colour) {
    const placed = ([u, v, w]) => at.map((value, axis) => value + u * x[axis] + v * y[axis] + w * z[axis]);
    for (const [from, to] of edges(shape)) this.forms.rod(placed(from), placed(to), 0.0016, colour);
  }

  /** A shadow straight below tells how high something is, and over what. */
  #putShadow([x, y], radius) {
    const { table } = this.hello.task.scene;
    const onTable = Math.abs(x - table.centre[0]) < table.size[0] / 2 && Math.abs(y - table.centre[1]) < table.size[1] / 2;
    if (onTable) this.forms.shape({ cylinder: { radius, height: 0.001 } }, [x, y, table.height + 0.001], UPRIGHT, [0, 0, 0], 0.28);
  }

  #putRobot({ robot, state }) {
    const colour = rgb(state.stopped ? VERMILION : "#7b8796");
    this.hello.robot.forEach((form, index) => {
      const place = placeAt(robot, 7 * index);
      if (place) this.forms.centred(form, place, robot.subarray(7 * index + 3, 7 * index + 7), colour);
    });
  }

  #putParts({ parts }, words) {
    const { kinds } = this.hello.task;
    for (let index = 0; index < parts.length; index += 9) {
      const [kind, place] = [kinds[parts[index]], placeAt(parts, index + 1)];
      if (!kind || !place) continue;
      const turn = [parts[index + 4], parts[index + 5], parts[index + 6], parts[index + 7]];
      this.forms.shape(kind.shape, place, turn, rgb(kindColour(parts[index])), parts[index + 8] === COVERED ? 0.4 : 1);
      const high = kind.shape.cylinder?.height ?? kind.shape.box?.[2] ?? 0;
      words.push({ text: kind.name, place: add(place, scale([0, 0, 1], high + 0.03)) });
      if (parts[index + 8] > 0 && parts[index + 8] < COVERED) this.#putShadow(place, 0.025);
    }
  }

  #putPerson({ arms, truth, keypoints, state }) {
    for (const side of [0, 1]) {
      const own = (numbers) => numbers.subarray((numbers.length / 2) * side, (numbers.length / 2) * (side + 1));
      this.#putArm(own(arms), own(truth), own(keypoints), !state.hidden);
    }
  }

  #putArm(arm, truth, keypoints, seen) {
    const { forms, shows } = this;
    const points = [0, 1, 2, 3].map((index) => placeAt(arm, 5 * index));
    if (points[3]) this.#putShadow(points[3], 0.02);
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
  }

  /** Where the partner's pointer is: a ring on the table, that is narrow while the fingers are to close. */
  #putPointer() {
    if (!this.pointer) return;
    const { at: [x, y, z], closes } = this.pointer;
    const height = this.hello.task.scene.table.height + 0.004;
    for (const [from, to] of edges({ cylinder: { radius: closes ? 0.02 : 0.045, height: 0 } })) {
      if (from[2] === to[2]) this.forms.rod([x + from[0], y + from[1], height], [x + to[0], y + to[1], height], 0.003, rgb(BLUE));
    }
    this.forms.rod([x, y, height], [x, y, z], 0.002, rgb(BLUE), 0.7);
    this.forms.ball([x, y, z], closes ? 0.009 : 0.013, rgb(BLUE), 0.8);
  }

  /** Where the mind holds that the hand may be going: a pale site is only preshaped, at a strong one a peak stands. */
  #putDestinations({ destinations }) {
    const { table } = this.hello.task.scene;
    for (let index = 0; index < destinations.length; index += 3) {
      const [x, y, activity] = [destinations[index], destinations[index + 1], destinations[index + 2]];
      if (!Number.isFinite(x)) break;
      const strength = 0.08 + 0.5 * Math.min(Math.max(activity + 0.5, 0), 1);
      this.forms.shape({ cylinder: { radius: 0.011, height: 0.001 } }, [x, y, table.height + 0.002], UPRIGHT, rgb(PURPLE), strength);
    }
  }

  /** The way that is planned, where the person is expected, and how near the two are. */
  #putThoughts({ path, nearest, expected }, words) {
    const { forms } = this;
    let before = null;
    for (let index = 0; index < path.length; index += 3) {
      const place = placeAt(path, index);
      if (before && place) forms.rod(before, place, 0.005, rgb(BLUE), 0.75);
      if (place) before = place;
    }
    if (before) {
      forms.ball(before, 0.014, rgb(BLUE), 0.75);
      words.push({ text: "goes here", place: add(before, [0, 0, 0.03]) });
    }
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
}

/** The quaternion that turns the z axis to this direction. */
function turnTo([x, y, z]) {
  if (z < -0.9999) return [1, 0, 0, 0];
  const w = 1 + z;
  const length = Math.hypot(-y, x, w);
  return [-y / length, x / length, 0, w / length];
}
