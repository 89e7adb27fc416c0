// The partner's hand: pointer, touch, pen or keys say where it is on the table and whether it closes. Nothing else is sent.

const EVERY = 1000 / 60;
/** How fast the arrow keys move the hand, m/s. */
const BY_KEYS = 0.35;
/** How far a turn of the wheel lifts the hand, m. */
const LIFT = 0.02;

export class Partner {
  /**
   * @param scene the scene, whose plane the pointer moves on
   * @param connection where it is sent
   * @param {object} hello what the server has told first
   */
  constructor(scene, connection, hello) {
    Object.assign(this, { scene, connection });
    this.plays = false;
    this.hand = { x: hello.task.scene.person_rest[0] + 0.14, y: hello.task.scene.person_rest[1], lift: 0, pressed: false, grip: 0, gesture: null };
    this.present = false;
    this.keys = new Set();
    this.grips = hello.task.grips;
    this.gestures = hello.task.gestures;
    const { canvas } = scene;
    canvas.addEventListener("pointerdown", (event) => this.plays && event.button === 0 && this.#press(event));
    canvas.addEventListener("pointermove", (event) => this.plays && !(event.buttons & 2) && this.#move(event));
    canvas.addEventListener("pointerup", (event) => event.button === 0 && (this.hand.pressed = false));
    canvas.addEventListener("pointercancel", () => (this.hand.pressed = false));
    canvas.addEventListener("pointerleave", (event) => event.pointerType === "mouse" && !this.hand.pressed && this.hide());
    addEventListener("keydown", (event) => this.#key(event, true));
    addEventListener("keyup", (event) => this.#key(event, false));
    addEventListener("blur", () => this.keys.clear());
    setInterval(() => this.#tell(), EVERY);
    this.#buttons();
  }

  /** The server has said whether this page is the partner. */
  become(plays) {
    this.plays = plays;
    document.getElementById("hand").hidden = !plays;
    if (!plays) this.hide();
  }

  hide() {
    if (this.present) this.connection.send({ hide: true });
    this.present = false;
    this.hand.pressed = false;
    this.scene.pointer = null;
  }

  /** Raises or lowers the hand. */
  lift(by) {
    this.hand.lift = Math.min(0.4, Math.max(0, this.hand.lift + by * LIFT));
  }

  grip(index) {
    this.hand.gesture = null;
    this.hand.grip = index;
    this.#mark();
  }

  gesture(index) {
    this.hand.gesture = this.hand.gesture === index ? null : index;
    this.#mark();
  }

  #buttons() {
    const make = (id, text, key, act) => {
      const button = Object.assign(document.createElement("button"), { id, textContent: `${text} ` });
      button.append(Object.assign(document.createElement("kbd"), { textContent: key }));
      button.addEventListener("click", act);
      return button;
    };
    document.getElementById("grips").replaceChildren(
      ...this.grips.map(({ name }, index) => make(`grip-${index}`, `from ${name === "top" ? "above" : `the ${name}`}`, String(index + 1), () => this.grip(index))));
    document.getElementById("gestures").replaceChildren(
      ...this.gestures.map(({ name }, index) => make(`gesture-${index}`, name, index === 0 ? "g" : `g ${index + 1}`, () => this.gesture(index))));
    document.getElementById("hide").addEventListener("click", () => this.hide());
    this.#mark();
  }

  #mark() {
    this.grips.forEach((_, index) => pressed(`grip-${index}`, this.hand.gesture === null && this.hand.grip === index));
    this.gestures.forEach((_, index) => pressed(`gesture-${index}`, this.hand.gesture === index));
  }

  #move({ offsetX, offsetY }) {
    const place = this.scene.camera.placeAt(offsetX, offsetY, this.scene.handPlane);
    if (!place || Math.hypot(place[0], place[1]) > 3) return;
    [this.hand.x, this.hand.y] = place;
    this.present = true;
  }

  #press(event) {
    this.scene.canvas.setPointerCapture(event.pointerId);
    this.#move(event);
    this.hand.pressed = true;
  }

  #key(event, down) {
    if (/^(INPUT|SELECT|TEXTAREA)$/.test(event.target.tagName) || event.ctrlKey || event.metaKey || event.altKey) return;
    const onScene = event.target === this.scene.canvas || event.target === document.body;
    if (!this.plays || !onScene) return;
    const arrow = ["ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight"].includes(event.key);
    if (arrow) down ? this.keys.add(event.key) : this.keys.delete(event.key);
    if (event.key === " " && !event.repeat) this.hand.pressed = down ? !this.hand.pressed : this.hand.pressed;
    if (arrow || event.key === " ") {
      this.present = true;
      event.preventDefault();
    }
    if (!down || event.repeat) return;
    const number = Number(event.key) - 1;
    if (this.grips[number]) this.grip(number);
    if (event.key === "g") this.gesture(0);
    if (event.key === "h") this.hide();
  }

  /** Sends where the hand is; keys have moved it since. Forward is away from the person, who looks along x. */
  #tell() {
    const along = (plus, minus) => (this.keys.has(plus) ? 1 : 0) - (this.keys.has(minus) ? 1 : 0);
    const step = (BY_KEYS * EVERY) / 1000;
    this.hand.x += step * along("ArrowUp", "ArrowDown");
    this.hand.y += step * along("ArrowLeft", "ArrowRight");
    if (!this.plays || !this.present) return;
    const { x, y, lift, pressed: closes, grip, gesture } = this.hand;
    this.scene.pointer = [x, y, this.scene.handPlane];
    this.connection.send({ pointer: { x, y, lift, pressed: closes, grip, gesture } });
  }
}

function pressed(id, is) {
  document.getElementById(id)?.setAttribute("aria-pressed", String(is));
}
