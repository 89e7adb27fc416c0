// The partner's hand: pointer, touch, pen or keys say where it is on the table and whether it closes. Nothing else is sent.

import { HandButtons } from "./hand-buttons.js";

/** How often the hand is told of, ms: 60 times a second; and how soon after the last time when the pointer moves. */
const EVERY = 16, SOONEST = 8;
/** How fast the arrow keys move the hand, m/s. */
const BY_KEYS = 0.35;
/** How far a turn of the wheel lifts the hand, and how high at most, m. */
const LIFT = 0.02, HIGHEST = 0.4;
/** A hand gets no farther from the robot's foot, m. */
const FARTHEST = 3;
const ARROWS = ["ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight"];

export class Partner {
  /**
   * @param scene the scene, whose plane the pointer moves on
   * @param connection where it is sent
   * @param {object} hello what the server has told first
   */
  constructor(scene, connection, hello) {
    Object.assign(this, { scene, connection });
    this.plays = false;
    const [x, y] = hello.task.scene.person_rest;
    this.hand = { x: x + 0.14, y, lift: 0, pressed: false, grip: 0, gesture: null };
    /** Whether it is over the table, and can be seen. */
    this.present = false;
    /** It was hidden on purpose, and comes back when it is called, or pressed. */
    this.hides = false;
    /** While the page shows the past, the hand stays where it is. */
    this.looksBack = false;
    this.keys = new Set();
    this.told = performance.now();
    this.buttons = new HandButtons(this, hello.task);
    this.#listen(scene.canvas);
    setInterval(() => this.#tell(), EVERY);
  }

  #listen(canvas) {
    const isMine = (event) => this.plays && !this.looksBack && !event.altKey && !(event.buttons & 2);
    canvas.addEventListener("pointerdown", (event) => {
      if (!isMine(event)) return;
      // A second finger turns and zooms: the hand lets go of nothing that it has not, and takes nothing.
      if (!event.isPrimary) this.hand.pressed = false;
      else if (event.button === 0) this.#press(event);
    });
    // A browser that knows the first tells of the pointer at once, not with its next frame.
    for (const moves of ["pointerrawupdate", "pointermove"]) {
      canvas.addEventListener(moves, (event) => isMine(event) && event.isPrimary && this.#move(event));
    }
    canvas.addEventListener("pointerup", (event) => event.button === 0 && (this.hand.pressed = false));
    canvas.addEventListener("pointercancel", () => (this.hand.pressed = false));
    // Leaving the scene as a whole hides the hand; the buttons that lie over it are no way out.
    canvas.parentElement.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && !this.hand.pressed && this.#leave());
    addEventListener("keydown", (event) => this.#key(event, true));
    addEventListener("keyup", (event) => this.#key(event, false));
    addEventListener("blur", () => this.keys.clear());
  }

  /** The server has said whether this page is the partner. */
  become(plays) {
    this.plays = plays;
    document.getElementById("hand").hidden = !plays;
    this.hides = false;
    if (!plays) this.#leave();
    this.buttons.mark();
  }

  /** Hides the hand, or shows it again. */
  hide(hides = !this.hides) {
    this.hides = hides;
    if (hides) this.#leave();
    else this.present = true;
    this.buttons.mark();
  }

  #leave() {
    if (this.present) this.connection.send({ hide: true });
    this.present = false;
    this.hand.pressed = false;
    this.scene.pointer = null;
  }

  /** Raises or lowers the hand. */
  lift(by) {
    this.hand.lift = Math.min(HIGHEST, Math.max(0, this.hand.lift + by * LIFT));
  }

  grip(index) {
    this.hand.gesture = null;
    this.hand.grip = index;
    this.buttons.mark();
  }

  /** @param {number | "pointing" | null} shown the gesture that is held out, pointing to where the pointer is, or neither */
  gesture(shown) {
    this.hand.gesture = shown;
    this.buttons.mark();
  }

  #move(event) {
    this.#follow(event);
    // A hand that was away while the line was lost still closes on what the button has been pressed on.
    if (event.pointerType === "mouse" && event.buttons & 1 && this.scene.canvas.hasPointerCapture(event.pointerId)) this.hand.pressed = true;
    if (performance.now() - this.told >= SOONEST) this.#tell();
  }

  /** Puts the hand where the pointer is, if that is over the table. */
  #follow({ offsetX, offsetY }) {
    const place = this.scene.camera.placeAt(offsetX, offsetY, this.scene.handPlane);
    if (!place || Math.hypot(place[0], place[1]) > FARTHEST) return;
    [this.hand.x, this.hand.y] = place;
    if (!this.hides) this.present = true;
  }

  #press(event) {
    this.scene.canvas.setPointerCapture(event.pointerId);
    if (this.hides) this.hide(false);
    this.#follow(event);
    this.hand.pressed = true;
    this.#tell();
  }

  #key(event, down) {
    if (ARROWS.includes(event.key) && !down) this.keys.delete(event.key);
    const onScene = event.target === this.scene.canvas || event.target === document.body;
    if (!this.plays || this.looksBack || !onScene || event.ctrlKey || event.metaKey || event.altKey) return;
    if (ARROWS.includes(event.key) && down) this.keys.add(event.key);
    if (event.key === " " && down && !event.repeat) this.hand.pressed = !this.hand.pressed;
    if (down && (ARROWS.includes(event.key) || event.key === " ")) {
      if (this.hides) this.hide(false);
      this.present = true;
      event.preventDefault();
    }
    if (event.repeat) return;
    if (event.key === "g") this.buttons.hold(0, down);
    if (event.key === "f") this.buttons.hold("pointing", down);
    if (!down) return;
    if (this.buttons.choose(Number(event.key) - 1)) return;
    if (event.key === "h") this.hide();
    if (event.key === "PageUp") this.lift(1);
    if (event.key === "PageDown") this.lift(-1);
  }

  /** Moves the hand as the arrow keys say: along the edges of the table, forward as the scene is seen. */
  #go(seconds) {
    const along = (plus, minus) => (this.keys.has(plus) ? 1 : 0) - (this.keys.has(minus) ? 1 : 0);
    const [forward, left] = [along("ArrowUp", "ArrowDown"), along("ArrowLeft", "ArrowRight")];
    if (!forward && !left) return;
    const towards = Math.round((this.scene.camera.azimuth + Math.PI) / (Math.PI / 2)) * (Math.PI / 2);
    const [x, y] = [Math.cos(towards), Math.sin(towards)];
    const step = BY_KEYS * seconds;
    this.hand.x += step * (forward * x - left * y);
    this.hand.y += step * (forward * y + left * x);
  }

  #tell() {
    const now = performance.now();
    // A page in the background is called rarely: its hand does not leap.
    this.#go(Math.min(0.05, (now - this.told) / 1000));
    this.told = now;
    if (!this.plays || !this.present) return;
    const { x, y, lift, pressed, grip, gesture: shown } = this.hand;
    const pointing = shown === "pointing";
    const gesture = pointing ? null : shown;
    this.scene.pointer = { at: [x, y, this.scene.handPlane + lift], closes: pressed };
    this.connection.send({ pointer: { x, y, lift, pressed, grip, gesture, pointing } });
  }
}
