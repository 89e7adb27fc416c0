// The buttons of the partner's hand: grips, gestures, and hiding it. Keys do the same.

/** Who presses for a shorter time, ms, wants the gesture to stay; who presses longer holds it out meanwhile. */
const TAP = 350;

export class HandButtons {
  #partner;
  #grips;
  /** What the empty hand can show, by what stands for it in the hand: the index of a gesture, or "pointing". */
  #shows;
  /** When a gesture began to be held, and whether it stood before. */
  #began = null;

  constructor(partner, { grips, gestures, pointing }) {
    this.#partner = partner;
    this.#grips = grips;
    this.#shows = [...gestures.keys(), ...(pointing ? ["pointing"] : [])];
    const words = ({ name }) => (name === "top" ? "from above" : name === "side" ? "from the side" : name);
    const gripButtons = grips.map((grip, index) => made(`grip-${index}`, words(grip), `${index + 1}`));
    gripButtons.forEach((button, index) => button.addEventListener("click", () => this.#partner.grip(index)));
    const key = (shown) => ({ 0: "g", pointing: "f" })[shown] ?? `${grips.length + shown + 1}`;
    const gestureButtons = this.#shows.map((shown) => made(`gesture-${shown}`, gestures[shown]?.name ?? "point", key(shown)));
    gestureButtons.forEach((button, index) => this.#listen(button, this.#shows[index]));
    document.getElementById("grips").replaceChildren(...gripButtons);
    document.getElementById("gestures").replaceChildren(...gestureButtons);
    document.getElementById("hide").addEventListener("click", () => this.#partner.hide());
    this.mark();
  }

  #listen(button, shown) {
    button.addEventListener("pointerdown", () => this.hold(shown, true));
    for (const kind of ["pointerup", "pointercancel", "pointerleave"]) button.addEventListener(kind, () => this.hold(shown, false));
    // Keys give clicks that no pointer has made.
    button.addEventListener("click", ({ detail }) => {
      if (detail === 0) this.#toggle(shown);
    });
  }

  #toggle(shown) {
    this.#partner.gesture(this.#partner.hand.gesture === shown ? null : shown);
  }

  /** The button or key of what the hand can show goes down or up. */
  hold(shown, down) {
    if (!this.#shows.includes(shown)) return;
    if (down) {
      this.#began = { at: performance.now(), stood: this.#partner.hand.gesture === shown };
      this.#partner.gesture(shown);
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
    else if (this.#shows.includes(gesture)) this.#toggle(gesture);
    else return false;
    return true;
  }

  mark() {
    const { hand, hides } = this.#partner;
    this.#grips.forEach((_, index) => pressed(`grip-${index}`, hand.gesture === null && hand.grip === index));
    this.#shows.forEach((shown) => pressed(`gesture-${shown}`, hand.gesture === shown));
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
