// Making elements.

/** An element of this name that says `text`. */
export function element(name, text, className = "") {
  return Object.assign(document.createElement(name), { textContent: text, className });
}
