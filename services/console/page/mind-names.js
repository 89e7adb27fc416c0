// The mind as a list of all populations with their names, layer after layer, from what is done to what is observed.

import { shortened } from "./canvas.js";
import { GREY, resolved } from "./colours.js";
import { height as share, layerColour, told } from "./mind-layers.js";

const CELL = 30, HEAD = 34, EDGE = 12, GAP = 12;
/** A column is no narrower than this. */
const LEAST = 220;

const columns = (width) => Math.max(1, Math.floor((width - 2 * EDGE + GAP) / (LEAST + GAP)));
const rows = (layer, width) => Math.ceil(layer.count / columns(width));

export const namesHeight = ({ layers }, width) => layers.reduce((sum, layer) => sum + HEAD + rows(layer, width) * CELL, 10);

/** Draws it, and gives the place of each population. */
export function drawNames(context, width, { hello, picture, chosen }) {
  const [ink, quiet] = [resolved("--ink"), resolved("--quiet")];
  const wide = (width - 2 * EDGE - GAP * (columns(width) - 1)) / columns(width);
  const cells = [];
  let top = 0;
  context.textAlign = "left";
  for (const layer of [...hello.layers].reverse()) {
    context.font = "600 15px system-ui, sans-serif";
    context.fillStyle = ink;
    context.fillText(shortened(context, `${layer.name}: ${layer.title}`, width - 2 * EDGE), EDGE, top + 23);
    for (let index = 0; index < layer.count; index += 1) {
      const x = EDGE + Math.floor(index / rows(layer, width)) * (wide + GAP);
      const y = top + HEAD + (index % rows(layer, width)) * CELL;
      const cell = { population: layer.first + index, x, y, width: wide, height: CELL };
      cells.push(cell);
      drawCell(context, layer, layer.populations[index] ?? "", cell, { hello, picture, chosen }, ink, quiet);
    }
    top += HEAD + rows(layer, width) * CELL;
  }
  return cells;
}

/** A name over a bar: activity against the threshold, with the field's sites behind it; the mark says that a peak stands. */
function drawCell(context, layer, label, { population, x, y, width }, { hello, picture, chosen }, ink, quiet) {
  const { signal, activity, since } = told(picture, population);
  context.fillStyle = resolved("--line");
  context.fillRect(x, y + CELL - 7, width, 4);
  context.fillStyle = since ? layerColour(layer) : GREY;
  context.fillRect(x, y + CELL - 7, width * share(layer, activity), 4);
  context.fillStyle = quiet;
  context.fillRect(x + width * share(layer, layer.threshold), y + CELL - 11, 2, 11);
  const of = hello.sites_per_population;
  if (picture.sites.length >= (population + 1) * of && activity > layer.threshold - 1) {
    context.beginPath();
    for (let site = 0; site < of; site += 1) {
      const up = share(layer, picture.sites[population * of + site]);
      context[site ? "lineTo" : "moveTo"](x + (site / Math.max(1, of - 1)) * width, y + CELL - 7 - up * (CELL - 10));
    }
    context.strokeStyle = layerColour(layer);
    context.lineWidth = 1.5;
    context.globalAlpha = 0.5;
    context.stroke();
    context.globalAlpha = 1;
  }
  context.font = `${since ? "600 " : ""}15px system-ui, sans-serif`;
  context.fillStyle = since ? ink : quiet;
  const stood = since ? `${Math.max(0, (picture.at - since) / 1000).toFixed(1)} s` : signal > 0.005 ? signal.toFixed(2) : "";
  const room = stood ? context.measureText(stood).width + 8 : 2;
  context.fillText(shortened(context, (since ? "\u25B2 " : "") + label, width - room), x + 1, y + 16);
  if (stood) context.fillText(stood, x + width - room + 6, y + 16);
  if (population !== chosen) return;
  context.strokeStyle = ink;
  context.lineWidth = 2;
  context.strokeRect(x - 3, y, width + 6, CELL - 1);
}
