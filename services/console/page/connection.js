// The line to the server: comes back by itself when it is lost, and gives what is told to those who listen.

/** Pauses before a new try, ms: the last one is repeated. */
const PAUSES = [300, 600, 1000, 2000, 4000];

export class Connection extends EventTarget {
  #socket = null;
  #failed = 0;
  #over = false;

  constructor() {
    super();
    this.#open();
  }

  /** Whether something that is sent arrives. */
  get isOpen() {
    return this.#socket?.readyState === WebSocket.OPEN;
  }

  /** @param {object} request one key, as the server's `Request` has it */
  send(request) {
    if (this.isOpen) this.#socket.send(JSON.stringify(request));
  }

  /** The run is over: a line that is lost then is not opened again. */
  finish() {
    this.#over = true;
  }

  #open() {
    const token = new URLSearchParams(location.search).get("token") ?? "";
    const socket = new WebSocket(`ws://${location.host}/live?token=${encodeURIComponent(token)}`);
    socket.binaryType = "arraybuffer";
    let opened = false;
    socket.onopen = () => {
      opened = true;
      this.#failed = 0;
      this.#tell("open");
    };
    socket.onmessage = ({ data }) => {
      if (typeof data !== "string") return this.#tell("picture", data);
      const message = parsed(data);
      if (message) this.#tell(message.kind, message);
    };
    socket.onclose = () => {
      if (this.#over) return;
      this.#failed += 1;
      this.#tell("lost", {});
      if (!opened) this.#askWhy();
      setTimeout(() => this.#open(), PAUSES[Math.min(this.#failed, PAUSES.length) - 1]);
    };
    this.#socket = socket;
  }

  /** Who serves the page but opens no line does not know its token. */
  async #askWhy() {
    const served = await fetch("icon.svg", { cache: "no-store" }).catch(() => null);
    if (served?.ok && !this.isOpen) this.#tell("unwanted", {});
  }

  #tell(kind, detail) {
    this.dispatchEvent(new CustomEvent(kind, { detail }));
  }
}

/** A message with its kind; what is none is passed over. */
function parsed(text) {
  try {
    const message = JSON.parse(text);
    return typeof message?.kind === "string" ? message : null;
  } catch {
    return null;
  }
}
