"use strict";
// The stage: panes that show pictures through one view, the marks on them, and the pixel's frame.

const canvas = byId("canvas");
const stage = byId("stage");
const MOST = 128; // screen pixels a pixel, at the nearest
const CELL = 18; // screen pixels: at most one mark of a cause in each
const GRID = 14; // from so many screen pixels a pixel on, there are lines between them

/** The panes side by side: where each is on the canvas, and the pictures in it. */
function panes() {
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (state.mode === "slider")
    return [{ x: 0, y: 0, width, height, ids: [state.left, state.right] }];
  if (state.mode === "swap") {
    return [{ x: 0, y: 0, width, height, ids: [state.swapped ? state.right : state.left] }];
  }
  const ids = state.mode === "pair" ? [state.left, state.right] : [...layers.keys()];
  const across = state.mode === "pair" ? 2 : Math.ceil(Math.sqrt(ids.length));
  const down = Math.ceil(ids.length / across);
  const [w, h] = [width / across, height / down];
  return ids.map((id, k) => ({
    x: (k % across) * w,
    y: Math.floor(k / across) * h,
    width: w,
    height: h,
    ids: [id],
  }));
}

/** Screen pixels a pixel so that all of the picture is seen in a pane. */
function fitScale() {
  const [pane] = panes();
  return Math.min(pane.width / WIDTH, pane.height / HEIGHT);
}

const scaleNow = () => state.view.scale || fitScale();

/** From picture (x to the right, y up) to canvas coordinates in a pane. */
function toPane(pane, x, y) {
  const s = scaleNow();
  return [
    pane.x + pane.width / 2 + (x - state.view.x) * s,
    pane.y + pane.height / 2 - (y - state.view.y) * s,
  ];
}

/** From canvas coordinates to the picture. */
function fromCanvas(px, py) {
  const pane = panes().find(
    (p) => px >= p.x && px < p.x + p.width && py >= p.y && py < p.y + p.height,
  );
  if (!pane) return null;
  const s = scaleNow();
  return {
    x: state.view.x + (px - pane.x - pane.width / 2) / s,
    y: state.view.y - (py - pane.y - pane.height / 2) / s,
    pane,
  };
}

/** Set the view; it never leaves the picture, and is never farther off than all of it. */
function setView(x, y, scale) {
  const fit = fitScale();
  if (scale <= fit * 1.001) {
    change({ view: { x: WIDTH / 2, y: HEIGHT / 2, scale: 0 } });
    return;
  }
  const [pane] = panes();
  const s = Math.min(scale, MOST);
  const middle = (value, size, seen) =>
    seen >= size ? size / 2 : clamp(value, seen / 2 - 1, size - seen / 2 + 1);
  change({
    view: { x: middle(x, WIDTH, pane.width / s), y: middle(y, HEIGHT, pane.height / s), scale: s },
  });
}

/** Zoom, so that a place in the picture stays where it is on the screen. */
function zoomAbout(factor, x = state.x + 0.5, y = state.y + 0.5) {
  const s = scaleNow();
  const next = clamp(s * factor, fitScale(), MOST);
  const keep = s / next;
  setView(x + (state.view.x - x) * keep, y + (state.view.y - y) * keep, next);
}

/** Move the view so that the chosen pixel is in it. */
function follow() {
  const [pane] = panes();
  const s = scaleNow();
  const [halfX, halfY] = [pane.width / s / 2 - 1, pane.height / s / 2 - 1];
  const [px, py] = [state.x + 0.5, state.y + 0.5];
  if (!state.view.scale) return;
  if (Math.abs(px - state.view.x) > halfX || Math.abs(py - state.view.y) > halfY) {
    setView(px, py, s);
  }
}

/** Move the slider's line off the chosen pixel, to its right. */
function keepClear() {
  const [pane] = panes();
  const s = scaleNow();
  const [left] = toPane(pane, state.x, state.y);
  const border = pane.x + pane.width * state.split;
  if (state.mode === "slider" && border > left - GRID && border < left + s + GRID)
    change({ split: clamp((left + s + GRID - pane.x) / pane.width, 0, 1) });
}

let waiting = false;
/** Draw at the next frame, however often it is asked for until then. */
function redraw() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(() => {
    waiting = false;
    draw();
  });
}

function draw() {
  const ratio = window.devicePixelRatio || 1;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const context = canvas.getContext("2d");
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.fillStyle = getComputedStyle(stage).backgroundColor;
  context.fillRect(0, 0, width, height);
  marking.dense.clear();
  marking.shared = false;
  for (const pane of panes()) drawPane(context, pane);
  drawMarksNote();
  const split = byId("split");
  split.hidden = state.mode !== "slider";
  split.style.setProperty("--split", state.split);
  split.setAttribute("aria-valuenow", Math.round(100 * state.split));
  byId("zoom").value = `${count(Math.round(100 * scaleNow()))} %`;
  canvas.setAttribute("aria-label", stageLabel());
}

function stageLabel() {
  const names = [...new Set(panes().flatMap((pane) => pane.ids))].map((id) => layers.get(id).label);
  return `Pictures: ${names.join(", ")}; pixel (${state.x}, ${state.y})`;
}

function drawPane(context, pane) {
  context.save();
  clip(context, pane.x, pane.y, pane.width, pane.height);
  const border = pane.x + pane.width * state.split;
  const onEach = (draw) =>
    pane.ids.forEach((id, k) => {
      context.save();
      if (pane.ids.length > 1) {
        const start = k ? border : pane.x;
        clip(context, start, pane.y, (k ? pane.x + pane.width : border) - start, pane.height);
      }
      draw(id);
      context.restore();
    });
  onEach((id) => {
    drawPicture(context, pane, layerOf(id));
    if (state.marks || id === "causes") drawMarks(context, pane, id === "causes");
  });
  pane.ids.forEach((id, k) => drawLabel(context, pane, layers.get(id), k));
  onEach((id) => {
    if (id === "causes" || (state.marks && state.mode !== "all")) drawFrames(context, pane);
  });
  drawCursor(context, pane);
  if (pane.x) line(context, pane.x, pane.y, pane.x, pane.y + pane.height);
  if (pane.y) line(context, pane.x, pane.y, pane.x + pane.width, pane.y);
  context.restore();
}

function clip(context, x, y, width, height) {
  context.beginPath();
  context.rect(x, y, Math.max(width, 0), height);
  context.clip();
}

function line(context, x0, y0, x1, y1, color = "#00000066", width = 1) {
  context.strokeStyle = color;
  context.lineWidth = width;
  context.beginPath();
  context.moveTo(x0, y0);
  context.lineTo(x1, y1);
  context.stroke();
}

/** The whole pixels that a pane shows: x0, x1, y0, y1 from the lower left. */
function inView(pane) {
  const s = scaleNow();
  const [w, h] = [pane.width / s / 2, pane.height / s / 2];
  return [
    clamp(Math.floor(state.view.x - w), 0, WIDTH),
    clamp(Math.ceil(state.view.x + w), 0, WIDTH),
    clamp(Math.floor(state.view.y - h), 0, HEIGHT),
    clamp(Math.ceil(state.view.y + h), 0, HEIGHT),
  ];
}

function drawPicture(context, pane, layer) {
  const s = scaleNow();
  const [x0, x1, y0, y1] = inView(pane);
  const [left, top] = toPane(pane, x0, y1);
  const [width, height] = [(x1 - x0) * s, (y1 - y0) * s];
  drawBoard(context, left, top, width, height);
  context.imageSmoothingEnabled = s * (window.devicePixelRatio || 1) < 1;
  context.imageSmoothingQuality = "high";
  context.drawImage(layer.canvas, x0, HEIGHT - y1, x1 - x0, y1 - y0, left, top, width, height);
  if (s < GRID) return;
  for (let x = x0; x <= x1; x++)
    line(context, left + (x - x0) * s, top, left + (x - x0) * s, top + height, "#80808059");
  for (let y = y0; y <= y1; y++)
    line(context, left, top + (y - y0) * s, left + width, top + (y - y0) * s, "#80808059");
}

/** What shows through where a picture is transparent. */
function drawBoard(context, left, top, width, height) {
  const tile = document.createElement("canvas");
  tile.width = tile.height = 16;
  const small = tile.getContext("2d");
  const style = getComputedStyle(stage);
  small.fillStyle = style.getPropertyValue("--board");
  small.fillRect(0, 0, 16, 16);
  small.fillStyle = style.getPropertyValue("--board-2");
  small.fillRect(0, 0, 8, 8);
  small.fillRect(8, 8, 8, 8);
  context.fillStyle = context.createPattern(tile, "repeat");
  context.fillRect(left, top, width, height);
}
