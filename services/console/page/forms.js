// The three forms that everything in the scene is made of, drawn many at a time: balls, cylinders and boxes.

import { axes, axesAlong, norm, scale, subtract } from "./vectors.js";

const VERTEX = `#version 300 es
in vec3 place; in vec3 normal; in mat4 frame; in vec4 colour;
uniform mat4 view;
out vec4 painted;
void main() {
  mat3 turn = mat3(frame);
  vec3 facing = normalize(turn * (normal / vec3(dot(turn[0], turn[0]), dot(turn[1], turn[1]), dot(turn[2], turn[2]))));
  float light = 0.62 + 0.24 * facing.z + 0.2 * max(dot(facing, normalize(vec3(-0.5, 0.6, 0.7))), 0.0);
  painted = vec4(colour.rgb * light * colour.a, colour.a);
  gl_Position = view * (frame * vec4(place, 1.0));
}`;
const FRAGMENT = `#version 300 es
precision mediump float;
in vec4 painted;
out vec4 seen;
void main() {
  seen = painted;
}`;
const SIDES = 14;
/** A rod that is thinner than this, m, has four sides: nobody sees more. */
const THIN = 0.006;
const FLOATS = 20;

/** A ball of radius 1, a cylinder of radius 1 from z 0 to 1, and a cube from -0.5 to 0.5: places and normals. */
function meshes() {
  const ball = [], cylinder = [], box = [];
  const on = (ring, side) => {
    const [high, around] = [(ring / (SIDES / 2)) * Math.PI, (side / SIDES) * 2 * Math.PI];
    return [Math.sin(high) * Math.cos(around), Math.sin(high) * Math.sin(around), Math.cos(high)];
  };
  const put = (mesh, place, normal) => mesh.push(...place, ...normal);
  for (let side = 0; side < SIDES; side += 1) {
    for (let ring = 0; ring < SIDES / 2; ring += 1) {
      const corners = [on(ring, side), on(ring + 1, side), on(ring + 1, side + 1), on(ring, side + 1)];
      for (const corner of [0, 1, 2, 0, 2, 3]) put(ball, corners[corner], corners[corner]);
    }
    const [a, b] = [on(SIDES / 4, side), on(SIDES / 4, side + 1)];
    const flat = (corner, z) => [corner[0], corner[1], z];
    for (const [corner, z] of [[a, 0], [b, 0], [b, 1], [a, 0], [b, 1], [a, 1]]) put(cylinder, flat(corner, z), flat(corner, 0));
    for (const z of [0, 1]) for (const corner of [[0, 0], a, b]) put(cylinder, flat(corner, z), [0, 0, 2 * z - 1]);
  }
  for (let axis = 0; axis < 3; axis += 1) {
    for (const sign of [-1, 1]) {
      const corner = (u, v) => {
        const place = [0, 0, 0];
        [place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3]] = [0.5 * sign, u, v];
        return place;
      };
      const normal = [0, 0, 0];
      normal[axis] = sign;
      const square = [corner(-0.5, -0.5), corner(0.5, -0.5), corner(0.5, 0.5), corner(-0.5, 0.5)];
      for (const index of [0, 1, 2, 0, 2, 3]) put(box, square[index], normal);
    }
  }
  return { ball, cylinder, box };
}

export class Forms {
  #gl;
  #view;
  #meshes = {};

  /** @param {WebGL2RenderingContext} gl */
  constructor(gl) {
    this.#gl = gl;
    const program = linked(gl);
    gl.useProgram(program);
    this.#view = gl.getUniformLocation(program, "view");
    for (const [name, vertices] of Object.entries(meshes())) this.#meshes[name] = this.#upload(program, vertices);
  }

  #upload(program, vertices) {
    const gl = this.#gl;
    const array = gl.createVertexArray();
    const { corners, order } = indexed(vertices);
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(corners), gl.STATIC_DRAW);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, new Uint16Array(order), gl.STATIC_DRAW);
    const attribute = (name, size, stride, offset, each) => {
      const place = gl.getAttribLocation(program, name);
      for (let column = 0; column < size / 4 || column === 0; column += 1) {
        gl.enableVertexAttribArray(place + column);
        gl.vertexAttribPointer(place + column, Math.min(size, 4), gl.FLOAT, false, stride, offset + 16 * column);
        gl.vertexAttribDivisor(place + column, each);
      }
    };
    attribute("place", 3, 24, 0, 0);
    attribute("normal", 3, 24, 12, 0);
    const instances = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, instances);
    attribute("frame", 16, 4 * FLOATS, 0, 1);
    attribute("colour", 4, 4 * FLOATS, 64, 1);
    return { array, instances, count: order.length, solid: [], clear: [] };
  }

  #put(mesh, [x, y, z], place, [red, green, blue], alpha) {
    const list = alpha < 1 ? mesh.clear : mesh.solid;
    list.push(...x, 0, ...y, 0, ...z, 0, ...place, 1, red, green, blue, alpha);
  }

  ball(place, radius, colour, alpha = 1) {
    this.#put(this.#meshes.ball, [[radius, 0, 0], [0, radius, 0], [0, 0, radius]], place, colour, alpha);
  }

  rod(from, to, radius, colour, alpha = 1) {
    const along = subtract(to, from);
    if (norm(along) < 1e-6) return;
    const [x, y] = axesAlong(along);
    if (radius < THIN) {
      const middle = from.map((value, axis) => value + along[axis] / 2);
      this.#put(this.#meshes.box, [scale(x, 2 * radius), scale(y, 2 * radius), along], middle, colour, alpha);
    } else {
      this.#put(this.#meshes.cylinder, [scale(x, radius), scale(y, radius), along], from, colour, alpha);
    }
  }

  capsule(from, to, radius, colour, alpha = 1) {
    this.rod(from, to, radius, colour, alpha);
    this.ball(from, radius, colour, alpha);
    this.ball(to, radius, colour, alpha);
  }

  /** A part's shape that stands on the place, turned by a quaternion. */
  shape(shape, place, turn, colour, alpha = 1) {
    const [x, y, z] = axes(turn);
    if (shape.cylinder) {
      const { radius, height } = shape.cylinder;
      this.#put(this.#meshes.cylinder, [scale(x, radius), scale(y, radius), scale(z, height)], place, colour, alpha);
    } else if (shape.box) {
      const [across, along, high] = shape.box;
      const middle = place.map((value, axis) => value + (z[axis] * high) / 2);
      this.#put(this.#meshes.box, [scale(x, across), scale(y, along), scale(z, high)], middle, colour, alpha);
    }
  }

  /** A form of the robot's, in its own frame, turned by a quaternion: boxes and cylinders are centred on the place. */
  centred(form, place, turn, colour) {
    const [x, y, z] = axes(turn);
    const at = ([u, v, w]) => place.map((value, axis) => value + u * x[axis] + v * y[axis] + w * z[axis]);
    if (form.capsule) return this.capsule(at(form.capsule.from), at(form.capsule.to), form.capsule.radius, colour);
    this.shape(form, at([0, 0, -(form.cylinder?.height ?? form.box[2]) / 2]), turn, colour);
  }

  /** Draws what was put since the last time: what can be seen through comes last. */
  draw(view) {
    const gl = this.#gl;
    gl.uniformMatrix4fv(this.#view, false, view);
    for (const list of ["solid", "clear"]) {
      gl.depthMask(list === "solid");
      if (list === "solid") gl.disable(gl.BLEND);
      else gl.enable(gl.BLEND);
      for (const mesh of Object.values(this.#meshes)) {
        if (mesh[list].length === 0) continue;
        gl.bindVertexArray(mesh.array);
        gl.bindBuffer(gl.ARRAY_BUFFER, mesh.instances);
        gl.bufferData(gl.ARRAY_BUFFER, new Float32Array(mesh[list]), gl.STREAM_DRAW);
        gl.drawElementsInstanced(gl.TRIANGLES, mesh.count, gl.UNSIGNED_SHORT, 0, mesh[list].length / FLOATS);
        mesh[list].length = 0;
      }
    }
    gl.depthMask(true);
  }
}

/** Corners that several triangles share are computed once. */
function indexed(vertices) {
  const corners = [], order = [], found = new Map();
  for (let index = 0; index < vertices.length; index += 6) {
    const corner = vertices.slice(index, index + 6);
    const name = corner.map((value) => value.toFixed(5)).join();
    if (!found.has(name)) {
      found.set(name, corners.length / 6);
      corners.push(...corner);
    }
    order.push(found.get(name));
  }
  return { corners, order };
}

function linked(gl) {
  const program = gl.createProgram();
  for (const [kind, text] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}
