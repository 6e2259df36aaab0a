"use strict";
// The layers that show the scene whatever its colours: each is drawn when it is first chosen.

const FARTHEST = 0.1; // grey of the farthest hit, so that it does not look like a hole
const BACK = [255, 102, 102]; // of what is seen from behind, as in `coloring.py`
const GOLDEN = 0.61803398875; // of a turn: neighbours in a list are far apart in colour

function addMaps() {
  if (!pixels.surfaces) return; // `left_out` says so
  const lazy = (id, label, note, draw) =>
    layers.set(id, { ...emptyLayer(id, label, note), draw, drawn: false });
  lazy("objects", "Objects", "a colour for each object", () =>
    paint("objects", (pixel) => objectColor(surfaceOf(pixels.surface[pixel]).object), true),
  );
  lazy("facing", "Facing", "grey from the front, red from behind", drawFacing);
  lazy("normal", "Normal", "x, y, z as red, green, blue", () =>
    paint("normal", (pixel) => normalOf(pixels.surface[pixel]).map((v) => 127.5 * (v + 1)), true),
  );
  lazy("depth", "Depth", "the nearer, the lighter", drawDepth);
  lazy("triangles", "Triangles", "a colour for each triangle", () =>
    paint("triangles", (pixel) => triangleColor(pixels.surface[pixel]), true),
  );
}

/** A layer by its id, drawn. */
function layerOf(id) {
  const layer = layers.get(id);
  if (layer.drawn === false) {
    layer.drawn = true;
    layer.draw();
  }
  return layer;
}

/** Draw a layer: the colour [r, g, b] of each pixel that sees a surface, once for each if so. */
function paint(id, colorAt, ofSurface = false) {
  const layer = layers.get(id);
  const image = new ImageData(WIDTH, HEIGHT);
  const known = new Map();
  for (let pixel = 0; pixel < pixels.surface.length; pixel++) {
    const number = pixels.surface[pixel];
    if (!number) continue;
    let color = known.get(number);
    if (!color) {
      color = colorAt(pixel);
      if (ofSurface) known.set(number, color);
    }
    const i = offsetOf(pixel % WIDTH, Math.floor(pixel / WIDTH));
    image.data[i] = color[0];
    image.data[i + 1] = color[1];
    image.data[i + 2] = color[2];
    image.data[i + 3] = 255;
  }
  layer.canvas.getContext("2d").putImageData(image, 0, 0);
  layer.values = image.data;
}

/** A colour that no object near it in the list has: hues and three lightnesses in turn. */
function objectColor(object) {
  return hsl(object * GOLDEN, 0.62, [0.58, 0.42, 0.72][object % 3]);
}

/** A colour by a surface's number, its bits mixed, so that neighbours differ. */
function triangleColor(number) {
  const mixed = Math.imul(number ^ (number >>> 7), 2654435761) >>> 0;
  return hsl((mixed & 0xffff) / 0x10000, 0.55, 0.35 + (0.4 * (mixed >>> 16)) / 0x10000);
}

/** [r, g, b] of 255 from a hue in turns, saturation and lightness. */
function hsl(hue, saturation, lightness) {
  const reach = saturation * Math.min(lightness, 1 - lightness);
  return [0, 8, 4].map((n) => {
    const k = (n + 12 * (hue - Math.floor(hue))) % 12;
    return Math.round(255 * (lightness - reach * Math.max(-1, Math.min(k - 3, 9 - k, 1))));
  });
}

function drawFacing() {
  layers.get("facing").key = [
    ["front", "#ffffff"],
    ["back", "#ff6666"],
  ];
  paint("facing", (pixel) => {
    const cosine = cosineAt(pixel);
    return cosine > 0 ? BACK.map((v) => cosine * v) : [0, 0, 0].fill(-255 * cosine);
  });
}

function drawDepth() {
  const found = Float64Array.from(pixels.surface, (_, pixel) => roughDepth(pixel));
  let [near, far] = [Infinity, -Infinity];
  for (const t of found) {
    if (!Number.isFinite(t)) continue;
    near = Math.min(near, t);
    far = Math.max(far, t);
  }
  layers.get("depth").key = [
    [`${general(near, 4)} m`, "#ffffff"],
    [`${general(far, 4)} m`, "#1a1a1a"],
  ];
  paint("depth", (pixel) => {
    const share = Number.isFinite(found[pixel]) ? (found[pixel] - near) / (far - near || 1) : 1;
    return [0, 0, 0].fill(255 * (1 - (1 - FARTHEST) * share));
  });
}
