// The edges of a part's shape, in the part's own frame: an outline of where it belongs.

const SIDES = 16;

/** @returns {number[][][]} pairs of points, m */
export function edges(shape) {
  if (shape.cylinder) return ofPrism(ring(shape.cylinder.radius), shape.cylinder.height, SIDES / 4);
  if (!shape.box) return [];
  const [x, y, z] = [shape.box[0] / 2, shape.box[1] / 2, shape.box[2]];
  return ofPrism([[-x, -y], [x, -y], [x, y], [-x, y]], z, 1);
}

function ring(radius) {
  return Array.from({ length: SIDES }, (_, side) => {
    const angle = (side / SIDES) * 2 * Math.PI;
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
  });
}

/** Both faces, and an upright edge at each `every`th corner. */
function ofPrism(corners, height, every) {
  return corners.flatMap(([x, y], index) => {
    const [nextX, nextY] = corners[(index + 1) % corners.length];
    const faces = [0, height].map((z) => [[x, y, z], [nextX, nextY, z]]);
    return index % every === 0 ? [...faces, [[x, y, 0], [x, y, height]]] : faces;
  });
}
