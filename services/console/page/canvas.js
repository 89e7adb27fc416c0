// A canvas that has as many dots as the screen shows, within reason: more than 1.5 for each of its pixels cost time and add little.

const MOST = 1.5;

/** Fits the dots to the size on the page; gives the drawing context in page pixels, with its width and height. */
export function fitted(canvas, height = canvas.clientHeight) {
  const ratio = Math.min(devicePixelRatio || 1, MOST);
  const width = canvas.clientWidth;
  const [dots, rows] = [Math.round(width * ratio), Math.round(height * ratio)];
  if (canvas.width !== dots || canvas.height !== rows) [canvas.width, canvas.height] = [dots, rows];
  const context = canvas.getContext("2d", { willReadFrequently: true });
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return { context, width, height };
}

/** The text, shortened to a width. */
export function shortened(context, text, width) {
  if (context.measureText(text).width <= width) return text;
  let [low, high] = [0, text.length];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (context.measureText(text.slice(0, middle) + "…").width <= width) low = middle;
    else high = middle - 1;
  }
  return text.slice(0, low) + "…";
}
