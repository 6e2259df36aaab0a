"use strict";
// What was compared, how, and what else was measured: a card each.

/** A table with a caption; `right` are the columns of numbers. */
function table(caption, heads, rows, right = [], kind = "") {
  const side = (k) => (right.includes(k) ? "number" : null);
  return element("div", { class: `scroll ${kind}`, tabindex: "0", role: "group", "aria-label": caption },
    element("table", {}, element("caption", {}, caption),
      element("thead", {}, element("tr", {}, ...heads.map((head, k) => element("th", { scope: "col", class: side(k) }, head)))),
      element("tbody", {}, ...rows.map((row) =>
        element("tr", {}, ...row.map((cell, k) => element("td", { class: side(k) }, cell)))))));
}

const card = (title, ...children) => element("section", { class: "card" }, element("h2", {}, title), ...children);
const px = (value) => `${general(value, 3)} px`;
const wide = (made) => (made.classList.add("wide"), made);
const facts = (pairs) => element("dl", { class: "facts" },
  ...pairs.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]));
const seconds = (value) => `${general(value, 3)} s`;

function drawTables() {
  byId("tables").replaceChildren(...[methodsCard(), metricsCard(), splitCard(), blenderCard(), certificateCard(), selfCheckCard(), enginesCard(),
    manifestCard(), tradeCard(), extremesCard(), leftOutCard()].filter(Boolean));
  byId("colophon").textContent = `Traced in plain Python and numpy, and compared with Blender ${page.comparison.blender.version}, by Reference Tracer. This page fetches nothing.`;
}

function methodsCard() {
  const rows = page.comparison.methods.map((m) => [`${words(m.method)}, ${m.precision}`, seconds(m.seconds),
    m.wrong_pixels === null ? "?" : count(m.wrong_pixels), count(m.ambiguous)]);
  const required = [...new Set(page.comparison.methods.flatMap((m) => m.required))];
  return card("Traced by", table("Methods, side by side", ["Method", "Time", "Wrong pixels", "Ambiguous"], rows, [1, 2, 3]),
    ...required.map((line) => element("p", { class: "muted" }, `${line}.`)));
}

function metricsCard() {
  const { rmse, psnr, ssim, largest_difference: most } = page.comparison.metrics;
  const [x, y] = most.pixel;
  return card("How far apart", facts([
    ["RMSE", general(rmse, 4)],
    ["PSNR", psnr === null ? "infinite" : `${psnr.toFixed(1)} dB`],
    ["SSIM", ssim.toFixed(6)],
    ["Largest difference", element("span", {}, `${general(most.value, 4)} at `,
      element("button", { type: "button", class: "link", onclick: () => visit(x, y) }, `(${x}, ${y})`))],
  ]), element("p", { class: "muted" }, "Of linear RGBA, over all pixels."),
  page.comparison.transform ? element("p", {}, `Colours: ${page.comparison.transform}.`) : null);
}

/** The counts of interior and boundary pixels apart. */
function splitCard() {
  const parts = ["interior", "boundary"].filter((name) => page.comparison.pixels[name]);
  if (!parts.length) return null;
  const scores = parts.map((name) => page.comparison.pixels[name]);
  const causes = [...CAUSES.values()].filter((cause) => cause.pixels);
  const rows = [
    ...["total", "agree", "differ"].map((name) => [words(name), ...scores.map((score) => count(score[name]))]),
    ...causes.map(({ name, label }) => [`– ${label}`, ...scores.map((score) => count(score.by_cause[name] ?? 0))]),
  ];
  return card("Inside and at edges", table("Pixels in the interior of surfaces, and at their boundaries", ["", ...parts.map(words)], rows, [1, 2]));
}

function blenderCard() {
  const { version, source, settings = {}, sample_radius: radius } = page.comparison.blender;
  return card("How Blender drew it", facts([
    ["Version", version],
    ["Picture", words(source)],
    ...(radius ? [["Samples within", `${general(radius)} px of the centre`]] : []),
    ...Object.entries(settings).map(([name, value]) => [words(name), said(value)]),
  ]));
}

const said = (value) =>
  value === true ? "yes" : value === false ? "no" : typeof value === "number" ? general(value)
    : typeof value === "object" && value !== null ? JSON.stringify(value) : String(value);

/** Do the tracer's camera and Blender's see known points in the same places? */
function certificateCard() {
  const held = page.comparison.certificate;
  if (!held) return null;
  return card("Camera certificate", element("p", { class: held.passed ? "yes" : "no" },
    held.passed ? "✓ The two cameras are the same" : "✗ The two cameras differ"), facts([
    ["Known points", count(held.points)],
    ["Farthest apart", px(held.largest)],
    ["Allowed", `${px(held.allowed)}, by float32`],
  ]));
}

/** Faults that were made on purpose, and whether the comparison found them. */
function selfCheckCard() {
  const held = page.comparison.self_check;
  if (!held?.length) return null;
  const rows = held.map((f) => [f.text, element("span", { class: f.result === "missed" ? "no" : f.result === "caught" ? "yes" : "muted" }, f.result),
    count(f.changed), count(f.differ), `${count(f.unexplained)} of ${count(f.looked_at)}`, f.note]);
  return wide(card("Would a fault have been found?",
    table("Known faults, made on purpose and judged like this comparison", ["Fault", "", "Pixels changed", "Differ", "Unexplained", ""], rows, [2, 3, 4])));
}

/** Several engines against certified, in whatever columns they come. */
function enginesCard() {
  const held = page.comparison.engines;
  if (!held?.length) return null;
  const heads = [...new Set(held.flatMap(Object.keys))];
  const right = heads.map((head, k) => (typeof held[0][head] === "number" ? k : -1));
  return wide(card("Engines", table("Each held against the certified picture", heads.map(words),
    held.map((row) => heads.map((head) => said(row[head] ?? ""))), right)));
}

function manifestCard() {
  const { objects, unmodelled, notes, evaluation } = page.comparison.scene;
  const rows = objects.map((o) => [o.name, words(o.type.toLowerCase()),
    o.exported ? "exported" : o.outside ? "outside the view" : `skipped: ${o.reason}`,
    o.exported ? count(o.instances) : "", o.exported ? count(o.traced_triangles) : "",
    [o.left_out ? `${count(o.left_out)} triangles left out` : "", o.empty_slots ? `${o.empty_slots} empty slots` : "",
      ...diagnosed(o.diagnosis)].filter(Boolean).join(", ")]);
  return wide(card("What was exported",
    ...unmodelled.map((u) => element("p", { class: "notice" }, element("strong", {}, "Not modelled: "),
      `${u.object}: ${u.feature}${u.detail ? ` (${u.detail})` : ""}`)),
    ...notes.map((note) => element("p", { class: "muted" }, note)),
    table(`Objects, as in ${evaluation.toLowerCase()} evaluation`, ["Object", "Type", "", "Instances", "Triangles", "Notes"], rows, [3, 4])));
}

function diagnosed(diagnosis) {
  if (!diagnosis) return [];
  const said_ = [];
  if (diagnosis.closed === false) said_.push("open");
  if (diagnosis.consistent_winding === false) said_.push("winding not consistent");
  for (const name of ["degenerate_faces", "duplicate_faces"]) {
    if (diagnosis[name]) said_.push(`${count(diagnosis[name])} ${name.replace("_", " ")}`);
  }
  return said_;
}

function plots(study, describe) {
  return study.plots.map(({ name, png }) => element("figure", { class: "plot" }, element("img", { src: png, alt: describe(name) })));
}

function tradeCard() {
  const { trade } = page;
  if (!trade) return null;
  const rows = trade.rows.map((r) => [words(r.method), r.precision, `${r.width} × ${r.height}`, `${r.samples} × ${r.samples}`,
    `${general(1000 * r.seconds, 3)} ms`, `${count(r.wrong_pixels)}${r.best_pixels ? " ★" : ""}`,
    r.largest_t_error === null ? "–" : general(r.largest_t_error, 2), general(r.peak_bytes / 2 ** 20, 3),
    `${r.coverage_error === null ? "–" : r.coverage_error.toFixed(4)}${r.best_coverage ? " ★" : ""}`]);
  return wide(card("The trade: speed against accuracy", element("p", { class: "advice" }, trade.advice),
    ...plots(trade, () => "Time against wrong pixels, and time against coverage error, of every method"),
    element("details", {}, element("summary", {}, `All ${rows.length} rows`),
      table("★: no other row beats it", ["Method", "Precision", "Pixels", "Rays", "Time", "Wrong pixels", "t error, m", "MiB", "Coverage error"], rows, [4, 5, 6, 7, 8]))));
}

function extremesCard() {
  const { extremes } = page;
  if (!extremes) return null;
  const title = Object.fromEntries(extremes.scenarios.map((s) => [s.name, `${s.title} (${s.scale}${s.unit ? `, ${s.unit}` : ""})`]));
  const columns = [...new Set(extremes.breaking_points.map((p) => `${p.method} ${p.precision}`))];
  const at = new Map(extremes.breaking_points.map((p) => [`${p.scenario} ${p.method} ${p.precision}`, p]));
  const rows = [...new Set(extremes.breaking_points.map((p) => p.scenario))].map((name) => [title[name] ?? name,
    ...columns.map((column) => breaking(at.get(`${name} ${column}`)))]);
  return wide(card("The extremes: where methods break",
    ...plots(extremes, (name) => words(name)),
    element("details", {}, element("summary", {}, "All breaking points"),
      table("The first scale at which a ray is lost; +: a ray crosses too many triangles", ["Sweep", ...columns.map(words)], rows, columns.map((_, k) => k + 1)))));
}

function breaking(point) {
  if (!point) return "";
  return `${point.lost === null ? "never" : general(point.lost, 3)}${point.doubled === null ? "" : " +"}`;
}

const leftOutCard = () => (page.left_out.length
  ? wide(card("Not in this page", ...page.left_out.map((line) => element("p", {}, line)))) : null);
