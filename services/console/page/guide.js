// The first round: one thing after another, each until it has happened. It can be skipped, and hides nothing.

/** Title, words, what has to happen, and which panel is opened with it. */
const STEPS = [
  ["Build with the robot", "You sit at the near edge of the table, the robot opposite. The tab “plan” lists what you build together, in which order, and which side each of you does. Press “be the partner”.", ({ plays }) => plays, "plan"],
  ["Your hand", "Move the pointer over the table, or use the arrow keys: your hand follows. Move it over one of your parts, on your side of the table.", ({ nearPart }) => nearPart],
  ["“I do it myself”", "A hand that comes from above says: I put this in myself. Press on a part of yours whose place is outlined, and keep pressed. Watch the mind: the robot should know before you have grasped.", ({ grasps }) => grasps > 0, "mind"],
  ["Carry it", "Keep pressed, go to the outlined place of the same colour, and let go. The robot holds the base steady for you.", ({ achieved }) => achieved > 0],
  ["“Take this” and “give me”", "A hand from the side says: I hand it over. Choose “from the side”, press on a part that the robot needs, hold it over the middle. The open hand over the middle says: give me what I need; a finger that points says which.", ({ grasps, asks }) => grasps > 1 || asks],
  ["Err, hide, ask", "Take what is not due, and the robot tells you. Hide your hand, and it makes do. Click anything in the mind, and it says why. The line of time below brings everything back. Now build as you like.", () => false],
];

export class Guide {
  #step = 0;
  #open;
  #seen = { plays: false, nearPart: false, grasps: 0, achieved: 0, asks: false };

  /** @param open opens the panel of this name */
  constructor(open) {
    this.#open = open;
    document.getElementById("guide-next").addEventListener("click", () => this.#go(this.#step + 1));
    document.getElementById("guide-skip").addEventListener("click", () => this.end());
    this.#go(0);
  }

  /** What has happened since: any of `plays`, `nearPart`, `grasps`, `achieved`, `asks`. */
  saw(news) {
    Object.assign(this.#seen, news);
    let step = this.#step;
    while (step < STEPS.length && STEPS[step][2](this.#seen)) step += 1;
    if (step !== this.#step) this.#go(step);
  }

  end() {
    this.#go(STEPS.length);
  }

  #go(step) {
    this.#step = step;
    document.getElementById("guide").hidden = step >= STEPS.length;
    if (step >= STEPS.length) return;
    const [title, words, , panel] = STEPS[step];
    document.getElementById("guide-title").textContent = `${step + 1} of ${STEPS.length}: ${title}`;
    document.getElementById("guide-text").textContent = words;
    document.getElementById("guide-next").textContent = step + 1 < STEPS.length ? "go on" : "done";
    document.getElementById("guide-skip").hidden = step + 1 === STEPS.length;
    if (panel) this.#open(panel);
  }
}
