"use strict";
// A drawing: shapes of plane coordinates, y up, cut off at its frame, with labels beside points.

const [DRAWN_WIDTH, DRAWN_HEIGHT] = [440, 340]; // at most: a flat drawing is less high
const AROUND_DRAWN = 46; // around what is fitted, for labels
const FRAME = 4; // from the drawing's edge to the frame at which shapes are cut off
const LETTERS = 16; // legible where a drawing is as narrow as a phone
const HEAD = 9; // length of an arrow's head
const TOGETHER = 7; // of points that are this near, the names are one label
const REACHES = [9, 18, 30, 46, 64]; // from a point to its label's edge
const WAYS = 16; // around a point
const FAR = 18; // from where on a line leads to the label

class Plate {
  /** A drawing that holds the `fitted` points; `title` is for those who hear it. */
  constructor(name, title, fitted) {
    const ends = [Math.min, Math.max].map((end) =>
      [0, 1].map((k) => end(...fitted.map((p) => p[k]))),
    );
    const [wide, high] = [0, 1].map((k) => Math.max(ends[1][k] - ends[0][k], 1e-300));
    const room = [DRAWN_WIDTH, DRAWN_HEIGHT].map((size) => size - 2 * AROUND_DRAWN);
    this.scale = Math.min(room[0] / wide, room[1] / high); // to the drawing's units
    this.height = Math.min(high * this.scale + 2 * AROUND_DRAWN, DRAWN_HEIGHT);
    this.middle = [0, 1].map((k) => ends[0][k] / 2 + ends[1][k] / 2);
    Object.assign(this, { name, title, shapes: [], edges: [], labels: [] });
  }

  at([x, y]) {
    const [mx, my] = this.middle;
    return [DRAWN_WIDTH / 2 + (x - mx) * this.scale, this.height / 2 - (y - my) * this.scale];
  }

  add(name, attributes) {
    this.shapes.push(svgElement(name, attributes));
  }

  /** The part of a polygon, or of a line as one of two points, within the frame. */
  inFrame(points) {
    let inside = points.filter((p) => p.every(Number.isFinite));
    [DRAWN_WIDTH, this.height].forEach((size, k) => {
      inside = kept(inside, (p) => p[k] - FRAME);
      inside = kept(inside, (p) => size - FRAME - p[k]);
    });
    return inside;
  }

  /** Draw the polygon or the line of points, as far as it is in the frame. */
  shape(name, points, kind, closed = true) {
    const places = points.map((p) => this.at(p));
    const lines = places.slice(1).map((p, k) => [places[k], p]);
    for (const part of closed ? [places] : lines) {
      const inside = this.inFrame(part);
      if (inside.length < 2) continue;
      const path = { points: inside.map((p) => p.join()).join(" "), "data-name": name };
      this.add(closed ? "polygon" : "polyline", { ...path, class: kind });
      this.edges.push(...inside.map((p, k) => [inside.at(k - 1), p]));
    }
  }

  arrow(name, start, end, kind) {
    this.shape(name, [start, end], kind, false);
    const [tip, foot] = [this.at(end), this.at(start)];
    const length = Math.hypot(tip[0] - foot[0], tip[1] - foot[1]);
    if (length < 2 * HEAD) return;
    const [x, y] = [0, 1].map((k) => ((tip[k] - foot[k]) / length) * HEAD);
    const side = (sign) => [tip[0] - x - sign * 0.45 * y, tip[1] - y + sign * 0.45 * x];
    this.add("polygon", { points: [tip, side(1), side(-1)].join(" "), class: "head" });
  }

  /** Draw a dot with words beside it, if it is in the frame. */
  point(name, point, words, kind = "point") {
    const [cx, cy] = this.at(point);
    const inside = (place, size) => place > FRAME && place < size - FRAME;
    if (!inside(cx, DRAWN_WIDTH) || !inside(cy, this.height)) return;
    this.add("circle", { cx, cy, r: 4, "data-name": name, class: kind });
    const near = this.labels.find(
      ({ at, free }) => !free && Math.hypot(at[0] - cx, at[1] - cy) <= TOGETHER,
    );
    if (near) near.words += `, ${words}`;
    else this.labels.push({ words, at: [cx, cy], free: false });
  }

  /** Write words on a point, or beside it with a line to it. */
  words(point, words) {
    this.labels.push({ words, at: this.at(point), free: true });
  }

  /** The drawing as an element. */
  svg() {
    const taken = [];
    for (const label of this.labels) taken.push(this.placed(label, taken));
    return svgElement(
      "svg",
      {
        viewBox: `0 0 ${DRAWN_WIDTH} ${this.height}`,
        role: "img",
        "aria-label": this.title,
        "data-name": this.name,
        "data-scale": this.scale,
      },
      ...this.shapes,
      ...taken.filter(({ away }) => away > FAR).map(lead),
      ...taken.map(({ words, x, y }) =>
        svgElement("text", { x, y: y + 0.35 * LETTERS, "font-size": LETTERS }, words),
      ),
    );
  }

  /** A label at the best place that is left for it. */
  placed({ words, at, free }, taken) {
    const [wide, high] = [widthOf(words, LETTERS) / 2 + 3, 0.7 * LETTERS];
    const tries = free ? [{ x: at[0], y: at[1], away: 0 }] : [];
    for (const away of REACHES) {
      for (let k = 0; k < WAYS; k++) {
        const angle = (2 * Math.PI * k) / WAYS;
        const x = at[0] + Math.cos(angle) * (away + wide);
        tries.push({ x, y: at[1] + Math.sin(angle) * (away + high), away });
      }
    }
    const boxes = tries.map((place) => ({ ...place, words, at, wide, high }));
    const costs = boxes.map((box) => this.cost(box, taken));
    return boxes[costs.indexOf(Math.min(...costs))];
  }

  /** What makes a place bad: the way to it, and worse, what it lies on. */
  cost(box, taken) {
    const { x, y, wide, high, away } = box;
    const over = (p, room = 0) => Math.abs(p[0] - x) < wide + room && Math.abs(p[1] - y) < high + room;
    const outside =
      Math.min(x, DRAWN_WIDTH - x) < wide + FRAME || Math.min(y, this.height - y) < high + FRAME;
    const on = taken.filter(
      (other) => Math.abs(other.x - x) < other.wide + wide && Math.abs(other.y - y) < other.high + high,
    );
    const dots = this.labels.filter(({ at, free }) => !free && over(at, 5));
    const crossed = this.edges.filter((edge) => alongLine(edge).some((p) => over(p)));
    const most = outside * 1e5 + on.length * 1e4;
    return away + most + dots.length * 600 + crossed.length * 60;
  }
}

/** Points of a line, near enough to one another to find what is written over it. */
function alongLine([[x, y], [u, v]]) {
  const pieces = 1 + Math.ceil(Math.hypot(u - x, v - y) / HEAD);
  return Array.from({ length: pieces + 1 }, (_, k) => [
    x + ((u - x) * k) / pieces,
    y + ((v - y) * k) / pieces,
  ]);
}

/** A line from a point to the edge of its words. */
function lead({ at, x, y, wide, high }) {
  const over = Math.max(Math.abs(x - at[0]) / wide, Math.abs(y - at[1]) / high);
  const share = Math.max(1 - 1 / over, 0);
  const [x2, y2] = [at[0] + share * (x - at[0]), at[1] + share * (y - at[1])];
  return svgElement("line", { x1: at[0], y1: at[1], x2, y2, class: "lead" });
}

/** The part of a polygon in which a linear function is not negative (Sutherland and Hodgman). */
function kept(points, inside) {
  return points.flatMap((b, k) => {
    const a = points.at(k - 1);
    const [from, to] = [inside(a), inside(b)];
    const crossing = a.map((v, i) => v + (b[i] - v) * (from / (from - to)));
    return [...(from >= 0 !== to >= 0 ? [crossing] : []), ...(to >= 0 ? [b] : [])];
  });
}
