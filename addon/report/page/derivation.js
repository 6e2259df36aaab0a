"use strict";
// The derivation: the textbook's steps with this pixel's numbers, in float64 and float32.

const PRECISIONS = ["float64", "float32"];
let chosen = 0; // the number of the surface that is derived, where it is not the pixel's own

function drawDerivation() {
  const { x, y } = state;
  const own = page.derivations.find(({ pixel }) => pixel[0] === x && pixel[1] === y);
  byId("fragment").replaceChildren();
  if (own) byId("fragment").append(exactDerivation(own));
  if (!pixels.surfaces) {
    byId("derivation").replaceChildren(
      element(
        "p",
        { class: "muted" },
        "The triangles are not in this page: it would be too large.",
      ),
    );
    return;
  }
  const candidates = candidatesOf(x, y);
  const surface = candidates.find((c) => c.number === chosen) ?? candidates[0] ?? null;
  const results = PRECISIONS.map((precision) => derive(x, y, surface, precision));
  byId("derivation").replaceChildren(
    ...[
      candidatesTable(x, y, candidates, surface),
      stepsTable(surface, results),
      errata(surface),
    ].filter(Boolean),
  );
}

/** The derivation that came with the page, below this page's own headings. */
function exactDerivation(own) {
  const summary = "Every candidate in float32, float64 and exactly";
  return element("details", { class: "exact" }, element("summary", {}, summary), lecture(own, 2));
}

/** The surfaces seen here and in the eight pixels around, each accepted or rejected. */
function candidatesTable(x, y, candidates, surface) {
  if (!candidates.length) {
    return element(
      "p",
      { class: "muted" },
      "This ray meets nothing, and neither do those of the pixels around it.",
    );
  }
  const own = pixels.surface[y * WIDTH + x];
  const nearest = tracedT(y * WIDTH + x) ?? Infinity;
  const rows = candidates.map((candidate) => {
    const met = derive(x, y, candidate, "float64");
    const name = `${page.objects[candidate.object]}${candidate.plane ? "" : ` · triangle ${count(candidate.triangle)}`}`;
    const pick = element(
      "button",
      {
        type: "button",
        class: "pick",
        "aria-pressed": String(candidate === surface),
        onclick: () => {
          chosen = candidate.number;
          drawDerivation();
        },
      },
      name,
    );
    return [
      pick,
      shortest(met.t),
      ...(met.s ?? ["–", "–", "–"]).map((v) => (typeof v === "number" ? general(v, 4) : v)),
      verdictOn(
        met,
        candidate.number === own
          ? "it is what is seen"
          : met.t > nearest
            ? "but it lies behind"
            : "",
      ),
    ];
  });
  return table(
    "What this ray may meet: the surfaces seen in this pixel and the eight around it: t by the textbook’s formula in float64",
    ["Surface", "t", "s₁", "s₂", "s₃", "Textbook"],
    rows,
    [1, 2, 3, 4],
  );
}

/** What the textbook says of a ray and a surface, and why. */
function verdictOn(met, more) {
  const yes = more ? `accepted: ${more}` : "accepted";
  if (!met.s)
    return Number.isNaN(met.t) ? "rejected: parallel" : met.clipped ? "rejected: clipped" : yes;
  const outside = met.s
    .map((v, i) => (v < 0 ? `s${"₁₂₃"[i]} < 0` : v > 1 ? `s${"₁₂₃"[i]} > 1` : ""))
    .filter(Boolean);
  if (outside.length) return `rejected: ${outside.join(", ")}`;
  if (!met.textbook) return "rejected: no sum of 1";
  return met.clipped ? "rejected: clipped" : yes;
}

/** What is wrong in the printed formulas, and what the numbers here are. */
function errata(surface) {
  if (!surface || surface.plane) return null;
  return element(
    "details",
    { class: "errata", open: true },
    element("summary", {}, "Two errata of the exercise"),
    element("ol", {}, ...page.errata.map((erratum) => element("li", {}, erratum))),
    element(
      "p",
      { class: "muted" },
      "Digits of float32 ",
      element("mark", { class: "off" }, "marked like this"),
      " differ from float64 by more than one rounding. This page computes every number by the textbook’s formula, in the tracer’s order of operations: in float64 and in float32 they have the bits of its method Textbook. A proven t, as beside the pictures, is another number: the exact value, rounded once.",
    ),
  );
}

onChange(["x", "y"], () => {
  chosen = 0;
  drawDerivation();
});
