"use strict";
// What backs the verdict, where the comparison has it: a card each.

/** The counts of interior and boundary pixels apart. */
function split() {
  const parts = ["interior", "boundary"].filter((name) => page.comparison.pixels[name]);
  if (!parts.length) return null;
  const scores = parts.map((name) => page.comparison.pixels[name]);
  const causes = [...CAUSES.values()].filter((cause) => cause.pixels);
  const rows = [
    ...["total", "agree", "differ"].map((name) => [
      words(name),
      ...scores.map((score) => count(score[name])),
    ]),
    ...causes.map(({ name, label }) => [
      `– ${label}`,
      ...scores.map((score) => count(score.by_cause[name] ?? 0)),
    ]),
  ];
  return [
    table(
      "Pixels in the interior of surfaces, and at their boundaries",
      ["", ...parts.map(words)],
      rows,
      [1, 2],
    ),
  ];
}

/** Do the tracer's camera and Blender's see known points in the same places? */
function certificate() {
  const held = page.comparison.certificate;
  if (!held) return null;
  return [
    element(
      "p",
      { class: held.passed ? "yes" : "no" },
      held.passed ? "✓ The two cameras are the same" : "✗ The two cameras differ",
    ),
    facts([
      ["Known points", count(held.points)],
      ["Farthest apart", px(held.largest)],
      ["Allowed", `${px(held.allowed)}, by float32`],
    ]),
  ];
}

/** Faults that were made on purpose, and whether the comparison found them. */
function selfCheck() {
  const held = page.comparison.self_check;
  if (!held?.length) return null;
  const rows = held.map((f) => [
    f.text,
    element(
      "span",
      { class: f.result === "missed" ? "no" : f.result === "caught" ? "yes" : "muted" },
      f.result,
    ),
    count(f.changed),
    count(f.differ),
    `${count(f.unexplained)} of ${count(f.looked_at)}`,
    f.note,
  ]);
  return [
    table(
      "Known faults, made on purpose and judged like this comparison",
      ["Fault", "", "Pixels changed", "Differ", "Unexplained", ""],
      rows,
      [2, 3, 4],
    ),
  ];
}
