"use strict";
// What a pixel's ray meets, as the tracer's passes have it: object, facing, normal, depth, triangle.
// All of it follows from the surface that is seen there.

const hitNormals = new Map(); // by the surface's number

/** The unit normal of a surface; mirroring an instance does not turn it inside out. */
function normalOf(number) {
  if (!hitNormals.has(number)) hitNormals.set(number, findNormal(surfaceOf(number)));
  return hitNormals.get(number);
}

function findNormal(surface) {
  if (surface.plane) return unit(surface.plane.normal);
  const { minus, cross } = arithmetic("float64");
  const [p1, p2, p3] = surface.corners.map((corner) => corner.map((v) => v / 4));
  const n = cross(nearOne(minus(p2, p1)), nearOne(minus(p3, p1)));
  const place = pixels.surfaces.instance[surface.number - 1];
  const m = pixels.surfaces.matrices.subarray(12 * place, 12 * place + 12);
  const [x, y, z] = [0, 1, 2].map((i) => nearOne([m[i], m[i + 4], m[i + 8]]));
  const mirrored = arithmetic("float64").dot(cross(x, y), z) < 0;
  return unit(mirrored ? n.map((v) => -v) : n);
}

/** A vector with its largest component at 1, so that no product overflows. */
function nearOne(v) {
  const largest = Math.max(...v.map(Math.abs));
  return largest > 0 && Number.isFinite(largest) ? v.map((c) => c / largest) : v;
}

function unit(v) {
  const near = nearOne(v);
  const length = Math.hypot(...near);
  return length > 0 ? near.map((c) => c / length) : near;
}

/** The cosine between a pixel's ray and its normal: a front's is less than 0. */
function cosineAt(pixel) {
  const { direction } = cameraRay(pixel % WIDTH, Math.floor(pixel / WIDTH), "float64");
  return arithmetic("float64").dot(normalOf(pixels.surface[pixel]), unit(direction));
}

/** "front", "back" or "edge-on"; "none" where nothing is seen. */
function facingAt(pixel) {
  if (!pixels.surface[pixel]) return "none";
  const cosine = cosineAt(pixel);
  return cosine < 0 ? "front" : cosine > 0 ? "back" : "edge-on";
}

/** About how far off a pixel's surface is, in metres, as a picture needs it: `tracedT` is exact. */
function roughDepth(pixel) {
  const number = pixels.surface[pixel];
  if (!number) return Infinity;
  const ray = cameraRay(pixel % WIDTH, Math.floor(pixel / WIDTH), "float64");
  const { dot, minus } = arithmetic("float64");
  const n = normalOf(number);
  return dot(n, minus(pointOf(number), ray.origin)) / dot(n, ray.direction);
}

const hitPoints = new Map(); // by the surface's number

function pointOf(number) {
  if (!hitPoints.has(number)) {
    const surface = surfaceOf(number);
    hitPoints.set(number, surface.plane ? surface.plane.point : surface.corners[0]);
  }
  return hitPoints.get(number);
}

/** A picture's value at a pixel, in words; `short` leaves the linear colour to the inspector. */
function valueAt(id, x, y, short = false) {
  const pixel = y * WIDTH + x;
  const told = VALUES[id];
  if (told) return told(pixel, x, y);
  const screen = [...shownColor(id, x, y)].join(" ");
  const linear = short ? null : linearColor(id, x, y);
  return linear
    ? `${screen} of 255; linear ${linear.map((v) => shortest(v, "float32")).join(" ")}`
    : `${screen} of 255`;
}

const VALUES = {
  causes: (pixel) => {
    const cause = CAUSES.get(pixels.cause[pixel]);
    return cause ? `${cause.label}: ${reasonOf(cause, pixel)}` : "agrees";
  },
  certainty: (pixel) => {
    const { name, sentence } = page.certainties[pixels.certainty[pixel]];
    return `${name}: ${sentence}`;
  },
  objects: (pixel) => {
    const [traced, shown] = ["traced", "blender"].map((id) => objectOn(id, pixel));
    if (shown === traced || shown === NOT_KNOWN) return traced;
    return `${traced}; in ${layers.get("blender").label}: ${shown}`;
  },
  facing: (pixel) => {
    const facing = facingAt(pixel);
    return facing === "none" ? facing : `${facing} (cosine ${general(-cosineAt(pixel), 4)})`;
  },
  normal: (pixel) => {
    const number = pixels.surface[pixel];
    if (!number) return "none";
    const [x, y, z] = normalOf(number).map((v) => general(v, 6));
    return `x ${x}  y ${y}  z ${z}`;
  },
  depth: (pixel) => {
    const t = tracedT(pixel);
    if (t === null) return NOT_KNOWN;
    return Number.isFinite(t) ? `${shortest(t)} m` : "none";
  },
  triangles: (pixel) => {
    const number = pixels.surface[pixel];
    if (!number) return "none";
    const { plane, triangle, object } = surfaceOf(number);
    return `${page.objects[object]}, ${plane ? "infinite plane" : `triangle ${count(triangle)}`}`;
  },
};
