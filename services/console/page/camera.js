// From where the scene is seen: turned about a point, nearer or farther; and what a place on the screen points at.

import { add, cross, dot, multiplied, perspective, scale, subtract, unit, viewFrom } from "./vectors.js";

const ANGLE = 0.72;
/** Not quite from above: where up is must stay known. */
const LOWEST = -0.2, HIGHEST = 1.52;

export class Camera {
  /** @param {number[]} target the point about which it turns, m */
  constructor(target) {
    this.target = target;
    this.size = [1, 1];
    this.look("person");
  }

  /** One of the views that have a name. */
  look(name) {
    const views = { person: [Math.PI, 0.62, 1.75], top: [Math.PI, HIGHEST, 1.8], side: [-Math.PI / 2, 0.25, 1.9] };
    [this.azimuth, this.elevation, this.distance] = views[name];
  }

  turn(across, down) {
    this.azimuth -= across * 0.006;
    this.elevation = Math.min(HIGHEST, Math.max(LOWEST, this.elevation + down * 0.006));
  }

  zoom(factor) {
    this.distance = Math.min(5, Math.max(0.5, this.distance * factor));
  }

  get eye() {
    const flat = Math.cos(this.elevation);
    const back = [Math.cos(this.azimuth) * flat, Math.sin(this.azimuth) * flat, Math.sin(this.elevation)];
    return add(this.target, scale(back, this.distance));
  }

  get matrix() {
    const [width, height] = this.size;
    return multiplied(perspective(ANGLE, width / Math.max(height, 1), 0.05, 12), viewFrom(this.eye, this.target));
  }

  /** Where a place of the world is on the canvas, pixels; null behind the eye. */
  project([x, y, z], matrix = this.matrix) {
    const at = (row) => matrix[row] * x + matrix[4 + row] * y + matrix[8 + row] * z + matrix[12 + row];
    const w = at(3);
    if (w <= 0.01) return null;
    return { x: ((at(0) / w + 1) / 2) * this.size[0], y: ((1 - at(1) / w) / 2) * this.size[1] };
  }

  /** The place at height z that a pixel of the canvas points at; null when it points above the horizon. */
  placeAt(x, y, z) {
    const [width, height] = this.size;
    const back = unit(subtract(this.eye, this.target));
    const right = unit(cross(Math.abs(back[2]) > 0.999 ? [0, 1, 0] : [0, 0, 1], back));
    const up = cross(back, right);
    const extent = Math.tan(ANGLE / 2);
    const across = ((2 * x) / width - 1) * extent * (width / height);
    const high = (1 - (2 * y) / height) * extent;
    const ray = subtract(add(scale(right, across), scale(up, high)), back);
    const far = (z - this.eye[2]) / ray[2];
    return far > 0 && dot(ray, ray) > 0 ? add(this.eye, scale(ray, far)) : null;
  }
}
