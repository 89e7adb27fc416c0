// Words beside the things in the scene: elements that are moved, for a canvas over the whole scene would be drawn anew each time.

/** Height of a line, pixels. */
const LINE = 20;

export class Words {
  /** Elements that are used again: what each says, and where. */
  #pool = [];

  constructor(place) {
    this.place = place;
  }

  /**
   * What would cover a word that stands already goes above it.
   * @param {{text: string, place: number[], strong?: boolean}[]} words
   * @param {(place: number[]) => {x: number, y: number} | null} project
   */
  show(words, project) {
    const stand = [];
    words.sort((a, b) => Number(b.strong ?? false) - Number(a.strong ?? false));
    words.forEach(({ text, place, strong }, index) => {
      const at = project(place);
      const entry = (this.#pool[index] ??= this.#made());
      const half = text.length * 4 + 4;
      const covers = () => stand.some((other) => Math.abs(other.x - at.x) < half + other.half && Math.abs(other.y - at.y) < LINE);
      for (let tries = 0; at && tries < 4 && covers(); tries += 1) at.y -= LINE;
      if (at) stand.push({ x: at.x, y: at.y, half });
      entry.tell(at ? text : "", at ? `translate(${Math.round(at.x)}px, ${Math.round(at.y)}px) translate(-50%, -80%)` : "", strong ? "strong" : "");
    });
    for (const entry of this.#pool.slice(words.length)) entry.tell("", "", "");
  }

  /** Says one thing in place of all. */
  say(text) {
    this.show([{ text, place: [] }], () => ({ x: this.place.clientWidth / 2, y: this.place.clientHeight / 2 }));
  }

  #made() {
    const element = document.createElement("span");
    this.place.append(element);
    const last = ["", "", ""];
    return {
      tell(text, transform, name) {
        if (last[0] !== text) element.textContent = last[0] = text;
        if (last[1] !== transform) element.style.transform = last[1] = transform;
        if (last[2] !== name) element.className = last[2] = name;
      },
    };
  }
}
