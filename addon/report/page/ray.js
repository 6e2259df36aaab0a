"use strict";
// One ray of the textbook (Exercise 1): from the camera, and with a surface. The numbers are those of
// `tracer/camera.py`, `plane.py` and `triangle.py`, to the last bit.

const camera = page.camera;
const column = (k, sign = 1) => camera.world_from_camera.slice(0, 3).map((row) => sign * row[k]);
const AXES = { right: column(0), up: column(1), forward: column(2, -1), origin: column(3) };

// What tells the types of cameras apart, by their `projection`: how their rays begin and where they
// go, as formulas and as arithmetic, of a film position u, v.
const CAMERAS = new Map([
  [
    "perspective",
    {
      origin: "o = camera",
      direction: "d = u right + v up + forward",
      ray: (axes, u, v, { plus, times }) => [
        axes.origin,
        plus(plus(times(u, axes.right), times(v, axes.up)), axes.forward),
      ],
    },
  ],
  [
    "orthographic",
    {
      origin: "o = camera + u right + v up",
      direction: "d = forward",
      ray: (axes, u, v, { plus, times }) => [
        plus(axes.origin, plus(times(u, axes.right), times(v, axes.up))),
        axes.forward,
      ],
    },
  ],
  [
    "equirectangular",
    {
      origin: "o = camera",
      direction: "d = cos v sin u right + sin v up + cos v cos u forward",
      ray: (axes, u, v, { round, mul, plus, times }) => {
        const level = round(sine(v, 1));
        const east = times(mul(level, round(sine(u, 0))), axes.right);
        const ahead = times(mul(level, round(sine(u, 1))), axes.forward);
        return [axes.origin, plus(plus(east, times(round(sine(v, 0)), axes.up)), ahead)];
      },
    },
  ],
]);

// pi / 2, in parts.
const QUARTER = [1.57079632673412561417, 6.07710050630396597660e-11, 2.02226624879595063154e-21];

/** The sine of an angle plus so many right angles, as `projections/sine.py` has it. */
function sine(angle, quarters) {
  const turns = Math.floor(angle * (2 / Math.PI) + 0.5);
  const rest = QUARTER.reduce((left, part) => left - turns * part, angle);
  const series = (first) => {
    let out = 1;
    for (let k = first + 16; k > 0; k -= 2) out = 1 - ((rest * rest) / (k * (k + 1))) * out;
    return out;
  };
  const quarter = (((turns + quarters) % 4) + 4) % 4;
  const found = quarter % 2 ? series(1) : rest * series(2);
  return quarter < 2 ? found : -found;
}

const projection = CAMERAS.get(camera.projection);

/** The ray x = o + t d through the centre of a pixel. */
function cameraRay(x, y, precision) {
  const numbers = arithmetic(precision);
  const { round, add, mul } = numbers;
  const { left, right, bottom, top } = camera.window;
  const film = [x + camera.region.x0 + 0.5, y + camera.region.y0 + 0.5];
  const size = [(right - left) / camera.width, (top - bottom) / camera.height].map(round);
  const u = add(round(left), mul(round(film[0]), size[0]));
  const v = add(round(bottom), mul(round(film[1]), size[1]));
  const axes = Object.fromEntries(Object.entries(AXES).map(([name, a]) => [name, a.map(round)]));
  const [origin, direction] = projection.ray(axes, u, v, numbers);
  return { film, size, u, v, origin, direction };
}

/** A surface by its number (1 is the first): its object, and its corners in the world. */
function surfaceOf(number) {
  const s = pixels.surfaces;
  if (!s || !number) return null;
  const k = number - 1;
  const instance = s.instances[s.instance[k]];
  const triangle = s.triangle[k];
  const plane = page.planes.find((p) => p.instance === instance) ?? null;
  const object = page.object_of[instance];
  return { number, instance, triangle, plane, object, corners: plane ? null : cornersOf(k) };
}

/** world_from_object . v in float64, as `tracer/vector.py` sums it. */
function cornersOf(k) {
  const { vertices, matrices, corners, instance } = pixels.surfaces;
  const m = matrices.subarray(12 * instance[k], 12 * instance[k] + 12);
  return [0, 1, 2].map((corner) => {
    const first = 3 * corners[3 * k + corner];
    const [x, y, z] = vertices.subarray(first, first + 3);
    return [0, 4, 8].map((i) => m[i] * x + m[i + 1] * y + m[i + 2] * z + m[i + 3]);
  });
}

/** Ray and infinite plane, with every intermediate result. */
function meetPlane(ray, plane, precision) {
  const { round } = arithmetic(precision);
  const given = { o: ray.origin, d: ray.direction, p: plane.point, n: plane.normal };
  for (const name of ["p", "n"]) given[name] = given[name].map(round);
  const met = evaluateAll(page.formulas.plane, given, precision);
  return met.towards === 0 ? { ...met, t: NaN } : met; // parallel: no hit
}

/** Ray and triangle, with every intermediate result; `s` weighs p₁, p₂, p₃. */
function meetTriangle(ray, corners, precision) {
  const { round } = arithmetic(precision);
  const [p1, p2, p3] = corners.map((corner) => corner.map(round));
  const given = { o: ray.origin, d: ray.direction, "p₁": p1, "p₂": p2, "p₃": p3 };
  const met = evaluateAll(page.formulas.triangle, given, precision);
  const s = [met.s1, met.s2, met.s3];
  const inside = s.every((value) => value >= 0 && value <= 1);
  const tolerance = round(page.tolerance[precision]);
  const near = Math.abs(round(met.sum - 1)) <= tolerance;
  const literal = inside && met.sum === 1;
  return { ...met, s, inside, tolerance, literal, textbook: inside && near };
}

/** Whether t lies in the camera's clip range. */
const inClip = (t) => t >= camera.clip_start && t <= camera.clip_end;

/** The whole derivation of a pixel's ray with one surface. */
function derive(x, y, surface, precision) {
  const ray = cameraRay(x, y, precision);
  if (!surface) return { ray };
  const met = surface.plane
    ? meetPlane(ray, surface.plane, precision)
    : meetTriangle(ray, surface.corners, precision);
  return { ray, ...met, clipped: !inClip(met.t) };
}

/** The t that was traced, to the last bit; null where it is not in the page. */
function tracedT(pixel) {
  const surface = surfaceOf(pixels.surface[pixel]);
  if (!surface) return pixels.surface[pixel] ? null : Infinity;
  if (!pixels.t_offset) return null;
  const { t } = derive(pixel % WIDTH, Math.floor(pixel / WIDTH), surface, "float64");
  const numbered = pixels.t_offset[pixel]; // 0, -1, 1, -2, 2... as 0, 1, 2, 3, 4...
  return ulpsAbove(Number.isFinite(t) ? t : 0, (numbered >> 1n) ^ -(numbered & 1n));
}

/** The surfaces that a pixel and its eight neighbours see, its own first. */
function candidatesOf(x, y) {
  const numbers = new Set([pixels.surface[y * WIDTH + x]]);
  for (let j = Math.max(0, y - 1); j <= Math.min(HEIGHT - 1, y + 1); j++) {
    for (let i = Math.max(0, x - 1); i <= Math.min(WIDTH - 1, x + 1); i++) {
      numbers.add(pixels.surface[j * WIDTH + i]);
    }
  }
  numbers.delete(0);
  return [...numbers].map(surfaceOf);
}
