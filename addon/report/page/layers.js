"use strict";
// The pictures that can be shown: those of the JSON, and maps that are drawn from the numbers.

// By id: { id, label, note, canvas, values, key: what its colours mean }.
const layers = new Map();

const DIM = 0.42; // of what agrees, on the screen

async function loadLayers() {
  for (const picture of page.pictures) layers.set(picture.id, await loadPicture(picture));
  layers.set("causes", emptyLayer("causes", "Causes", "why pixels differ"));
  drawCauses();
  if (pixels.certainty.some((c) => c !== 1)) {
    layers.set("certainty", emptyLayer("certainty", "Certainty", "how each pixel was decided"));
    drawCertainty();
  }
  addMaps();
}

function emptyLayer(id, label, note) {
  const canvas = document.createElement("canvas");
  canvas.width = WIDTH;
  canvas.height = HEIGHT;
  return { id, label, note, canvas, values: null };
}

/** Where a pixel's red is in an image, which has its first row on top. */
const offsetOf = (x, y) => 4 * ((HEIGHT - 1 - y) * WIDTH + x);

/** Draw the map of causes over the traced picture, dimmed and grey. */
function drawCauses() {
  const traced = layers.get("traced").values;
  const layer = layers.get("causes");
  const image = new ImageData(WIDTH, HEIGHT);
  for (let i = 0; i < traced.length; i += 4) {
    const light = 0.2126 * traced[i] + 0.7152 * traced[i + 1] + 0.0722 * traced[i + 2];
    image.data.fill(DIM * light * (traced[i + 3] / 255), i, i + 3);
    image.data[i + 3] = 255;
  }
  pixels.differing.index.forEach((pixel, k) => {
    const cause = CAUSES.get(pixels.differing.cause[k]);
    if (cause && isShown(cause.value)) {
      image.data.set(rgbOf(cause.color), offsetOf(pixel % WIDTH, Math.floor(pixel / WIDTH)));
    }
  });
  layer.canvas.getContext("2d").putImageData(image, 0, 0);
  layer.values = image.data;
}

function drawCertainty() {
  const layer = layers.get("certainty");
  const there = [...new Set(pixels.certainty)].sort();
  layer.key = there.map((c) => [page.certainties[c].name, page.certainties[c].color]);
  const colors = new Map(there.map((c) => [c, [...rgbOf(page.certainties[c].color), 255]]));
  const image = new ImageData(WIDTH, HEIGHT);
  for (let pixel = 0; pixel < pixels.certainty.length; pixel++) {
    const i = offsetOf(pixel % WIDTH, Math.floor(pixel / WIDTH));
    image.data.set(colors.get(pixels.certainty[pixel]), i);
  }
  layer.canvas.getContext("2d").putImageData(image, 0, 0);
  layer.values = image.data;
}

const painted = new Map(); // by cause

/** A canvas with a cause's pixels in its colour, and nothing else. */
function paintedOf(value) {
  if (!painted.has(value)) {
    const { canvas } = emptyLayer();
    const image = new ImageData(WIDTH, HEIGHT);
    const color = [...rgbOf(CAUSES.get(value).color), 255];
    pixels.differing.index.forEach((pixel, k) => {
      if (pixels.differing.cause[k] !== value) return;
      image.data.set(color, offsetOf(pixel % WIDTH, Math.floor(pixel / WIDTH)));
    });
    canvas.getContext("2d").putImageData(image, 0, 0);
    painted.set(value, canvas);
  }
  return painted.get(value);
}

/** [r, g, b] of #rrggbb. */
const rgbOf = (hex) => [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16));

/** The colour that a screen shows at a pixel, [r, g, b, a] of 255. */
const shownColor = (id, x, y) => layerOf(id).values.slice(offsetOf(x, y), offsetOf(x, y) + 4);

/** The linear colour of a pixel, [r, g, b, a]; null where the page does not have it. */
function linearColor(id, x, y) {
  const colors = pixels.colors?.[id];
  const first = 4 * (y * WIDTH + x);
  return colors ? [...colors.subarray(first, first + 4)] : null;
}

onChange(["only"], drawCauses);
