"use strict";
// What one sees at a glance: the scene, the verdict, the score.

// The picture that is compared: Blender's, or one that somebody gave.
const OTHER = page.comparison.blender.version
  ? `Blender ${page.comparison.blender.version}`
  : page.comparison.blender.picture;

const VERDICTS = {
  agree: ["✓", "Agree"],
  warnings: ["!", "Warnings"],
  "not comparable": ["?", "Not comparable"],
  differences: ["✗", "Differences"],
  cancelled: ["…", "Cancelled"],
};

function drawSummary() {
  const { scene, blender, verdict, pixels: score } = page.comparison;
  const name = scene.file.split(/[\\/]/).pop() || scene.scene;
  document.title = `${name} – Reference Tracer`;
  byId("title").textContent = name;
  byId("subtitle").textContent = [
    scene.file === name ? "" : scene.file,
    scene.scene === name ? "" : `scene ${scene.scene}`,
    scene.view_layer && `view layer ${scene.view_layer}, frame ${scene.frame}`,
    `camera ${scene.camera}`,
    `${WIDTH} × ${HEIGHT} pixels`,
    blender.version ? `${OTHER}, ${words(blender.source)}` : OTHER,
  ]
    .filter(Boolean)
    .join("  ·  ");
  const [sign, word] = VERDICTS[verdict];
  byId("verdict").className = `verdict ${verdict}`;
  const blind = page.comparison.background?.not_judged;
  byId("verdict").replaceChildren(
    element("span", { "aria-hidden": "true" }, sign),
    word,
    ...apart(verdict === "agree", blind && "the background"),
  );
  if (blind) byId("verdict").title = blind;
  byId("headline").textContent = headline(score);
  byId("score").replaceChildren(...tiles(score).map(tile));
}

/** What a verdict leaves out, in texts that are translated one by one: the most pixels first. */
function apart(agrees, blind) {
  const found = [...CAUSES.values()]
    .filter((cause) => cause.pixels && !["agree", "not_traced"].includes(cause.name))
    .sort((a, b) => b.pixels - a.pixels)
    .map((cause) => [`${count(cause.pixels)} px `, cause.place]);
  if (blind) found.push([blind]);
  return found.flatMap((texts, k) => [k ? ", " : agrees ? ", but for " : ": ", ...texts]);
}

function headline(score) {
  const parts = [
    score.agree === score.total
      ? `All ${count(score.total)} pixels agree.`
      : `${count(score.agree)} of ${count(score.total)} pixels agree.`,
  ];
  if (score.unexplained)
    parts.push(
      `${count(score.unexplained)} have no excuse: one of the two pictures is wrong there.`,
    );
  else if (score.differ && !page.comparison.advice)
    parts.push(
      score.differ === 1
        ? "The one that differs is explained."
        : `All ${count(score.differ)} that differ are explained.`,
    );
  if (score.not_decidable) parts.push(`Of ${count(score.not_decidable)} nothing can be said.`);
  const blind = Object.entries(score.not_judged?.by_feature ?? {});
  if (blind.length) {
    const pixels = blind.reduce((sum, [, many]) => sum + many, 0);
    parts.push(`${count(pixels)} cannot be judged: ${blind.map(([name]) => name).join(", ")}.`);
  }
  for (const { object, pixels, transform } of page.comparison.shades ?? [])
    parts.push(
      `${object} is shown in another shade (${count(pixels)} pixels)${transform && `: ${transform}`}.`,
    );
  const { pixels: excused, share, most, advice } = page.comparison.excused;
  if (share > most)
    parts.push(
      `${percent(excused, score.total)} of the picture rests on rounding alone.`,
      ...advice.map((line) => `To have it judged, ${line}.`),
    );
  for (const { object, pixels, total } of page.comparison.excused.objects)
    parts.push(
      `'${object}' was not judged: ${count(pixels)} of the ${count(total)} in which it is seen rest on rounding alone.`,
    );
  if (score.not_traced) parts.push(`${count(score.not_traced)} were not traced.`);
  return parts.join(" ");
}

/** What is counted, each as [name, number, beside it, kind]. */
function tiles(score) {
  const { certainty } = page.comparison.tracer;
  const proven = certainty.bound + certainty.exact;
  const good = !score.unexplained && !page.comparison.advice;
  const found = [
    ["Agree", score.agree, percent(score.agree, score.total)],
    ["Explained", score.explained, `of ${count(score.differ)} that differ`],
    [
      "Unexplained",
      score.unexplained,
      score.unexplained ? "one picture is wrong" : good ? "as it should be" : "",
      score.unexplained ? "bad" : good ? "good" : "",
    ],
  ];
  if (score.not_decidable)
    found.push(["Not decidable", score.not_decidable, percent(score.not_decidable, score.total)]);
  if (score.not_traced)
    found.push(["Not traced", score.not_traced, percent(score.not_traced, score.total)]);
  found.push([
    "Proven",
    proven,
    !proven
      ? `${words(page.comparison.tracer.method)} proves nothing`
      : certainty.ambiguous
        ? `and ${count(certainty.ambiguous)} ambiguous`
        : percent(proven, score.total),
  ]);
  return found;
}

const tile = ([name, number, beside, kind]) =>
  element(
    "div",
    { class: `tile ${kind ?? ""}` },
    element("dt", {}, name, element("span", { class: "muted" }, beside)),
    element("dd", {}, count(number)),
  );
