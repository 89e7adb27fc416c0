// The mind as in the chapter's figure 2: what is observed at the bottom, what is done at the top, what is known of task and scene beside it.

import { shortened } from "./canvas.js";
import { GREY, resolved } from "./colours.js";
import { height as share, layerColour, told } from "./mind-layers.js";

/** From top to bottom; the first of each row hands on upwards, the others hand to it. */
const ROWS = [["AEL", "EML"], ["IL", "CSGL available"], ["ASL", "CSGL achieved"], ["AOL", "OML person", "OML robot"]];
/** Share of the width that the first has. */
const FIRST = 0.52;
const EDGE = 7, GAP = 20, BETWEEN = 14, LEAST_ROW = 66, TITLE = 23, NAMES = 18;

export const leastHeight = () => ROWS.length * LEAST_ROW + (ROWS.length - 1) * BETWEEN + 2 * EDGE;

/** Draws it, and gives the place of each population: names before bars. */
export function drawFigure(context, width, height, { hello, picture, chosen }) {
  const layers = new Map(hello.layers.map((layer) => [layer.name, layer]));
  const high = (height - 2 * EDGE - (ROWS.length - 1) * BETWEEN) / ROWS.length;
  const first = (width - 2 * EDGE - GAP) * FIRST;
  const right = width - 2 * EDGE - GAP - first;
  const cells = [], named = [];
  ROWS.forEach((row, index) => {
    const y = EDGE + index * (high + BETWEEN);
    row.forEach((name, column) => {
      const layer = layers.get(name);
      if (!layer) return;
      const beside = row.length - 1;
      const wide = column === 0 ? first : (right - 6 * (beside - 1)) / beside;
      const x = column === 0 ? EDGE : EDGE + first + GAP + (column - 1) * (wide + 6);
      drawLayer(context, layer, { x, y, width: wide, height: high }, { hello, picture, chosen }, cells, named);
    });
    context.fillStyle = resolved("--quiet");
    arrow(context, [EDGE + first + GAP - 1, y + high / 2], [EDGE + first + 1, y + high / 2]);
    if (index === 0) return;
    arrow(context, [EDGE + first / 2, y - 1], [EDGE + first / 2, y - BETWEEN + 1]);
    if (index === 2) arrow(context, [EDGE + first + GAP + right / 2, y - 1], [EDGE + first + GAP + right / 2, y - BETWEEN + 1]);
  });
  return [...named, ...cells];
}

function drawLayer(context, layer, { x, y, width, height }, { hello, picture, chosen }, cells, named) {
  const [ink, quiet, line] = [resolved("--ink"), resolved("--quiet"), resolved("--line")];
  context.strokeStyle = line;
  context.lineWidth = 1;
  context.strokeRect(x + 0.5, y + 0.5, width - 1, height - 1);
  context.textAlign = "left";
  context.font = "600 15px system-ui, sans-serif";
  context.fillStyle = ink;
  context.fillText(shortened(context, layer.name, width - 10), x + 6, y + 17);
  const after = x + 6 + context.measureText(layer.name).width + 8;
  context.font = "15px system-ui, sans-serif";
  // A layer of two has its own word in its name.
  if (!layer.name.includes(" ") && x + width - after > 60) {
    context.fillStyle = quiet;
    const title = layer.title.replace(/ layer\b/, "");
    context.fillText(shortened(context, title, x + width - after - 4), after, y + 17);
  }
  const plot = { left: x + 5, wide: width - 10, top: y + TITLE, bottom: y + height - NAMES - 3 };
  const tall = plot.bottom - plot.top;
  const level = (activity) => plot.bottom - tall * share(layer, activity);
  const each = plot.wide / Math.max(1, layer.count);
  const standing = [];
  for (let index = 0; index < layer.count; index += 1) {
    const population = layer.first + index;
    const { signal, activity, since } = told(picture, population);
    const left = plot.left + index * each;
    if (since) standing.push({ population, since, left });
    context.globalAlpha = since ? 0.4 + 0.6 * signal : 0.55;
    context.fillStyle = since ? layerColour(layer) : GREY;
    context.fillRect(left + 0.5, level(activity), Math.max(1, each - 1), plot.bottom - level(activity));
    context.globalAlpha = 1;
    if (population === chosen) {
      context.strokeStyle = ink;
      context.lineWidth = 2;
      context.strokeRect(left - 1, plot.top, each + 2, tall + 1);
    }
    cells.push({ population, x: left, width: each, y, height: height - NAMES });
  }
  context.fillStyle = quiet;
  for (let dash = plot.left; dash < plot.left + plot.wide; dash += 6) context.fillRect(dash, Math.round(level(layer.threshold)), 3, 1);
  drawSites(context, layer, picture.sites, hello.sites_per_population, plot, level, ink);
  drawNamesOfPeaks(context, layer, standing, { x, y, width, height, each, top: plot.top }, ink, quiet, named);
}

/** The field's activity over all its sites, where they are told. */
function drawSites(context, { first, count }, sites, of, { left, wide }, level, ink) {
  const [from, until] = [first * of, (first + count) * of];
  if (sites.length < until || count === 0) return;
  context.beginPath();
  for (let site = from; site < until; site += 1) {
    const x = left + ((site - from + 0.5) / (until - from)) * wide;
    if (site === from) context.moveTo(x, level(sites[site]));
    else context.lineTo(x, level(sites[site]));
  }
  context.strokeStyle = ink;
  context.lineWidth = 1;
  context.globalAlpha = 0.8;
  context.stroke();
  context.globalAlpha = 1;
}

/** Peaks are marked above their bars, and named below, the newest first. */
function drawNamesOfPeaks(context, layer, standing, { x, y, width, height, each, top }, ink, quiet, named) {
  context.fillStyle = ink;
  for (const { left } of standing) {
    const middle = left + each / 2;
    context.beginPath();
    context.moveTo(middle - 4, top - 4);
    context.lineTo(middle + 4, top - 4);
    context.lineTo(middle, top + 2);
    context.fill();
  }
  const below = y + height - 6;
  let from = x + 6;
  context.fillStyle = standing.length ? ink : quiet;
  if (standing.length === 0) context.fillText("\u2013", from, below);
  standing.sort((a, b) => b.since - a.since);
  standing.forEach(({ population }, index) => {
    const room = x + width - 4 - from;
    if (room < 24) return;
    const name = layer.populations[population - layer.first] + (index + 1 < standing.length ? "," : "");
    const fits = shortened(context, name, room);
    const wide = context.measureText(fits).width;
    context.fillText(fits, from, below);
    named.push({ population, x: from, y: y + height - NAMES - 4, width: wide, height: NAMES + 4 });
    from += wide + 6;
  });
}

function arrow(context, [fromX, fromY], [toX, toY]) {
  const [x, y] = [Math.sign(toX - fromX), Math.sign(toY - fromY)];
  const neck = [toX - 6 * x, toY - 6 * y];
  context.fillRect(Math.min(fromX, neck[0]) - (x ? 0 : 1), Math.min(fromY, neck[1]) - (y ? 0 : 1), Math.abs(fromX - neck[0]) || 2, Math.abs(fromY - neck[1]) || 2);
  context.beginPath();
  context.moveTo(toX, toY);
  context.lineTo(neck[0] - 5 * y, neck[1] + 5 * x);
  context.lineTo(neck[0] + 5 * y, neck[1] - 5 * x);
  context.fill();
}
