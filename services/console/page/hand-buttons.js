// The buttons of the partner's hand: grips, gestures, and hiding it. Keys do the same.

/** Who presses for a shorter time, ms, wants the gesture to stay; who presses longer holds it out meanwhile. */
const TAP = 350;

export class HandButtons {
  #partner;
  #grips;
  #gestures;
  /** When a gesture began to be held, and whether it stood before. */
  #began = null;

  constructor(partner, { grips, gestures }) {
    this.#partner = partner;
    this.#grips = grips;
    this.#gestures = gestures;
    const words = ({ name }) => (name === "top" ? "from above" : name === "side" ? "from the side" : name);
    const gripButtons = grips.map((grip, index) => made(`grip-${index}`, words(grip), `${index + 1}`));
    gripButtons.forEach((button, index) => button.addEventListener("click", () => this.#partner.grip(index)));
    const gestureButtons = gestures.map((gesture, index) => made(`gesture-${index}`, gesture.name, index ? `${grips.length + index + 1}` : "g"));
    gestureButtons.forEach((button, index) => this.#listen(button, index));
    document.getElementById("grips").replaceChildren(...gripButtons);
    document.getElementById("gestures").replaceChildren(...gestureButtons);
    document.getElementById("hide").addEventListener("click", () => this.#partner.hide());
    this.mark();
  }

  #listen(button, index) {
    button.addEventListener("pointerdown", () => this.hold(index, true));
    for (const kind of ["pointerup", "pointercancel", "pointerleave"]) button.addEventListener(kind, () => this.hold(index, false));
    // Keys give clicks that no pointer has made.
    button.addEventListener("click", ({ detail }) => {
      if (detail === 0) this.#partner.gesture(this.#partner.hand.gesture === index ? null : index);
    });
  }

  /** A gesture's button or key goes down or up. */
  hold(index, down) {
    if (!this.#gestures[index]) return;
    if (down) {
      this.#began = { at: performance.now(), stood: this.#partner.hand.gesture === index };
      this.#partner.gesture(index);
    } else if (this.#began) {
      const stays = performance.now() - this.#began.at < TAP && !this.#began.stood;
      if (!stays) this.#partner.gesture(null);
      this.#began = null;
    }
  }

  /** What a number's key stands for: grips first, then gestures; false when it is none. */
  choose(index) {
    const gesture = index - this.#grips.length;
    if (this.#grips[index]) this.#partner.grip(index);
    else if (this.#gestures[gesture]) this.#partner.gesture(this.#partner.hand.gesture === gesture ? null : gesture);
    else return false;
    return true;
  }

  mark() {
    const { hand, hides } = this.#partner;
    this.#grips.forEach((_, index) => pressed(`grip-${index}`, hand.gesture === null && hand.grip === index));
    this.#gestures.forEach((_, index) => pressed(`gesture-${index}`, hand.gesture === index));
    pressed("hide", hides);
  }
}

function made(id, text, key) {
  const button = Object.assign(document.createElement("button"), { id, textContent: `${text} ` });
  button.append(Object.assign(document.createElement("kbd"), { textContent: key }));
  return button;
}

function pressed(id, is) {
  document.getElementById(id)?.setAttribute("aria-pressed", String(is));
}
