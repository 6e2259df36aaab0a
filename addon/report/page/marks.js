"use strict";
// What is drawn onto the pictures: marks of the pixels that differ, names, the frame of one pixel.

const DENSE = 0.12; // of a pane: so many marks would hide a picture, so they are drawn otherwise

const marking = { dense: new Set(), shared: false }; // of what is drawn now: what the note says

/** Mark the pixels that differ: each by its shape when near, else one a cell and cause. */
function drawMarks(context, pane, inMap) {
  const near = scaleNow() >= 10;
  const area = near ? scaleNow() ** 2 : CELL ** 2; // of a mark's place
  const size = near ? Math.min(0.6 * scaleNow(), 22) : 11;
  for (const [value, places] of markedPlaces(pane, near)) {
    const many = places.length * area > DENSE * pane.width * pane.height;
    const cause = CAUSES.get(value);
    if (many && !inMap) {
      marking.dense.add(value);
      if (near) drawCorners(context, cause, places);
      else drawPainted(context, pane, value);
      continue;
    }
    const own = many && !near ? 0.6 * size : size; // a texture on an area of its colour
    for (const [x, y] of places) drawGlyph(context, cause, x, y, own, many ? 1.2 : 1.9);
  }
}

/** Where marks would hide a picture from afar: the pixels themselves, in their cause's colour. */
function drawPainted(context, pane, value) {
  const s = scaleNow();
  const [x0, x1, y0, y1] = inView(pane);
  const [left, top] = toPane(pane, x0, y1);
  const from = [x0, HEIGHT - y1, x1 - x0, y1 - y0];
  context.imageSmoothingEnabled = s * (window.devicePixelRatio || 1) < 1;
  context.drawImage(paintedOf(value), ...from, left, top, (x1 - x0) * s, (y1 - y0) * s);
}

/** Where marks would hide a picture from near: a small one in a corner of each pixel. */
function drawCorners(context, cause, places) {
  const s = scaleNow();
  const size = clamp(0.28 * s, 3, 9);
  for (const [x, y] of places) drawGlyph(context, cause, x - 0.3 * s, y + 0.3 * s, size, 1);
}

/** Say how marks are drawn where not every pixel has one of its own. */
function drawMarksNote() {
  const near = scaleNow() >= 10;
  const dense = [...marking.dense].map((value) => CAUSES.get(value));
  const named = dense.map(({ label, pixels: n }) => `${label} (${count(n)} px)`).join(", ");
  const said = [];
  if (dense.length)
    said.push(
      near
        ? `Too many for a mark each: ${named}. These have a small one in a corner of each pixel.`
        : `Too many for a mark each: ${named}. These pixels are painted in their cause's colour.`,
    );
  if (marking.shared)
    said.push(`A mark stands for all pixels of its cause within ${CELL} screen pixels.`);
  if (state.mode === "all" && framesShown())
    said.push("Frames of regions are on the map of causes alone.");
  byId("marks-note").textContent = said.join(" ");
  byId("marks-note").hidden = !said.length;
}

/** Where a pane has marks, by cause. */
function markedPlaces(pane, near) {
  const [x0, x1, y0, y1] = inView(pane);
  const taken = new Set();
  const found = new Map();
  const { index, cause } = pixels.differing;
  for (let k = 0; k < index.length; k++) {
    const x = index[k] % WIDTH;
    const y = Math.floor(index[k] / WIDTH);
    if (x < x0 || x >= x1 || y < y0 || y >= y1 || !isShown(cause[k])) continue;
    if (near && x === state.x && y === state.y) continue; // its frame marks it: its colour is seen
    const place = toPane(pane, x + 0.5, y + 0.5);
    const cell = (Math.floor(place[1] / CELL) * 8192 + Math.floor(place[0] / CELL)) * 32 + cause[k];
    if (!near && taken.has(cell)) {
      marking.shared = true;
      continue;
    }
    taken.add(cell);
    if (!found.has(cause[k])) found.set(cause[k], []);
    found.get(cause[k]).push(place);
  }
  return found;
}

/** Frame the chosen pixel; from afar, a ring around it. */
function drawCursor(context, pane) {
  const s = scaleNow();
  const [left, top] = toPane(pane, state.x, state.y + 1);
  for (const [color, width] of [
    ["#000000", 4],
    ["#ffffff", 2],
  ]) {
    context.strokeStyle = color;
    context.lineWidth = width;
    context.beginPath();
    if (s >= 6) {
      context.rect(left - 2, top - 2, s + 4, s + 4); // around it, not on it
    } else {
      const [x, y] = [left + s / 2, top + s / 2];
      for (const [u, v] of [
        [1, 0],
        [-1, 0],
        [0, 1],
        [0, -1],
      ]) {
        context.moveTo(x + 9 * u, y + 9 * v);
        context.lineTo(x + 20 * u, y + 20 * v);
      }
    }
    context.stroke();
  }
}

/** Name a picture: the left one at the left, the right one at the right; and its colours. */
function drawLabel(context, pane, layer, k) {
  const size = parseFloat(getComputedStyle(document.documentElement).fontSize) * 0.85;
  let y = pane.y + 8;
  for (const [english, color] of [[layer.label, null], ...(layer.key ?? [])]) {
    const text = translated(english);
    context.font = `${color ? 400 : 600} ${size}px system-ui, sans-serif`;
    const sign = color ? 1.2 * size : 0;
    const width = context.measureText(text).width + sign + size;
    const x = k ? pane.x + pane.width - width - 8 : pane.x + 8;
    context.fillStyle = "#000000b8";
    context.beginPath();
    context.roundRect(x, y, width, 1.7 * size, 5);
    context.fill();
    context.fillStyle = color ?? "#ffffff";
    if (color) context.fillRect(x + size / 2, y + 0.4 * size, 0.9 * size, 0.9 * size);
    context.fillStyle = "#ffffff";
    context.textBaseline = "middle";
    context.fillText(text, x + size / 2 + sign, y + 0.88 * size);
    y += 1.9 * size;
  }
}
