"use strict";
// What was exported, the trade and the extremes: a card each.

function manifest() {
  const { objects, unmodelled, notes, evaluation } = page.comparison.scene;
  const rows = objects.map((o) => [
    o.name,
    words(o.type.toLowerCase()),
    o.exported ? "exported" : o.outside ? "outside the view" : `skipped: ${o.reason}`,
    o.exported ? count(o.instances) : "",
    o.exported ? count(o.traced_triangles) : "",
    [
      o.left_out ? `${count(o.left_out)} triangles left out` : "",
      o.empty_slots ? `${o.empty_slots} empty slots` : "",
      ...diagnosed(o.diagnosis),
    ]
      .filter(Boolean)
      .join(", "),
  ]);
  return [
    ...unmodelled.map((u) =>
      element(
        "p",
        { class: "notice" },
        element("strong", {}, `${u.effect === "missing" ? words(u.feature) : "Not modelled"}: `),
        u.effect === "missing" ? u.object : `${u.object}: ${u.feature}`,
        u.detail ? ` (${u.detail})` : "",
      ),
    ),
    ...notes.map((note) => element("p", { class: "muted" }, note)),
    table(
      `Objects, as in ${evaluation.toLowerCase()} evaluation`,
      ["Object", "Type", "", "Instances", "Triangles", "Notes"],
      rows,
      [3, 4],
    ),
  ];
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

function trade() {
  const { trade } = page;
  if (!trade) return null;
  const { head, rows } = trade.table;
  return [
    plotFigure(trade.plot),
    element(
      "details",
      {},
      element("summary", {}, `All ${rows.length} rows`),
      table("*: no other row beats it", head, rows, [...head.keys()].slice(3)),
    ),
  ];
}

function extremes() {
  const { extremes } = page;
  if (!extremes) return null;
  const title = Object.fromEntries(
    extremes.scenarios.map((s) => [
      s.name,
      `${s.title} (${s.scale}${s.unit ? `, ${s.unit}` : ""})`,
    ]),
  );
  const columns = [...new Set(extremes.breaking_points.map((p) => `${p.method} ${p.precision}`))];
  const at = new Map(
    extremes.breaking_points.map((p) => [`${p.scenario} ${p.method} ${p.precision}`, p]),
  );
  const rows = [...new Set(extremes.breaking_points.map((p) => p.scenario))].map((name) => [
    title[name] ?? name,
    ...columns.map((column) => breaking(at.get(`${name} ${column}`))),
  ]);
  return [
    plotFigure(extremes.plot),
    element(
      "details",
      {},
      element("summary", {}, "All breaking points"),
      table(
        "The first scale at which a ray is lost; +: a ray crosses too many triangles",
        ["Sweep", ...columns.map(words)],
        rows,
        columns.map((_, k) => k + 1),
      ),
    ),
  ];
}

function breaking(point) {
  if (!point) return "";
  return `${point.lost === null ? "never" : general(point.lost, 3)}${point.doubled === null ? "" : " +"}`;
}
