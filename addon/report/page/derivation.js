"use strict";
// The derivation: the textbook's steps with this pixel's numbers, in float64 and float32.

const PRECISIONS = ["float64", "float32"];
const VECTORS = new Set(["o", "d", "n", "x", "p", "right", "up", "forward"]);
let chosen = 0; // the number of the surface that is derived, where it is not the pixel's own

function drawDerivation() {
  const { x, y } = state;
  const own = page.derivations.find(({ pixel }) => pixel[0] === x && pixel[1] === y);
  byId("fragment").replaceChildren();
  if (own) byId("fragment").append(exactDerivation(own.html));
  if (!pixels.surfaces) {
    byId("derivation").replaceChildren(element("p", { class: "muted" }, "The triangles are not in this page: it would be too large."));
    return;
  }
  const candidates = candidatesOf(x, y);
  const surface = candidates.find((c) => c.number === chosen) ?? candidates[0] ?? null;
  const results = PRECISIONS.map((precision) => derive(x, y, surface, precision));
  byId("derivation").replaceChildren(
    ...[candidatesTable(x, y, candidates, surface), stepsTable(surface, results), errata(surface)].filter(Boolean));
}

/** The derivation that was written with the page: the project's own markup, names escaped in it. */
function exactDerivation(html) {
  const inner = element("div");
  inner.innerHTML = html;
  for (const heading of inner.querySelectorAll("h1, h2, h3")) { // they stand below this page's own
    heading.setAttribute("aria-level", Number(heading.localName[1]) + 2);
  }
  return element("details", { class: "exact" }, element("summary", {}, "Every candidate in float32, float64 and exactly"), inner);
}

/** The surfaces seen here and in the eight pixels around, each accepted or rejected. */
function candidatesTable(x, y, candidates, surface) {
  if (!candidates.length) {
    return element("p", { class: "muted" }, "This ray meets nothing, and neither do those of the pixels around it.");
  }
  const own = pixels.surface[y * WIDTH + x];
  const nearest = tracedT(y * WIDTH + x) ?? Infinity;
  const rows = candidates.map((candidate) => {
    const met = derive(x, y, candidate, "float64");
    const name = `${page.objects[candidate.object]}${candidate.plane ? "" : ` · triangle ${count(candidate.triangle)}`}`;
    const pick = element("button", { type: "button", class: "pick", "aria-pressed": String(candidate === surface),
      onclick: () => { chosen = candidate.number; drawDerivation(); } }, name);
    return [pick, shortest(met.t), ...(met.s ?? ["–", "–", "–"]).map((v) => (typeof v === "number" ? general(v, 4) : v)),
      verdictOn(met, candidate.number === own ? "it is what is seen" : met.t > nearest ? "but it lies behind" : "")];
  });
  return table("What this ray may meet: the surfaces seen in this pixel and the eight around it (float64)",
    ["Surface", "t", "s₁", "s₂", "s₃", "Textbook"], rows, [1, 2, 3, 4]);
}

/** What the textbook says of a ray and a surface, and why. */
function verdictOn(met, more) {
  const yes = more ? `accepted: ${more}` : "accepted";
  if (!met.s) return Number.isNaN(met.t) ? "rejected: parallel" : met.clipped ? "rejected: clipped" : yes;
  const outside = met.s.map((v, i) => (v < 0 ? `s${"₁₂₃"[i]} < 0` : v > 1 ? `s${"₁₂₃"[i]} > 1` : "")).filter(Boolean);
  if (outside.length) return `rejected: ${outside.join(", ")}`;
  if (!met.textbook) return "rejected: no sum of 1";
  return met.clipped ? "rejected: clipped" : yes;
}

/** A formula: letters slanted, vectors upright and bold, `_1` as a subscript. */
function formula(text) {
  const made = element("span", { class: "formula" });
  for (const [token, name, index] of text.matchAll(/([a-zA-Z]+)(?:_(\w+))?|[^a-zA-Z]+/g)) {
    if (!name) made.append(token);
    else made.append(element("var", { class: VECTORS.has(name) ? "vector" : null }, name,
      index ? element("sub", {}, index) : null));
  }
  return made;
}

/** The steps: a name, a formula, and what its value is in a result. */
function stepsOf(surface) {
  const { orthographic } = camera;
  const steps = [
    ["Through the film at", "u, v", (r) => [r.ray.u, r.ray.v]],
    ["Origin", orthographic ? "o = camera + u right + v up" : "o = camera", (r) => r.ray.origin],
    ["Direction", orthographic ? "d = forward" : "d = u right + v up + forward", (r) => r.ray.direction],
  ];
  if (!surface) return steps;
  if (surface.plane) {
    return [...steps,
      ["Point of the plane", "p", (r) => r.p],
      ["Its normal", "n", (r) => r.n],
      ["Against the ray", "d · n", (r) => r.towards],
      ["From the plane", "(o − p) · n", (r) => r.from],
      ["Ray parameter", "t = −((o − p) · n) / (d · n)", (r) => r.t],
      ["Point", "x = o + t d", (r) => r.x]];
  }
  return [...steps,
    ["Corners", "p_1", (r) => r.p1], ["", "p_2", (r) => r.p2], ["", "p_3", (r) => r.p3],
    ["Normal", "n = (p_3 − p_1) × (p_2 − p_1)", (r) => r.n],
    ["Against the ray", "d · n", (r) => r.towards],
    ["From the plane", "(o − p_1) · n", (r) => r.from],
    ["Ray parameter", "t = −((o − p_1) · n) / (d · n)", (r) => r.t],
    ["Point", "x = o + t d", (r) => r.x],
    ["Size", "n · n", (r) => r.area],
    ["Barycentrics", "s_1 = n · ((p_2 − p_3) × (x − p_3)) / (n · n)", (r) => r.s[0]],
    ["", "s_2 = n · ((p_3 − p_1) × (x − p_1)) / (n · n)", (r) => r.s[1]],
    ["", "s_3 = n · ((p_1 − p_2) × (x − p_2)) / (n · n)", (r) => r.s[2]],
    ["Sum", "s_1 + s_2 + s_3", (r) => r.sum]];
}

function stepsTable(surface, results) {
  const rows = stepsOf(surface).map(([name, text, value]) => {
    const [whole, half] = results.map(value);
    return [name, formula(text), numbers(whole), numbers(half, whole)];
  });
  if (surface && !surface.plane) rows.push(
    ["Inside", "0 ≤ sᵢ ≤ 1", ...results.map((r) => yesNo(r.inside))],
    ["As printed", "and s₁ + s₂ + s₃ = 1", ...results.map((r) => yesNo(r.literal, "hit", "no hit"))],
    ["Repaired", "and |s₁ + s₂ + s₃ − 1| ≤ tolerance",
      ...results.map((r) => yesNo(r.textbook, "hit", "no hit", ` (${general(r.tolerance, 3)})`))]);
  if (surface) rows.push(["In the clip range", `${general(camera.clip[0])} m ≤ t ≤ ${general(camera.clip[1])} m`,
    ...results.map((r) => yesNo(!r.clipped))]);
  const title = surface ? `${page.objects[surface.object]}${surface.plane ? "" : `, triangle ${count(surface.triangle)}`}` : "The ray";
  return table(title, ["", "Textbook", "float64", "float32"], rows, [2, 3], "steps left");
}

const yesNo = (is, yes = "yes", no = "no", more = "") =>
  element("span", { class: is ? "yes" : "no" }, `${is ? "✓" : "✗"} ${is ? yes : no}${more}`);

/** A number or a vector; of float32, the digits that part from float64 by more than its rounding. */
function numbers(value, reference = null) {
  if (Array.isArray(value)) {
    return element("span", { class: "lines" }, ...value.map((v, i) => numbers(v, reference?.[i] ?? null)));
  }
  if (reference === null) return element("span", {}, shortest(value));
  const text = shortest(value, "float32");
  if (Object.is(Math.fround(reference), value)) return element("span", {}, text);
  const exact = shortest(reference);
  let same = 0;
  while (same < text.length && text[same] === exact[same]) same++;
  return element("span", {}, text.slice(0, same), element("mark", { class: "off" }, text.slice(same)));
}

/** What is to be known of the printed formulas. */
function errata(surface) {
  if (!surface || surface.plane) return null;
  return element("details", { class: "errata", open: true },
    element("summary", {}, "Two errata of the exercise"),
    element("ol", {},
      element("li", {}, "As printed, ", formula("n_s2"), " vanishes on the edge ", formula("p_1 p_2"), ", and ",
        formula("n_s3"), " on ", formula("p_3 p_1"), ": so the printed ", formula("s_2"), " weighs ", formula("p_3"),
        " and ", formula("s_3"), " weighs ", formula("p_2"), ". Here each is named for the corner that it weighs: ",
        formula("x = s_1 p_1 + s_2 p_2 + s_3 p_3"), ". Constant shading never shows the difference."),
      element("li", {}, "In exact arithmetic the three always sum to 1; in floating point they miss it by a rounding error for about every second hit. Taken as printed, the test loses those; repaired, it allows a tolerance.")),
    element("p", { class: "muted" }, "Digits of float32 ", element("mark", { class: "off" }, "marked like this"),
      " part from float64 by more than one rounding. Every number is computed in this page, with the same bits as the tracer's."));
}

onChange(["x", "y"], () => {
  chosen = 0;
  drawDerivation();
});
