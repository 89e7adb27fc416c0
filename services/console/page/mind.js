// All populations of all layers, arranged as in the chapter's figure 2: what is observed at the bottom, what is done at the top.

import { fitted, shortened } from "./canvas.js";
import { BLUE, GREEN, GREY, ORANGE, PURPLE, SKY, VERMILION, resolved } from "./colours.js";

/** Rows of the arrangement from top to bottom, each with the layers that stand beside one another. */
const ROWS = [["AEL", "EML"], ["IL", "CSGL available"], ["ASL", "CSGL achieved"], ["AOL", "OML person", "OML robot"]];
const COLOURS = { AEL: BLUE, EML: VERMILION, IL: PURPLE, ASL: ORANGE, AOL: SKY };
const CELL = 19, HEAD = 24, GAP = 14;
/** A bar shows activity from the resting level to this, where its threshold is 0. */
const MOST = 3;

export class Mind {
  /** @param choose called with the population that was chosen, or null */
  constructor(canvas, hello, choose) {
    this.canvas = canvas;
    this.hello = hello;
    this.choose = choose;
    this.chosen = null;
    this.cells = [];
    canvas.addEventListener("click", ({ offsetX, offsetY }) => this.#pick(this.#at(offsetX, offsetY)));
    canvas.addEventListener("keydown", (event) => {
      const step = { ArrowDown: 1, ArrowUp: -1, ArrowRight: 10, ArrowLeft: -10 }[event.key];
      if (event.key === "Escape") this.#pick(null);
      if (!step) return;
      event.preventDefault();
      const index = this.cells.findIndex(({ population }) => population === this.chosen);
      const next = Math.min(this.cells.length - 1, Math.max(0, index + step));
      this.#pick(this.cells[next]?.population ?? null);
    });
  }

  name(population) {
    const layer = this.hello.layers.find(({ first, count }) => population >= first && population < first + count);
    return layer ? `${layer.name} ${layer.populations[population - layer.first]}` : "";
  }

  #pick(population) {
    this.chosen = population;
    this.canvas.setAttribute("aria-label", population === null ? "populations of all layers" : this.name(population));
    this.choose(population);
  }

  #at(x, y) {
    const found = this.cells.find((cell) => x >= cell.x && x < cell.x + cell.width && y >= cell.y && y < cell.y + CELL);
    return found ? found.population : null;
  }

  draw({ populations, sites, at }) {
    const layers = new Map(this.hello.layers.map((layer) => [layer.name, layer]));
    const tall = (row) => Math.max(...row.map((name) => rowsOf(layers.get(name)))) * CELL + HEAD + GAP;
    const height = ROWS.reduce((sum, row) => sum + tall(row), 0);
    this.canvas.style.height = `${height}px`;
    const { context, width } = fitted(this.canvas, height);
    const inks = { ink: resolved("--ink"), quiet: resolved("--quiet"), line: resolved("--line") };
    this.cells.length = 0;
    let y = 0;
    ROWS.forEach((row, index) => {
      const each = (width - 2 * GAP) / row.length;
      row.forEach((name, column) => {
        this.#layer(context, layers.get(name), [GAP + column * each, y, each - 8], { populations, sites, at }, inks);
      });
      y += tall(row);
      if (index + 1 < ROWS.length) arrow(context, width / 2, y - GAP + 3, inks.quiet);
    });
  }

  #layer(context, layer, [x, y, width], { populations, sites, at }, { ink, quiet, line }) {
    const colour = COLOURS[layer.name] ?? GREEN;
    context.textAlign = "left";
    context.font = "600 14px system-ui, sans-serif";
    context.fillStyle = ink;
    context.fillText(shortened(context, `${layer.name}: ${layer.title}`, width), x, y + 16);
    const wide = width / 2 - 4;
    const rows = rowsOf(layer);
    for (let index = 0; index < layer.count; index += 1) {
      const population = layer.first + index;
      const cell = { x: x + (index >= rows ? wide + 8 : 0), y: y + HEAD + (index % rows) * CELL, width: wide, population };
      this.cells.push(cell);
      const [, highest, since] = populations.subarray(3 * population, 3 * population + 3);
      const share = (value) => Math.min(1, Math.max(0, (value - layer.resting) / (MOST - layer.resting)));
      const filled = Number.isFinite(highest) ? share(highest) : 0;
      context.fillStyle = line;
      context.fillRect(cell.x, cell.y + CELL - 5, wide, 3);
      context.fillStyle = since > 0 ? colour : GREY;
      context.fillRect(cell.x, cell.y + CELL - 5, wide * filled, 3);
      const threshold = cell.x + wide * share(layer.threshold);
      context.fillStyle = quiet;
      context.fillRect(threshold, cell.y + CELL - 8, 1, 8);
      if (sites.length > 0 && highest > layer.threshold - 1) this.#curve(context, layer, population, sites, cell, colour);
      context.font = `${since > 0 ? "600 " : ""}13px system-ui, sans-serif`;
      context.fillStyle = since > 0 ? ink : quiet;
      const mark = since > 0 ? "\u25B2 " : "";
      const stood = since > 0 && at - since > 100 ? ` ${((at - since) / 1000).toFixed(1)} s` : "";
      const label = layer.populations[index];
      context.fillText(shortened(context, mark + label, wide - (stood ? 42 : 4)), cell.x + 2, cell.y + 12);
      if (stood) {
        context.textAlign = "right";
        context.fillText(stood, cell.x + wide - 2, cell.y + 12);
        context.textAlign = "left";
      }
      if (population === this.chosen) {
        context.strokeStyle = colour;
        context.lineWidth = 2;
        context.strokeRect(cell.x - 1, cell.y, wide + 2, CELL - 1);
      }
    }
  }

  /** The activity over the population's own sites, behind its name. */
  #curve(context, layer, population, sites, { x, y, width }, colour) {
    const count = this.hello.sites_per_population;
    context.beginPath();
    for (let site = 0; site < count; site += 1) {
      const value = sites[population * count + site];
      const high = Math.min(1, Math.max(0, (value - layer.resting) / (MOST - layer.resting)));
      const place = [x + (site / (count - 1)) * width, y + CELL - 5 - high * (CELL - 7)];
      if (site === 0) context.moveTo(...place);
      else context.lineTo(...place);
    }
    context.globalAlpha = 0.55;
    context.strokeStyle = colour;
    context.lineWidth = 1.5;
    context.stroke();
    context.globalAlpha = 1;
  }
}

/** Populations stand in two columns where there are many. */
const rowsOf = (layer) => Math.ceil(layer.count / 2);

function arrow(context, x, y, colour) {
  context.fillStyle = colour;
  context.beginPath();
  context.moveTo(x, y - 9);
  context.lineTo(x + 6, y);
  context.lineTo(x - 6, y);
  context.fill();
}
