"use strict";
// What is drawn onto the pictures: marks of the pixels that differ, names, the frame of one pixel.

/** Mark the pixels that differ: each by its shape when near, else one a cell and cause. */
function drawMarks(context, pane) {
  const s = scaleNow();
  const [x0, x1, y0, y1] = inView(pane);
  const near = s >= 10;
  const taken = new Set();
  const { index, cause } = pixels.differing;
  for (let k = 0; k < index.length; k++) {
    const x = index[k] % WIDTH;
    const y = Math.floor(index[k] / WIDTH);
    if (x < x0 || x >= x1 || y < y0 || y >= y1 || !isShown(cause[k])) continue;
    const [px, py] = toPane(pane, x + 0.5, y + 0.5);
    if (!near) {
      const cell = (Math.floor(py / CELL) * 8192 + Math.floor(px / CELL)) * 32 + cause[k];
      if (taken.has(cell)) continue;
      taken.add(cell);
    }
    drawGlyph(context, CAUSES.get(cause[k]), px, py, near ? Math.min(0.6 * s, 22) : 11, near ? 2 : 1.8);
  }
}

/** Frame the pixel that is looked at; from afar, a ring around it. */
function drawCursor(context, pane) {
  const s = scaleNow();
  const [left, top] = toPane(pane, state.x, state.y + 1);
  for (const [color, width] of [["#000000", 4], ["#ffffff", 2]]) {
    context.strokeStyle = color;
    context.lineWidth = width;
    context.beginPath();
    if (s >= 6) {
      context.rect(left - 1, top - 1, s + 2, s + 2);
    } else {
      const [x, y] = [left + s / 2, top + s / 2];
      for (const [u, v] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
        context.moveTo(x + 9 * u, y + 9 * v);
        context.lineTo(x + 20 * u, y + 20 * v);
      }
    }
    context.stroke();
  }
}

/** Name a picture: the left one at the left, the right one at the right. */
function drawLabel(context, pane, layer, k) {
  const size = parseFloat(getComputedStyle(document.documentElement).fontSize) * 0.85;
  context.font = `600 ${size}px system-ui, sans-serif`;
  const width = context.measureText(layer.label).width + size;
  const x = k ? pane.x + pane.width - width - 8 : pane.x + 8;
  context.fillStyle = "#000000b8";
  context.beginPath();
  context.roundRect(x, pane.y + 8, width, 1.7 * size, 5);
  context.fill();
  context.fillStyle = "#ffffff";
  context.textBaseline = "middle";
  context.fillText(layer.label, x + size / 2, pane.y + 8 + 0.88 * size);
}
