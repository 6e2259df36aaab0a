"use strict";
// The inspector: everything that is known of the chosen pixel.

const AROUND = 5; // pixels on each side in the enlargements
const NEAR = 13; // screen pixels of each of them

function drawPixel() {
  const { x, y } = state;
  const pixel = y * WIDTH + x;
  byId("x").value = x;
  byId("y").value = y;
  byId("permalink").href = `#x=${x}&y=${y}`;
  byId("pixel").replaceChildren(
    causeOf(pixel),
    element("div", { class: "loupes" }, ...LOUPES().map((p) => loupe(p.id, x, y))),
    sidesOf(x, y, pixel),
    factsOf(x, y, pixel),
  );
}

/** The pictures that are enlarged; those of a fault put right are seen on the stage. */
const LOUPES = () => page.pictures.filter(({ id }) => !id.startsWith(PUT_RIGHT));

/** What is said of the pixel, in a sentence with its figure. */
function causeOf(pixel) {
  const cause = CAUSES.get(pixels.cause[pixel]);
  if (!cause) {
    return element(
      "p",
      { class: "cause", id: "cause" },
      element("strong", {}, "Agrees"),
      ` with ${OTHER}, within its rounding.`,
    );
  }
  return element(
    "p",
    { class: "cause", id: "cause" },
    glyphOf(cause, 22),
    element("strong", {}, `${cause.label}: `),
    reasonOf(cause, pixel),
  );
}

/** A cause's sentence, its figure filled in; of an unmodelled feature, which one it is. */
function reasonOf(cause, pixel) {
  const k = pixels.place[pixel];
  const [figure, allowed] = [pixels.differing.figure[k], pixels.differing.allowed[k]];
  const unmodelled = page.comparison.scene.unmodelled[figure];
  if (cause.name === "not_modelled" && unmodelled) {
    const { object, feature, detail } = unmodelled;
    return `${object}: ${feature}${detail ? ` (${detail})` : ""}`;
  }
  const hidden = page.comparison.hidden?.[figure];
  if (cause.name === "hidden" && hidden)
    return `only one side shows ${hidden.object}: ${hidden.reason}`;
  if (cause.sentence) return filled(cause.sentence, { figure, allowed });
  return Number.isNaN(figure) ? "" : `${general(figure, 3)} (allowed: ${general(allowed, 3)})`;
}

/** A picture around the pixel, enlarged. */
function loupe(id, x, y) {
  const side = 2 * AROUND + 1;
  const ratio = 2;
  const shown = element("canvas", {
    width: side * NEAR * ratio,
    height: side * NEAR * ratio,
    "aria-hidden": "true",
  });
  const context = shown.getContext("2d");
  context.imageSmoothingEnabled = false;
  const n = NEAR * ratio;
  drawBoard(context, 0, 0, shown.width, shown.height);
  context.drawImage(
    layers.get(id).canvas,
    x - AROUND,
    HEIGHT - 1 - y - AROUND,
    side,
    side,
    0,
    0,
    side * n,
    side * n,
  );
  for (const [color, width] of [
    ["#000000", 6],
    ["#ffffff", 3],
  ]) {
    context.strokeStyle = color;
    context.lineWidth = width;
    context.strokeRect(AROUND * n - 3, AROUND * n - 3, n + 6, n + 6);
  }
  return element("figure", {}, shown, element("figcaption", {}, layers.get(id).label));
}

/** The two sides: colours as numbers, object, triangle. */
function sidesOf(x, y, pixel) {
  const ids = ["traced", "blender"];
  const row = (name, cells, kind) =>
    element(
      "tr",
      {},
      element("th", { scope: "row" }, name),
      ...cells.map((cell) => element("td", { class: kind }, cell)),
    );
  const colors = ids.map((id) => shownColor(id, x, y));
  const linear = ids.map((id) => linearColor(id, x, y));
  const head = element(
    "tr",
    {},
    element("td"),
    ...ids.map((id) => element("th", { scope: "col" }, layers.get(id).label)),
  );
  return element(
    "table",
    { class: "sides", id: "sides" },
    element("thead", {}, head),
    element(
      "tbody",
      {},
      row("Screen", colors.map(swatch)),
      row(
        "of 255",
        colors.map((c) => [...c].join(" ")),
        "number",
      ),
      linear[0]
        ? row(
            "Linear",
            linear.map((c) => (c ? lines(c.map((v) => shortest(v, "float32"))) : "")),
            "number",
          )
        : null,
      row(
        "Object",
        ids.map((id) => {
          const object = objectOn(id, pixel);
          return id === "blender" && object === NOT_KNOWN ? objectByColor(pixel) : object;
        }),
      ),
      row(
        "Triangle",
        ids.map((id) => triangleOn(id, pixel)),
        "number",
      ),
    ),
  );
}

const lines = (values) =>
  element("span", { class: "lines" }, ...values.map((v) => element("span", {}, String(v))));

function swatch(rgba) {
  const hex = `#${[...rgba]
    .slice(0, 3)
    .map((v) => v.toString(16).padStart(2, "0"))
    .join("")}`;
  const made = element(
    "span",
    { class: "swatch" },
    element("i"),
    element("code", {}, rgba[3] ? hex : "transparent"),
  );
  made.firstChild.style.background = `rgba(${rgba[0]}, ${rgba[1]}, ${rgba[2]}, ${rgba[3] / 255})`;
  return made;
}

const NOT_KNOWN = "not known";

/** The object that a side shows: the traced one is known, Blender's from its identity picture. */
function objectOn(id, pixel) {
  if (id === "traced") {
    const number = pixels.surface[pixel];
    if (!number) return "nothing";
    return pixels.surfaces ? page.objects[surfaceOf(number).object] : NOT_KNOWN;
  }
  if (id !== "blender" || !pixels.identity) return NOT_KNOWN;
  const name = pixels.identity.shown[pixel];
  return name === -1 ? "nothing" : name < 0 ? NOT_KNOWN : page.comparison.identity.names[name];
}

let owners = null; // by colour: its object, or "" where several have it

/** The one object that has a pixel's colour of the picture, where the colours are clear. */
function objectByColor(pixel) {
  owners ??= findOwners();
  const [x, y] = [pixel % WIDTH, Math.floor(pixel / WIDTH)];
  const object = owners.get(String(shownColor("blender", x, y)));
  return object ? `${object}, by its colour` : NOT_KNOWN;
}

/** The colours that are traced where an object is all around: at its rim they may be mixed. */
function findOwners() {
  const found = new Map();
  if (!pixels.surfaces) return found;
  const { instance, instances } = pixels.surfaces;
  const at = Array.from(pixels.surface, (number) =>
    number ? page.object_of[instances[instance[number - 1]]] : -1,
  );
  at.forEach((object, pixel) => {
    if ([-1, 1, -WIDTH, WIDTH].some((step) => (at[pixel + step] ?? object) !== object)) return;
    const color = String(shownColor("traced", pixel % WIDTH, Math.floor(pixel / WIDTH)));
    const name = page.objects[object] ?? "nothing";
    found.set(color, (found.get(color) ?? name) === name ? name : "");
  });
  return found;
}

function triangleOn(id, pixel) {
  const surface = id === "traced" ? surfaceOf(pixels.surface[pixel]) : null;
  if (!surface) return "–";
  return surface.plane ? "infinite plane" : count(surface.triangle);
}

/** Where the traced t comes from: only a certified one is the exact value. */
function originOf(pixel) {
  if (pixels.certainty[pixel]) return "proven: the exact value, rounded once";
  return `by ${words(page.comparison.tracer.method)} in floating point, not proven`;
}

/** Certainty, t and barycentrics, each with what it is. */
function factsOf(x, y, pixel) {
  const certainty = page.certainties[pixels.certainty[pixel]];
  const surface = surfaceOf(pixels.surface[pixel]);
  const facts = [["Certainty", [element("strong", {}, certainty.name), `: ${certainty.sentence}`]]];
  if (surface)
    facts.push(
      ["Facing", [VALUES.facing(pixel)]],
      ["Normal", [lines(normalOf(surface.number).map((v) => shortest(v)))]],
    );
  const t = tracedT(pixel);
  if (surface && t !== null)
    facts.push(["t", [element("span", { id: "t" }, shortest(t)), ` m (${originOf(pixel)})`]]);
  if (surface && !surface.plane) {
    const { s } = derive(x, y, surface, "float64");
    facts.push(["s₁ s₂ s₃", [lines(s.map((v) => shortest(v)))]]);
  }
  return element(
    "dl",
    { class: "facts", id: "facts" },
    ...facts.flatMap(([name, values]) => [element("dt", {}, name), element("dd", {}, ...values)]),
  );
}

onChange(["x", "y"], drawPixel);
