"use strict";
// The line below the pictures: the value of the picture under the pointer, in words.

let pointed = null; // where the pointer is on the canvas; null: the line tells of the chosen pixel

/** Which picture a pane shows at a place: in the slider, the one on that side of its line. */
function pictureAt(pane, px) {
  const [left, right] = pane.ids;
  return right && px >= pane.x + pane.width * state.split ? right : left;
}

function drawReadout() {
  const found = pointed && fromCanvas(pointed.x, pointed.y);
  const [pane] = panes();
  const ids = found ? [pictureAt(found.pane, pointed.x)] : [...new Set(shownNow(pane))];
  const [x, y] = found ? [Math.floor(found.x), Math.floor(found.y)] : [state.x, state.y];
  const there = x >= 0 && y >= 0 && x < WIDTH && y < HEIGHT;
  const told = (id) => `${layers.get(id).label}: ${valueAt(id, x, y, ids.length > 1)}`;
  const text = there ? `(${x}, ${y})  ${ids.map(told).join("  ·  ")}` : "";
  byId("readout").textContent = byId("readout").title = text;
}

/** The pictures on the left and right, with their values in the chosen pixel. */
function shownNow(pane) {
  if (state.mode === "swap") return pane.ids;
  return state.mode === "slider" && state.split <= 0.02
    ? [state.right]
    : [state.left, state.right];
}

canvas.addEventListener("pointermove", (event) => {
  if (event.pointerType === "touch") return;
  pointed = placeOf(event);
  drawReadout();
});
canvas.addEventListener("pointerleave", () => {
  pointed = null;
  drawReadout();
});
onChange(["x", "y", "left", "right", "mode", "swapped", "split", "view"], drawReadout);
