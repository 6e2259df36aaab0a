"use strict";
// The packed arrays of `page` -> `pixels`. Pixel (x, y) counts from the lower left of the picture, and
// is number y * width + x of every array.

const [WIDTH, HEIGHT] = page.size;
const pixels = {};

const TYPES = {
  uint8: Uint8Array,
  int32: Int32Array,
  uint32: Uint32Array,
  uint64: BigUint64Array,
  float32: Float32Array,
  float64: Float64Array,
};

/** Undo `arrays.packed`: base64, deflate, and the bytes sorted by their place in a number. */
async function unpack({ type, data }) {
  const letters = atob(data);
  const deflated = new Uint8Array(letters.length);
  for (let i = 0; i < letters.length; i++) deflated[i] = letters.charCodeAt(i);
  const stream = new Blob([deflated]).stream().pipeThrough(new DecompressionStream("deflate"));
  const planes = new Uint8Array(await new Response(stream).arrayBuffer());
  const bytes = TYPES[type].BYTES_PER_ELEMENT;
  if (bytes === 1) return planes;
  const count = planes.length / bytes;
  const sorted = new Uint8Array(planes.length);
  for (let b = 0; b < bytes; b++) {
    for (let i = 0; i < count; i++) sorted[i * bytes + b] = planes[b * count + i];
  }
  return new TYPES[type](sorted.buffer); // the least byte first, as in all browsers' machines
}

/** Unpack whatever is packed in a value, however deep. */
async function unpackAll(value) {
  if (value === null || typeof value !== "object") return value;
  if (typeof value.data === "string" && value.type in TYPES) return unpack(value);
  if (Array.isArray(value)) return value;
  const entries = Object.entries(value).map(async ([key, v]) => [key, await unpackAll(v)]);
  return Object.fromEntries(await Promise.all(entries));
}

/** Fill `pixels`: what the JSON has of every pixel, and the cause of each. */
async function loadPixels() {
  Object.assign(pixels, await unpackAll(page.pixels));
  pixels.cause = new Uint8Array(WIDTH * HEIGHT);
  pixels.place = new Int32Array(WIDTH * HEIGHT).fill(-1); // of a pixel among those that differ
  pixels.differing.index.forEach((pixel, k) => {
    pixels.cause[pixel] = pixels.differing.cause[k];
    pixels.place[pixel] = k;
  });
}

/** Decode an image, its own pixels in `values` (RGBA, the first row on top). */
async function loadPicture({ id, label, note, png }) {
  const image = new Image();
  image.src = png;
  await image.decode();
  const canvas = document.createElement("canvas");
  canvas.width = image.naturalWidth;
  canvas.height = image.naturalHeight;
  const context = canvas.getContext("2d", { willReadFrequently: true });
  context.drawImage(image, 0, 0);
  return {
    id,
    label,
    note,
    canvas,
    values: context.getImageData(0, 0, canvas.width, canvas.height).data,
  };
}
