// What the two ways to draw the mind share: the layers' colours, and how active a population is.

import { BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION } from "./colours.js";

const COLOURS = { AEL: BLUE, EML: VERMILION, IL: PURPLE, ASL: ORANGE, AOL: SKY };

export const layerColour = (layer) => COLOURS[layer.name] ?? GREEN;

/** Activity is drawn up to this, where the threshold is 0. */
const MOST = 3;

/** Where between lowest and highest an activity is drawn, 0 to 1; what is not known rests. */
export function height(layer, activity) {
  const lowest = layer.resting - 0.3;
  return Number.isFinite(activity) ? Math.min(1, Math.max(0, (activity - lowest) / (MOST - lowest))) : 0;
}

/** What a picture says of a population. */
export function told({ populations }, population) {
  const [signal, activity, since] = populations.subarray(3 * population, 3 * population + 3);
  return { signal: signal > 0 ? Math.min(signal, 1) : 0, activity, since: since > 0 ? since : 0 };
}
