// Colours that colour-blind people tell apart (Okabe and Ito 2008), for the scene, the mind and the timeline.

export const ORANGE = "#e69f00", SKY = "#56b4e9", GREEN = "#009e73", YELLOW = "#f0e442";
export const BLUE = "#0072b2", VERMILION = "#d55e00", PURPLE = "#cc79a7", GREY = "#8a8f96";
const INDIGO = "#5b4bb7";

/** The colour of each kind of part; its name stands beside it. */
const KINDS = [SKY, YELLOW, GREEN, PURPLE, BLUE, INDIGO, VERMILION, ORANGE];
export const kindColour = (kind) => KINDS[kind % KINDS.length];

/** Red, green, blue, each 0 to 1. */
export function rgb(hex) {
  const number = parseInt(hex.slice(1), 16);
  return [(number >> 16) / 255, ((number >> 8) & 255) / 255, (number & 255) / 255];
}

/** What custom properties stood for since the theme changed: to ask an element for each picture would cost a layout. */
const known = new Map();

/** The colour that a custom property stands for, as a canvas takes it: `light-dark()` is resolved by an element. */
export function resolved(name) {
  if (!known.has(name)) {
    const probe = document.createElement("span");
    probe.style.color = `var(${name})`;
    document.body.append(probe);
    known.set(name, getComputedStyle(probe).color);
    probe.remove();
  }
  return known.get(name);
}

/** To be called when the theme has changed. */
export function forgetResolved() {
  known.clear();
}
