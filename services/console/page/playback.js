// What was, shown again as fast as it happened.

/** A picture is asked for so often, ms. */
const EVERY = 40;

export class Playback {
  #timer = null;
  #go;

  /** @param go called with how many ms later the next picture is; gives whether there is more */
  constructor(go) {
    this.#go = go;
  }

  get runs() {
    return this.#timer !== null;
  }

  start() {
    this.stop();
    let last = performance.now();
    this.#timer = setInterval(() => {
      const now = performance.now();
      const passed = now - last;
      last = now;
      if (!this.#go(passed)) this.stop();
    }, EVERY);
  }

  stop() {
    clearInterval(this.#timer);
    this.#timer = null;
  }
}
