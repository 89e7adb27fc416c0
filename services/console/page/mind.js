// All populations of all layers: in the arrangement of the chapter's figure 2, or by their names; one of them can be chosen.

import { fitted } from "./canvas.js";
import { drawFigure, leastHeight } from "./mind-figure.js";
import { drawNames, namesHeight } from "./mind-names.js";

export class Mind {
  /** @param choose called with the population that was chosen, or null */
  constructor(canvas, hello, choose) {
    this.canvas = canvas;
    this.hello = hello;
    this.choose = choose;
    this.chosen = null;
    /** Whether all names are shown in place of the figure. */
    this.byName = false;
    /** Where each population was drawn, in the order in which keys go through them. */
    this.cells = [];
    canvas.addEventListener("click", ({ offsetX, offsetY }) => this.#pick(this.#at(offsetX, offsetY)));
    canvas.addEventListener("pointermove", ({ offsetX, offsetY }) => {
      const under = this.#at(offsetX, offsetY);
      canvas.title = under === null ? "" : this.name(under);
    });
    canvas.addEventListener("keydown", (event) => this.#key(event));
  }

  name(population) {
    const layer = this.hello.layers.find(({ first, count }) => population >= first && population < first + count);
    return layer ? `${layer.name} ${layer.populations[population - layer.first]}` : "";
  }

  #key(event) {
    const layers = this.hello.layers;
    const count = layers.reduce((sum, layer) => sum + layer.count, 0);
    const own = layers.findIndex(({ first, count: size }) => this.chosen >= first && this.chosen < first + size);
    const to = {
      ArrowRight: () => Math.min(count - 1, (this.chosen ?? -1) + 1),
      ArrowLeft: () => Math.max(0, (this.chosen ?? 1) - 1),
      ArrowUp: () => layers[Math.min(layers.length - 1, own + 1)].first,
      ArrowDown: () => layers[Math.max(0, own - 1)].first,
      Escape: () => null,
    }[event.key];
    if (!to) return;
    event.preventDefault();
    event.stopPropagation();
    this.#pick(to());
    const cell = this.cells.find(({ population }) => population === this.chosen);
    if (!cell || !this.byName) return;
    const { parentElement: scroll } = this.canvas;
    if (cell.y < scroll.scrollTop || cell.y + cell.height > scroll.scrollTop + scroll.clientHeight) scroll.scrollTop = cell.y - 60;
  }

  #pick(population) {
    this.chosen = population;
    this.canvas.setAttribute("aria-label", population === null ? "populations of all layers; arrow keys choose one" : this.name(population));
    this.choose(population);
  }

  #at(x, y) {
    const found = this.cells.find((cell) => x >= cell.x && x < cell.x + cell.width && y >= cell.y && y < cell.y + cell.height);
    return found ? found.population : null;
  }

  draw(picture) {
    const { canvas, hello, byName } = this;
    const room = canvas.parentElement.clientHeight;
    const width = canvas.clientWidth;
    const height = byName ? namesHeight(hello, width) : Math.max(room - 2, leastHeight());
    if (canvas.style.height !== `${height}px`) canvas.style.height = `${height}px`;
    const { context } = fitted(canvas, height);
    const shown = { hello, picture, chosen: this.chosen };
    this.cells = byName ? drawNames(context, width, shown) : drawFigure(context, width, height, shown);
  }
}
