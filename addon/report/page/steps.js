"use strict";
// The table of the textbook's steps: formulas, and their numbers in both precisions.

/** The steps: a remark, a formula, and what its value is in a result. */
function stepsOf(surface) {
  const steps = [
    ["through the film at", "u, v", (r) => [r.ray.u, r.ray.v]],
    ["origin", projection.origin, (r) => r.ray.origin],
    ["direction", projection.direction, (r) => r.ray.direction],
  ];
  if (!surface) return steps;
  const formulas = surface.plane ? page.formulas.plane : page.formulas.triangle;
  for (const [key, [label, right, remark]] of Object.entries(formulas)) {
    steps.push([remark, right ? `${label} = ${right}` : label, (r) => r[key]]);
  }
  return steps;
}

function stepsTable(surface, results) {
  const rows = stepsOf(surface).map(([name, text, value]) => {
    const [whole, half] = results.map(value);
    return [name, formula(text), numbers(whole), numbers(half, whole)];
  });
  if (surface && !surface.plane)
    rows.push(
      ["inside", "0 ≤ sᵢ ≤ 1", ...results.map((r) => yesNo(r.inside))],
      [
        "as printed",
        "and s₁ + s₂ + s₃ = 1",
        ...results.map((r) => yesNo(r.literal, "hit", "no hit")),
      ],
      [
        "repaired",
        "and |s₁ + s₂ + s₃ − 1| ≤ tolerance",
        ...results.map((r) => yesNo(r.textbook, "hit", "no hit", ` (${general(r.tolerance, 3)})`)),
      ],
    );
  if (surface)
    rows.push([
      "in the clip range",
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
