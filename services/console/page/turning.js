// How the scene is turned and zoomed: by the right button, by any finger or button where it moves no hand, by wheel and by two fingers.

/**
 * @param {HTMLCanvasElement} canvas
 * @param {{camera: () => object | undefined, movesHand: () => boolean, lift: (by: number) => void, changed: () => void}} page
 */
export function listenForTurning(canvas, { camera, movesHand, lift, changed }) {
  const fingers = new Map();
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("pointerdown", (event) => {
    fingers.set(event.pointerId, event);
    if (event.buttons & 2) canvas.setPointerCapture(event.pointerId);
  });
  for (const kind of ["pointerup", "pointercancel", "pointerleave"]) {
    canvas.addEventListener(kind, (event) => fingers.delete(event.pointerId));
  }
  canvas.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before || !camera()) return;
    if (fingers.size === 2) {
      const other = [...fingers.values()].find(({ pointerId }) => pointerId !== event.pointerId);
      const apart = (one) => Math.hypot(one.offsetX - other.offsetX, one.offsetY - other.offsetY);
      camera().zoom(apart(before) / Math.max(apart(event), 1));
    } else if (event.buttons & 2 || event.altKey || !movesHand()) {
      camera().turn(event.offsetX - before.offsetX, event.offsetY - before.offsetY);
    }
    fingers.set(event.pointerId, event);
    changed();
  });
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    // Some browsers scroll sideways while shift is held.
    if (event.shiftKey && movesHand()) lift(-Math.sign(event.deltaY || event.deltaX));
    else camera()?.zoom(event.deltaY > 0 ? 1.1 : 0.9);
    changed();
  }, { passive: false });
}
