"use strict";
// The steps of the textbook, as formulas and as numbers in both precisions.

const VECTORS = new Set(["o", "d", "n", "x", "p", "right", "up", "forward"]);

/** A formula: letters slanted, vectors upright and bold, `_1` as a subscript. */
function formula(text) {
  const made = element("span", { class: "formula" });
  for (const [token, name, index] of text.matchAll(/([a-zA-Z]+)(?:_(\w+))?|[^a-zA-Z]+/g)) {
    if (!name) made.append(token);
    else
      made.append(
        element(
          "var",
          { class: VECTORS.has(name) ? "vector" : null },
          name,
          index ? element("sub", {}, index) : null,
        ),
      );
  }
  return made;
}

/** The steps: a name, a formula, and what its value is in a result. */
function stepsOf(surface) {
  const steps = [
    ["Through the film at", "u, v", (r) => [r.ray.u, r.ray.v]],
    ["Origin", projection.origin, (r) => r.ray.origin],
    ["Direction", projection.direction, (r) => r.ray.direction],
  ];
  if (!surface) return steps;
  if (surface.plane) {
    return [
      ...steps,
      ["Point of the plane", "p", (r) => r.p],
      ["Its normal", "n", (r) => r.n],
      ["Against the ray", "d · n", (r) => r.towards],
      ["From the plane", "(o − p) · n", (r) => r.from],
      ["Ray parameter", "t = −((o − p) · n) / (d · n)", (r) => r.t],
      ["Point", "x = o + t d", (r) => r.x],
    ];
  }
  return [
    ...steps,
    ["Corners", "p_1", (r) => r.p1],
    ["", "p_2", (r) => r.p2],
    ["", "p_3", (r) => r.p3],
    ["Normal", "n = (p_3 − p_1) × (p_2 − p_1)", (r) => r.n],
    ["Against the ray", "d · n", (r) => r.towards],
    ["From the plane", "(o − p_1) · n", (r) => r.from],
    ["Ray parameter", "t = −((o − p_1) · n) / (d · n)", (r) => r.t],
    ["Point", "x = o + t d", (r) => r.x],
    ["Size", "n · n", (r) => r.area],
    ["Barycentrics", "s_1 = n · ((p_2 − p_3) × (x − p_3)) / (n · n)", (r) => r.s[0]],
    ["", "s_2 = n · ((p_3 − p_1) × (x − p_1)) / (n · n)", (r) => r.s[1]],
    ["", "s_3 = n · ((p_1 − p_2) × (x − p_2)) / (n · n)", (r) => r.s[2]],
    ["Sum", "s_1 + s_2 + s_3", (r) => r.sum],
  ];
}

function stepsTable(surface, results) {
  const rows = stepsOf(surface).map(([name, text, value]) => {
    const [whole, half] = results.map(value);
    return [name, formula(text), numbers(whole), numbers(half, whole)];
  });
  if (surface && !surface.plane)
    rows.push(
      ["Inside", "0 ≤ sᵢ ≤ 1", ...results.map((r) => yesNo(r.inside))],
      [
        "As printed",
        "and s₁ + s₂ + s₃ = 1",
        ...results.map((r) => yesNo(r.literal, "hit", "no hit")),
      ],
      [
        "Repaired",
        "and |s₁ + s₂ + s₃ − 1| ≤ tolerance",
        ...results.map((r) => yesNo(r.textbook, "hit", "no hit", ` (${general(r.tolerance, 3)})`)),
      ],
    );
  if (surface)
    rows.push([
      "In the clip range",
      `${general(camera.clip_start)} m ≤ t ≤ ${general(camera.clip_end)} m`,
      ...results.map((r) => yesNo(!r.clipped)),
    ]);
  const title = surface
    ? `${page.objects[surface.object]}${surface.plane ? "" : `, triangle ${count(surface.triangle)}`}`
    : "The ray";
  return table(title, ["", "Textbook", "float64", "float32"], rows, [2, 3], "steps left");
}

const yesNo = (is, yes = "yes", no = "no", more = "") =>
  element("span", { class: is ? "yes" : "no" }, `${is ? "✓" : "✗"} ${is ? yes : no}${more}`);

/** A number or a vector; of float32, the digits that part from float64 by more than its rounding. */
function numbers(value, reference = null) {
  if (Array.isArray(value)) {
    return element(
      "span",
      { class: "lines" },
      ...value.map((v, i) => numbers(v, reference?.[i] ?? null)),
    );
  }
  if (reference === null) return element("span", {}, shortest(value));
  const text = shortest(value, "float32");
  if (Object.is(Math.fround(reference), value)) return element("span", {}, text);
  const exact = shortest(reference);
  let same = 0;
  while (same < text.length && text[same] === exact[same]) same++;
  return element(
    "span",
    {},
    text.slice(0, same),
    element("mark", { class: "off" }, text.slice(same)),
  );
}
