// How punctual the machine is: durations as a table and as percentile curves, and each process with its state.

import { fitted } from "./canvas.js";
import { BLUE, GREEN, GREY, ORANGE, PURPLE, SKY, VERMILION, YELLOW, resolved } from "./colours.js";

const COLOURS = [BLUE, ORANGE, GREEN, VERMILION, PURPLE, SKY, YELLOW, GREY];
/** Every four curves are dashed in another way. */
const DASHES = [[], [7, 4], [2, 3]];
const LEFT = 66, RIGHT = 10, BOTTOM = 24, TOP = 8;

export class Machine {
  constructor(place, curves) {
    this.place = place;
    this.curves = curves;
    this.told = null;
  }

  /** @param {object} told the server's `machine` */
  show(told) {
    this.told = told;
    const durations = [told.end_to_end, ...told.hops, ...told.wakeups].filter(Boolean);
    const kinds = [told.end_to_end ? ["end to end"] : [], told.hops.map(() => "hop"), told.wakeups.map(() => "wake-up")].flat();
    const rows = durations.map((found, index) =>
      row([kinds[index], found.name === kinds[index] ? "" : found.name, us(found.p50_us), us(found.p99_us), us(found.p999_us), us(found.max_us)], 2, COLOURS[index % COLOURS.length]));
    const processes = told.processes.map(({ name, state, restarts, missed, outage_cycles, cycles }) =>
      row([name, state === "down" ? "\u2716 down" : state, restarts ?? "", missed ?? "", outage_cycles ?? "", cycles ?? ""], 2));
    this.place.replaceChildren(
      table(["duration, µs", "", "p50", "p99", "p99.9", "max"], rows),
      table(["process", "state", "restarts", "missed", "outage", "cycles"], processes),
    );
  }

  draw() {
    if (!this.told || this.curves.clientWidth === 0) return;
    const { context, width, height } = fitted(this.curves);
    const durations = [this.told.end_to_end, ...this.told.hops, ...this.told.wakeups].filter(Boolean);
    const most = Math.max(1000, ...durations.map(({ max_us }) => max_us || 0));
    const nines = Math.max(3, ...durations.map(({ curve }) => -Math.log10(Math.max(1e-9, 1 - (curve.at(-1)?.[0] ?? 0) / 100))));
    const x = (percentile) => LEFT + ((width - LEFT - RIGHT) * -Math.log10(Math.max(1 - percentile / 100, 1e-9))) / nines;
    const y = (duration) => height - BOTTOM - ((height - BOTTOM - TOP) * Math.log10(Math.max(duration, 1))) / Math.log10(most);
    context.font = "15px system-ui, sans-serif";
    const [quiet, line] = [resolved("--quiet"), resolved("--line")];
    for (let power = 0; 10 ** power <= most; power += 1) {
      context.fillStyle = line;
      context.fillRect(LEFT, y(10 ** power), width - LEFT - RIGHT, 1);
      context.fillStyle = quiet;
      context.textAlign = "right";
      context.fillText(["1 µs", "10 µs", "100 µs", "1 ms", "10 ms", "100 ms", "1 s"][power] ?? "", LEFT - 6, y(10 ** power) + 4);
    }
    context.textAlign = "center";
    for (const percentile of [0, 90, 99, 99.9, 99.99, 99.999]) {
      if (x(percentile) <= width - RIGHT) context.fillText(`${percentile} %`, x(percentile) + (percentile ? 0 : 10), height - 5);
    }
    durations.forEach(({ curve }, index) => {
      if (curve.length < 2) return;
      context.beginPath();
      curve.forEach(([percentile, duration], point) => context[point ? "lineTo" : "moveTo"](x(percentile), y(duration)));
      context.strokeStyle = COLOURS[index % COLOURS.length];
      context.setLineDash(DASHES[Math.floor(index / 4) % DASHES.length]);
      context.lineWidth = 2;
      context.stroke();
      context.setLineDash([]);
    });
  }
}

const us = (value) => (!Number.isFinite(value) ? "" : value >= 100 ? Math.round(value) : value.toFixed(1));

function table(head, rows) {
  const made = document.createElement("table");
  const first = document.createElement("tr");
  first.append(...head.map((text) => Object.assign(document.createElement("th"), { textContent: text })));
  made.append(first, ...rows);
  return made;
}

/** The cells from `numbers` on are aligned as numbers; a colour marks the row's curve. */
function row(cells, numbers, colour) {
  const made = document.createElement("tr");
  cells.forEach((text, index) => {
    const cell = Object.assign(document.createElement("td"), { textContent: String(text) });
    if (index >= numbers) cell.className = "number";
    if (index === 0 && colour) cell.style.borderLeft = `5px solid ${colour}`;
    made.append(cell);
  });
  return made;
}
