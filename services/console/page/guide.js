// The first round: one thing after another, each until it has happened. It can be skipped, and hides nothing.

const STEPS = [
  ["Build with the robot", "You sit at the lower edge of the table, the robot stands opposite. Together you put together what the plan lists (its tab is on the right): each side can be reached by one of you only. Press “be the partner”.", ({ plays }) => plays],
  ["Your hand", "Move the pointer over the table: your hand follows. With the arrow keys it goes as well. Move it over one of your parts, on your side of the table.", ({ nearPart }) => nearPart],
  ["I do it myself", "A hand that comes from above says: I put this in myself. Press over a part of yours that is due, carry it to its place, which glows, and let go there. Watch the robot: it should know before you have grasped.", ({ grasps }) => grasps > 0],
  ["Carry it", "Keep the button down, go to the place that glows in the part's colour, and let go. The robot holds the base steady for you.", ({ achieved }) => achieved > 0],
  ["Take this", "A hand that comes from the side says: I give it to you. Choose “from the side” (key 2), press on a part that the robot needs, and hold it over the middle of the table until the robot has it. Or ask for one: the open hand (key g) over the middle.", ({ grasps, asks }) => grasps > 1 || asks],
  ["Err, hide, ask", "You may take what is not due, and the robot says so. You may hide your hand (key h), and it waits. Choose a population of the mind, and it says why it stands. The line of time below brings everything back.", () => false],
];

export class Guide {
  #step = 0;
  #seen = { plays: false, nearPart: false, grasps: 0, achieved: 0, asks: false };

  constructor() {
    this.card = document.getElementById("guide");
    document.getElementById("guide-next").addEventListener("click", () => this.#go(this.#step + 1));
    document.getElementById("guide-skip").addEventListener("click", () => this.#go(STEPS.length));
    this.#go(0);
  }

  /** What has happened since: any of `plays`, `nearPart`, `grasps`, `achieved`, `asks`. */
  saw(news) {
    Object.assign(this.#seen, news);
    while (this.#step < STEPS.length && STEPS[this.#step][2](this.#seen)) this.#go(this.#step + 1);
  }

  #go(step) {
    this.#step = step;
    this.card.hidden = step >= STEPS.length;
    if (step >= STEPS.length) return;
    document.getElementById("guide-title").textContent = STEPS[step][0];
    document.getElementById("guide-text").textContent = STEPS[step][1];
    document.getElementById("guide-next").textContent = step + 1 < STEPS.length ? "go on" : "done";
  }
}
