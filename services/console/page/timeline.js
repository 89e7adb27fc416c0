// What has happened, on a line of time: choose an instant, and everything else on the page follows.

import { fitted, shortened } from "./canvas.js";
import { BLUE, GREEN, GREY, ORANGE, PURPLE, VERMILION, resolved } from "./colours.js";

/** Lanes from top to bottom: name, and the sorts of event in it. */
const LANES = [
  ["you", ["action"]],
  ["inferred", ["inferred", "error"]],
  ["decided", ["decision"]],
  ["words", ["said", "heard"]],
  ["waits", ["wait"]],
  ["done", ["achieved", "assembly", "forgotten"]],
  ["machine", ["fault", "restart", "alarm", "stopped", "resumed", "blind"]],
];
const COLOURS = {
  action: ORANGE, inferred: PURPLE, error: VERMILION, decision: BLUE, said: BLUE, heard: ORANGE, achieved: GREEN,
  assembly: GREEN, forgotten: GREY, fault: VERMILION, alarm: VERMILION, stopped: VERMILION, restart: GREEN, resumed: GREEN, blind: GREY,
};
/** Who waits has the colour of whoever that is on this line. */
const WAITS = { person: ORANGE, robot: BLUE };
const NAMES = 84, AXIS = 22;

export class Timeline {
  /** @param go called with the cycle that was chosen; `changed` when something else is to be seen of the line */
  constructor(canvas, go, changed) {
    Object.assign(this, { canvas, go, changed });
    this.events = [];
    /** Milliseconds that are shown. */
    this.span = 30_000;
    /** The end of what is shown; null: now. */
    this.end = null;
    this.now = 0;
    /** The instant that the page shows. */
    this.cursor = 0;
    /** What a pressed pointer moves: the cursor, or, below the lanes, what is shown of the time. */
    let held = null;
    const choose = ({ offsetX }) => this.go(Math.max(0, Math.round(this.#time(offsetX))));
    canvas.addEventListener("pointerdown", (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.end ??= this.#end();
      held = event.offsetY > canvas.clientHeight - AXIS ? { time: this.#time(event.offsetX) } : { cursor: true };
      if (!held.cursor) return;
      const near = this.#near(event.offsetX, event.offsetY);
      if (near) this.go(near.at_ms);
      else choose(event);
    });
    canvas.addEventListener("pointermove", (event) => {
      if (held?.cursor) choose(event);
      else if (held) this.#endAt(this.#end() + held.time - this.#time(event.offsetX));
      if (held) this.changed();
    });
    canvas.addEventListener("pointerup", () => (held = null));
    canvas.addEventListener("pointercancel", () => (held = null));
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      const across = event.shiftKey ? event.deltaY || event.deltaX : event.deltaX;
      if (event.shiftKey || Math.abs(across) > Math.abs(event.deltaY)) this.scroll(Math.sign(across) * 0.1);
      else this.zoom(event.deltaY > 0 ? 1.25 : 0.8, event.offsetX);
      this.changed();
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      if (event.key === "ArrowLeft") this.jump(-1);
      else if (event.key === "ArrowRight") this.jump(1);
      else return;
      event.preventDefault();
    });
  }

  add(first, events) {
    this.events.length = Math.min(this.events.length, first);
    this.events.push(...events);
  }

  /** Shows more or less time; what is at `x` stays there, unless the line follows what is new. */
  zoom(factor, x = NAMES + (this.canvas.clientWidth - NAMES) / 2) {
    const fixed = this.#time(x);
    const span = Math.min(3_600_000, Math.max(2_000, this.span * factor));
    if (this.end !== null) this.#endAt(fixed + ((this.#end() - fixed) * span) / this.span);
    this.span = span;
  }

  /** Moves what is shown by a part of its span, later or earlier. */
  scroll(part) {
    this.#endAt(this.#end() + part * this.span);
  }

  /** Shows the whole run. */
  showAll() {
    this.span = Math.max(10_000, this.now * 1.03);
    this.end = this.span;
  }

  /** Brings the cursor into what is shown, when it has left it. */
  follow() {
    const end = this.#end();
    if (this.cursor > end) this.#endAt(this.cursor + 0.8 * this.span);
    else if (this.cursor < end - this.span) this.#endAt(this.cursor + 0.2 * this.span);
  }

  #endAt(end) {
    this.end = Math.max(this.span, Math.min(this.now + this.span * 0.5, end));
  }

  /** To the event after the cursor, or before it. */
  jump(direction) {
    const times = this.events.map(({ at_ms }) => at_ms).sort((a, b) => a - b);
    const found = direction > 0 ? times.find((time) => time > this.cursor + 1) : times.findLast((time) => time < this.cursor - 1);
    if (found === undefined) return;
    this.#endAt(found + this.span / 2);
    this.go(found);
  }

  /** The newest event at the cursor or before it. */
  current() {
    return this.last(() => true);
  }

  /** The newest event of these sorts at the cursor or before it. */
  last(isOne) {
    const before = this.events.filter((event) => event.at_ms <= this.cursor && isOne(event));
    return before.reduce((last, event) => (!last || event.at_ms >= last.at_ms ? event : last), null);
  }

  #end() {
    return this.end ?? Math.max(this.now + this.span * 0.04, this.span);
  }

  #time(x) {
    const width = this.canvas.clientWidth - NAMES;
    return this.#end() - this.span * (1 - (x - NAMES) / width);
  }

  #x(time) {
    return NAMES + (this.canvas.clientWidth - NAMES) * (1 - (this.#end() - time) / this.span);
  }

  #near(x, y) {
    const lane = LANES[Math.floor((y / (this.canvas.clientHeight - AXIS)) * LANES.length)];
    const near = this.events.filter((event) => lane?.[1].includes(event.sort) && Math.abs(this.#x(event.at_ms) - x) < 7);
    return near[near.length - 1];
  }

  draw() {
    if (this.canvas.clientWidth === 0) return;
    const { context, width, height } = fitted(this.canvas);
    const [ink, quiet, line] = [resolved("--ink"), resolved("--quiet"), resolved("--line")];
    const lane = (height - AXIS) / LANES.length;
    context.font = "15px system-ui, sans-serif";
    context.textBaseline = "middle";
    LANES.forEach(([name, sorts], index) => {
      const y = index * lane;
      context.fillStyle = quiet;
      context.textAlign = "left";
      context.fillText(name, 12, y + lane / 2);
      context.fillStyle = line;
      context.fillRect(NAMES, y + lane - 0.5, width - NAMES, 1);
      this.#lane(context, this.events.filter(({ sort }) => sorts.includes(sort)), y, lane, ink);
    });
    this.#axis(context, height - AXIS, width, quiet);
    const x = this.#x(this.cursor);
    if (x >= NAMES) {
      context.fillStyle = ink;
      context.fillRect(x - 1, 0, 2, height - 4);
    }
    this.canvas.setAttribute("aria-valuemax", String(Math.round(this.now)));
    this.canvas.setAttribute("aria-valuenow", String(Math.round(this.cursor)));
    this.canvas.setAttribute("aria-valuetext", `${(this.cursor / 1000).toFixed(1)} seconds`);
  }

  #lane(context, events, y, lane, ink) {
    const sorted = [...events].sort((a, b) => a.at_ms - b.at_ms);
    sorted.forEach((event, index) => {
      const x = this.#x(event.at_ms);
      const next = sorted[index + 1] ? this.#x(sorted[index + 1].at_ms) : this.canvas.clientWidth;
      if (next < NAMES || x > this.canvas.clientWidth) return;
      const until = event.grasp_ms ?? event.until_ms;
      const wide = until ? Math.max(4, this.#x(until) - x) : 4;
      context.save();
      context.beginPath();
      context.rect(NAMES, y, this.canvas.clientWidth - NAMES, lane);
      context.clip();
      context.fillStyle = WAITS[event.who] ?? COLOURS[event.sort] ?? GREY;
      context.fillRect(x, y + 3, wide, lane - 7);
      if (event.sort === "action") this.#understood(context, event, y, lane);
      const room = next - x - wide - 6;
      if (room > 24) {
        context.fillStyle = ink;
        context.fillText(shortened(context, told(event), room), x + wide + 4, y + lane / 2);
      }
      context.restore();
    });
  }

  /** When an action was inferred and answered, within its bar. */
  #understood(context, { inferred_ms, decision_ms, right }, y, lane) {
    const mark = (time, colour, wide) => {
      if (!Number.isFinite(time)) return;
      context.fillStyle = resolved("--card");
      context.fillRect(this.#x(time) - wide / 2 - 1, y + 1, wide + 2, lane - 3);
      context.fillStyle = colour;
      context.fillRect(this.#x(time) - wide / 2, y + 1, wide, lane - 3);
    };
    mark(inferred_ms, PURPLE, 2);
    mark(decision_ms, right === false ? VERMILION : BLUE, 5);
  }

  #axis(context, y, width, quiet) {
    const step = [1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1200].find((seconds) => (seconds * 1000 * (width - NAMES)) / this.span > 70) ?? 3600;
    context.fillStyle = quiet;
    context.textAlign = "center";
    const first = Math.max(0, Math.ceil((this.#end() - this.span) / 1000 / step) * step);
    for (let second = first; second * 1000 <= this.#end(); second += step) {
      const x = this.#x(second * 1000);
      context.fillRect(x, y, 1, 4);
      if (x > NAMES + 14) context.fillText(`${second} s`, x, y + 13);
    }
    context.textAlign = "left";
  }
}

/** An event in words. */
export function told(event) {
  if (event.sort !== "action") return event.text;
  const lead = Number.isFinite(event.lead_ms) ? `, answered ${event.lead_ms} ms before the grasp` : "";
  const wrong = event.right === false ? ", not as it should be" : "";
  const error = event.error ? `, ${event.error}` : "";
  return event.text + lead + wrong + error;
}
