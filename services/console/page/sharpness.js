// How finely the scene is drawn: with fewer dots where the machine draws fewer pictures than come.

const MOST = 1.5, LEAST = 0.75, STEP = 0.85;
/** Judged so often, ms. */
const EVERY = 2000;
/** This share of the pictures is to be drawn. */
const ENOUGH = 0.9;

export class Sharpness {
  #came = 0;
  #drawn = 0;
  #since = performance.now();
  /** So many times all has to be well before more dots are tried; twice as often each time that they were too many. */
  #patience = 3;
  #well = 0;

  constructor() {
    /** Dots for each pixel of the page. */
    this.ratio = Math.min(devicePixelRatio || 1, MOST);
  }

  /** Whether the machine does not keep up, so that what is seen less may be drawn less often. */
  get isStrained() {
    return this.ratio < Math.min(devicePixelRatio || 1, MOST);
  }

  came() {
    this.#came += 1;
  }

  drew() {
    this.#drawn += 1;
    const now = performance.now();
    if (now - this.#since < EVERY) return;
    // What comes rarely, or to a page that nobody looks at, tells nothing.
    if (this.#came > 20 && this.#drawn > 5) this.#judge(this.#drawn >= ENOUGH * this.#came);
    [this.#came, this.#drawn, this.#since] = [0, 0, now];
  }

  #judge(isWell) {
    this.#well = isWell ? this.#well + 1 : 0;
    if (!isWell) {
      this.ratio = Math.max(LEAST, this.ratio * STEP);
      this.#patience *= 2;
    } else if (this.#well >= this.#patience) {
      this.ratio = Math.min(devicePixelRatio || 1, MOST, this.ratio / STEP);
      this.#well = 0;
    }
  }
}

/** Whether a graphics card draws: where a processor does, smooth edges would cost half of the pictures. */
export function drawsByCard() {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) return false;
  const named = gl.getExtension("WEBGL_debug_renderer_info")?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER;
  const name = String(gl.getParameter(named));
  gl.getExtension("WEBGL_lose_context")?.loseContext();
  return !/swiftshader|llvmpipe|software|basic render/i.test(name);
}
