"use strict";
// What is drawn of a derivation: the film, the surface's plane, and the view from the side.
//
// All points are the textbook's numbers in float64, which the tables have; none is moved. What has no
// place in a drawing, as a plane that the ray never meets, is left out.

const PIECES = 24; // of a film that is a part of a sphere, and of an edge on it
const NEARBY = 4.5; // pixels on each side of the ray, in the drawing from near
const FAR_APART = 5; // so much longer is t than d, or d than t: a drawing of the nearer end helps
const CORNERS = ["p₁", "p₂", "p₃"];
const V = arithmetic("float64");

// Where a point appears on the film, of its right, up and forward; `middle` is the ray's own u.
const FILMS = {
  perspective: ([x, y, z]) => [x / z, y / z],
  orthographic: ([x, y]) => [x, y],
  equirectangular: ([x, y, z], middle) => {
    const longitude = Math.atan2(x, z);
    const turns = Math.round((longitude - middle) / (2 * Math.PI));
    return [longitude - 2 * Math.PI * turns, Math.atan2(y, Math.hypot(x, z))];
  },
};

/** All drawings, each with its caption. */
function drawings(drawn) {
  const view = viewOf(drawn);
  if (!view) return [];
  const plates = [film(view)];
  if (!view.bends) plates.push(near(view));
  if (view.meets) plates.push(plane(view));
  plates.push(...sides(view));
  return plates.map(([plate, caption]) =>
    element("figure", {}, plate.svg(), element("figcaption", {}, caption)),
  );
}

/** The numbers that drawings need; null where they cannot be drawn. */
function viewOf({ projection, title, steps }) {
  const known = (key) => steps[key]?.every((v) => v !== null && Math.abs(v) < 1e100);
  const { right, up, forward, eye, o, d } = steps;
  const across = V.cross(up, forward);
  const size = V.dot(right, across);
  const all = ["right", "up", "forward", "eye", "o", "d", "left", "right_end", "bottom", "top"];
  if (!(projection in FILMS) || !all.every(known) || !size) return null;
  const axes = [across, V.cross(forward, right), V.cross(right, up)];
  const turned = (v) => axes.map((axis) => V.dot(v, axis) / size);
  const names = steps.p1 ? CORNERS : ["p"];
  const corners = (steps.p1 ? ["p1", "p2", "p3"] : ["p"]).filter(known).map((key) => steps[key]);
  const at = [steps.u[0], steps.v[0]];
  return {
    ...{ title, steps, projection, up, forward, at, o, d, names, turned },
    corners: corners.length === names.length ? corners : [],
    film: [[steps.left[0], steps.bottom[0]], [steps.right_end[0], steps.top[0]]],
    pixel: [steps.width[0], steps.height[0]],
    bends: projection === "equirectangular",
    seen: (point) => turned(V.minus(point, eye)),
    meets: [...["t", "x", "n"], ...(steps.p1 ? ["p1", "p2", "p3"] : ["p"])].every(known) &&
      steps.n.some(Boolean),
    t: steps.t?.[0],
  };
}

/** Where the edges of a polygon in the world appear on the film. */
function onFilm({ seen, projection, bends, at }, points) {
  const ends = bends ? points.flatMap((p, k) => inPieces(p, points[(k + 1) % points.length])) : points;
  const places = ends.map(seen);
  const nearest = 1e-6 * Math.max(...places.flat().map(Math.abs));
  const before = projection === "perspective" ? kept(places, ([, , z]) => z - nearest) : places;
  return before.map((place) => FILMS[projection](place, at[0]));
}

const inPieces = (from, to) =>
  Array.from({ length: PIECES }, (_, k) => V.plus(from, V.times(k / PIECES, V.minus(to, from))));

/** Draw the surface on the film. */
function outline(view, plate) {
  if (view.corners.length < 3) return;
  const points = onFilm(view, view.corners);
  if (points.length > 2) plate.shape("triangle", points, "surface");
  view.corners.forEach((corner, k) => {
    for (const place of onFilm(view, [corner]).slice(0, 1)) plate.point(CORNERS[k], place, CORNERS[k]);
  });
}

const rectangle = ([left, bottom], [right, top]) => [
  [left, bottom],
  [right, bottom],
  [right, top],
  [left, top],
];
const named = (value) => general(value, 4);

function film(view) {
  const [[left, bottom], [right, top]] = view.film;
  const [u, v] = view.at;
  const plate = new Plate("film", "The film plane with the pixel", view.film);
  plate.shape("film", rectangle(...view.film), "film");
  outline(view, plate);
  for (const [name, value, foot] of [["u", u, [u, bottom]], ["v", v, [left, v]]]) {
    plate.shape(name, [view.at, foot], "thin", false);
    plate.point(name, foot, `${name} = ${named(value)}`, "foot");
  }
  plate.point("pixel", view.at, "pixel", "x");
  const caption =
    `The film: u from ${named(left)} to ${named(right)}, v from ${named(bottom)} to ` +
    `${named(top)}. The ray passes it in the middle of the pixel.`;
  return [plate, caption];
}

function near(view) {
  const { at, pixel: step } = view;
  const around = (pixels) => [-pixels, pixels].map((k) => at.map((v, i) => v + k * step[i]));
  const [low, high] = around(NEARBY);
  const plate = new Plate("pixel", "The pixel from near", [low, high]);
  for (let k = -NEARBY; k <= NEARBY; k++) {
    const [x, y] = at.map((v, i) => v + k * step[i]);
    plate.shape("grid", [[x, low[1]], [x, high[1]]], "grid", false);
    plate.shape("grid", [[low[0], y], [high[0], y]], "grid", false);
  }
  outline(view, plate);
  plate.shape("square", rectangle(...around(0.5)), "square");
  plate.point("pixel", at, "u, v", "x");
  const size = step.map(named).join(" × ");
  return [
    plate,
    `The film from near: each square is a pixel, ${size}; the ray passes through the middle of its own.`,
  ];
}

/** Draw the surface in its own plane, seen from the side that the ray comes from. */
function plane(view) {
  const { steps, title } = view;
  const { x } = steps;
  const unit = (v) => {
    const whole = V.times(1 / Math.max(...v.map(Math.abs)), v);
    return V.times(1 / Math.hypot(...whole), whole);
  };
  const n = V.times(steps.towards[0] > 0 ? -1 : 1, unit(steps.n)); // towards the eye
  const across = unit(V.cross(Math.abs(V.dot(n, view.up)) < 0.9 ? view.up : view.forward, n));
  const upwards = V.cross(n, across);
  const points = view.corners.map((corner) => {
    const way = V.minus(corner, x);
    return [V.dot(way, across), V.dot(way, upwards)];
  });
  const at = [0, 0];
  const plate = new Plate("plane", `${title} in its plane, with x`, [...points, at]);
  if (points.length === 1) plate.shape("way", [points[0], at], "thin", false);
  const shares = points.length === 1 ? [] : ["s1", "s2", "s3"].map((key) => steps[key][0]);
  shares.forEach((share, k) => {
    const area = [at, points.at(k - 2), points.at(k - 1)];
    plate.shape(`s${k + 1}`, area, `s${k + 1}${share < 0 ? " negative" : ""}`);
    const middle = [0, 1].map((i) => (area[1][i] + area[2][i]) / 3);
    plate.words(middle, `s${"₁₂₃"[k]} = ${named(share)}`);
  });
  if (shares.length) plate.shape("triangle", points, "outline");
  points.forEach((point, k) => plate.point(view.names[k], point, view.names[k]));
  plate.point("x", at, "x", "x");
  if (!shares.length)
    return [plate, `${title}, in its plane: its point p, and x, where the ray meets it.`];
  const where = shares.every((s) => s >= 0)
    ? "x is inside: all three are at least 0."
    : "x is outside: a negative one is dashed, on the far side of its edge.";
  const what = "Each sᵢ is the share of the area between x and the edge across from pᵢ;";
  return [plate, `${title}, in its plane, from the ray’s side. ${what} ${where}`];
}

/** The view from the side; where t and d differ much, also its nearer end by itself. */
function sides(view) {
  const { meets, t } = view;
  const about = meets ? Math.abs(t) : 1;
  const found = [side(view, "side", meets, true)];
  if (about > FAR_APART) found.push(side(view, "eye", false, true));
  else if (about < 1 / FAR_APART) found.push(side(view, "eye", true, false));
  return found;
}

/** Draw o, d and the film, x and the surface, or both, seen along the camera's right. */
function side(view, name, withX, withFilm) {
  const { steps, bends, t } = view;
  const turned = view.turned(view.d);
  const level = bends ? Math.max(Math.hypot(turned[0], turned[2]), 1e-300) : 1;
  const [lx, lz] = bends ? [turned[0] / level, turned[2] / level] : [0, 1];
  const flat = ([x, y, z]) => [lx * x + lz * z, y];
  const [o, along] = [flat(view.seen(view.o)), flat(turned)];
  const tip = [o[0] + along[0], o[1] + along[1]];
  const filmLine = filmFromTheSide(view);
  const corners = view.corners.map((corner) => flat(view.seen(corner)));
  const x = view.meets ? flat(view.seen(steps.x)) : o;
  const fitted = [o];
  if (withFilm) fitted.push(...filmLine, tip);
  if (withX) fitted.push(x, ...(name === "side" && corners.length > 1 ? corners : []));
  const title = name === "side" ? "The ray from the side" : "The beginning of the ray";
  const plate = new Plate(name, title, fitted);
  plate.shape("film", filmLine, "film", false);
  if (view.meets) {
    if (corners.length > 1) plate.shape("triangle", corners, "surface");
    plate.shape("ray", [o, x], "ray", false);
  }
  if (withX) {
    plate.words([(o[0] + x[0]) / 2, (o[1] + x[1]) / 2], `t = ${named(t)} m`);
    corners.forEach((corner, k) => plate.point(view.names[k], corner, view.names[k]));
    plate.point("x", x, "x", "x");
  }
  plate.arrow("d", o, tip, "d");
  plate.point("o", o, "o");
  if (withFilm && Math.hypot(...along) * plate.scale > 24) {
    plate.point("tip", tip, "d", "foot");
    plate.words(filmLine.at(-1), "film");
  }
  const where = bends ? "up and the way that the ray goes" : "up and forward";
  const end = withX ? `, and meets x at t = ${named(t)} m.` : ".";
  const caption = `From the side, by the camera’s ${where}: from o the ray goes along d${end}`;
  return [plate, name === "side" ? caption : `Its beginning, by itself. ${caption}`];
}

/** The film as a line: at depth 1, where the rays begin, or on the unit sphere. */
function filmFromTheSide({ film: [[, bottom], [, top]], bends, projection }) {
  if (!bends) return [bottom, top].map((v) => [projection === "orthographic" ? 0 : 1, v]);
  return Array.from({ length: PIECES }, (_, k) => {
    const angle = bottom + ((top - bottom) * k) / (PIECES - 1);
    return [Math.cos(angle), Math.sin(angle)];
  });
}
