// A picture as the server sends it, taken apart: numbers, section after section; not a number is what is not known.

const HEAD = 16;

/** Numbers of each section for these sizes, in the order in which they are sent. */
function sections({ forms, parts, path, warmest, populations }) {
  return {
    robot: forms * 7,
    parts: parts * 9,
    keypoints: 2 * 9 * 4,
    arms: 2 * 4 * 5,
    truth: 2 * 4 * 3,
    path: path * 3,
    nearest: 7,
    expected: 4,
    destinations: warmest * 3,
    state: 12,
    populations: populations * 3,
  };
}

/**
 * @param {ArrayBuffer} bytes
 * @param {{forms: number, parts: number, path: number, warmest: number, populations: number}} sizes
 * @returns {null | {past: boolean, at: number, robot: Float32Array, parts: Float32Array, keypoints: Float32Array,
 *   arms: Float32Array, truth: Float32Array, path: Float32Array, nearest: Float32Array, expected: Float32Array, destinations: Float32Array,
 *   state: object, populations: Float32Array, sites: Float32Array}} null when it is none of this run
 */
export function readPicture(bytes, sizes) {
  if (bytes.byteLength < HEAD) return null;
  const head = new DataView(bytes);
  const [kind, sites] = [head.getUint32(0, true), head.getUint32(4, true)];
  const picture = { past: kind === 2, at: head.getFloat64(8, true) };
  let place = HEAD;
  for (const [name, count] of [...Object.entries(sections(sizes)), ["sites", sites]]) {
    if (place + 4 * count > bytes.byteLength) return null;
    picture[name] = new Float32Array(bytes, place, count);
    place += 4 * count;
  }
  const [override, handover, phase, action, stopped, aperture, tipSpeed, robotSpeed, onset, hidden] = picture.state;
  picture.state = { override, handover, phase, action, stopped: stopped === 1, aperture, tipSpeed, robotSpeed, onset, hidden: hidden === 1 };
  return picture;
}

/** The place that begins at `index`, or null where it is not known. */
export function placeAt(numbers, index) {
  const place = [numbers[index], numbers[index + 1], numbers[index + 2]];
  return place.every(Number.isFinite) ? place : null;
}
