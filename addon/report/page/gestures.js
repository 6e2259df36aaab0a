"use strict";
// Pointer, wheel and fingers on the stage.

const STILL = 4; // screen pixels that a click may move
const fingers = new Map(); // pointers that are down, by id: where each was last
let travelled = 0;

/** A pointer's place on the canvas. */
function placeOf(event) {
  const box = canvas.getBoundingClientRect();
  return { x: event.clientX - box.left, y: event.clientY - box.top };
}

canvas.addEventListener("pointerdown", (event) => {
  if (event.button) return;
  canvas.setPointerCapture(event.pointerId);
  if (!fingers.size) travelled = 0;
  fingers.set(event.pointerId, placeOf(event));
});

canvas.addEventListener("pointermove", (event) => {
  const before = fingers.get(event.pointerId);
  if (!before) return;
  const now = placeOf(event);
  travelled += Math.hypot(now.x - before.x, now.y - before.y);
  if (fingers.size === 2) pinch(event.pointerId, before, now);
  else if (travelled > STILL) {
    const s = scaleNow();
    setView(state.view.x - (now.x - before.x) / s, state.view.y + (now.y - before.y) / s, s);
  }
  fingers.set(event.pointerId, now);
});

/** Zoom by as much as two fingers part, about the one that stays. */
function pinch(moving, before, now) {
  const [other] = [...fingers].filter(([id]) => id !== moving).map(([, place]) => place);
  const span = (place) => Math.max(Math.hypot(place.x - other.x, place.y - other.y), 1);
  const about = fromCanvas(other.x, other.y);
  if (about) zoomAbout(span(now) / span(before), about.x, about.y);
}

canvas.addEventListener("pointerup", (event) => {
  if (fingers.delete(event.pointerId) && !fingers.size && travelled <= STILL) {
    const place = placeOf(event);
    const found = fromCanvas(place.x, place.y);
    if (found) select(Math.floor(found.x), Math.floor(found.y));
  }
});
canvas.addEventListener("pointercancel", (event) => fingers.delete(event.pointerId));

// Zooming out stops at the whole picture; from there the wheel scrolls the page, as elsewhere.
canvas.addEventListener(
  "wheel",
  (event) => {
    if (event.deltaY > 0 && !state.view.scale) return;
    event.preventDefault();
    const place = placeOf(event);
    const found = fromCanvas(place.x, place.y);
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 30 : 1;
    if (found) zoomAbout(Math.exp(-0.0022 * lines * event.deltaY), found.x, found.y);
  },
  { passive: false },
);

// In hover swap the right picture is seen while the pointer is over the left one.
canvas.addEventListener("pointerenter", () => state.mode === "swap" && change({ swapped: true }));
canvas.addEventListener("pointerleave", () => state.mode === "swap" && change({ swapped: false }));

const handle = byId("split");
const moveSplit = (share) => change({ split: clamp(share, 0, 1) });

handle.addEventListener("pointerdown", (event) => {
  handle.setPointerCapture(event.pointerId);
  event.preventDefault();
  handle.focus();
});
handle.addEventListener("pointermove", (event) => {
  if (!handle.hasPointerCapture(event.pointerId)) return;
  const box = canvas.getBoundingClientRect();
  moveSplit((event.clientX - box.left) / box.width);
});
handle.addEventListener("keydown", (event) => {
  const step = {
    ArrowLeft: -0.02,
    ArrowRight: 0.02,
    Home: -1,
    End: 1,
    PageUp: 0.1,
    PageDown: -0.1,
  }[event.key];
  if (step === undefined) return;
  event.preventDefault();
  event.stopPropagation();
  moveSplit(state.split + step);
});
