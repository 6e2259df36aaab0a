"use strict";
// What was compared, and how: a card each, those of `evidence.js` and `studies.js` among them.

const px = (value) => `${general(value, 3)} px`;
const facts = (pairs) =>
  element(
    "dl",
    { class: "facts" },
    ...pairs.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]),
  );
const seconds = (value) => `${general(value, 3)} s`;

// Each is a card below all else, in this order: `of` returns its elements, or nothing for no card.
const CARDS = [
  { title: "Traced by", of: methods },
  { title: "How far apart", of: metrics },
  { title: "Inside and at edges", of: split },
  { title: page.comparison.blender.version ? "How Blender drew it" : "The picture", of: drawnBy },
  { title: "Camera certificate", of: certificate },
  { title: "Would a fault have been found?", of: selfCheck, kind: "wide" },
  { title: "What was exported", of: manifest, kind: "wide" },
  { title: "The trade: speed against accuracy", of: trade, kind: "wide" },
  { title: "The extremes: where methods break", of: extremes, kind: "wide" },
  { title: "Not in this page", of: leftOut, kind: "wide" },
];

function leftOut() {
  return page.left_out.map((line) => element("p", {}, line));
}

function drawTables() {
  const made = CARDS.map(({ title, of, kind = "" }) => {
    const held = of();
    if (!held?.length) return "";
    return element("section", { class: `card ${kind}` }, element("h2", {}, title), ...held);
  });
  byId("tables").replaceChildren(...made);
  byId("colophon").textContent =
    `Traced in plain Python and numpy, and compared with ${OTHER}, by Reference Tracer. ` +
    "This page fetches nothing.";
}

function methods() {
  const rows = page.comparison.methods.map((m) => [
    `${words(m.method)}, ${m.precision}`,
    seconds(m.seconds),
    m.wrong_pixels === null ? "?" : count(m.wrong_pixels),
    count(m.ambiguous),
  ]);
  const required = [...new Set(page.comparison.methods.flatMap((m) => m.required))];
  return [
    table(
      "Methods, side by side",
      ["Method", "Time", "Wrong pixels", "Ambiguous"],
      rows,
      [1, 2, 3],
    ),
    ...[...required, ...roundedBefore()].map((line) => element("p", { class: "muted" }, `${line}.`)),
  ];
}

/** What is rounded before the proof begins, in a sentence; nothing where nothing is proven. */
function roundedBefore() {
  const { method, rounding } = page.comparison.tracer;
  if (method !== "certified" || rounding.pixels === null) return [];
  const rays = `rays by at most ${general(rounding.pixels, 1)} px`;
  const corners = `corners by at most ${general(rounding.corner, 1)} m`;
  return [`before any test, rounding moves ${rays}, ${corners}`];
}

function metrics() {
  if (!page.comparison.metrics) return []; // of ids
  const { rmse, psnr, ssim, largest_difference: most } = page.comparison.metrics;
  const [x, y] = most.pixel;
  return [
    facts([
      ["RMSE", general(rmse, 4)],
      ["PSNR", psnr === null ? "infinite" : `${psnr.toFixed(1)} dB`],
      ["SSIM", ssim.toFixed(6)],
      [
        "Largest difference",
        most.value === 0
          ? "none"
          : element(
              "span",
              {},
              `${general(most.value, 4)} at `,
              element(
                "button",
                { type: "button", class: "link", onclick: () => visit(x, y) },
                `(${x}, ${y})`,
              ),
            ),
      ],
    ]),
    element("p", { class: "muted" }, "Of linear RGBA, over all pixels."),
    page.comparison.background
      ? element(
          "p",
          {},
          `Note: ${page.comparison.background.text}. ${page.comparison.background.not_judged ?? ""}`,
        )
      : null,
    page.comparison.transform ? element("p", {}, `Colours: ${page.comparison.transform}.`) : null,
  ];
}

function drawnBy() {
  const { version, source, settings = {}, sample_radius: radius } = page.comparison.blender;
  return [
    facts([
      ...(version ? [["Version", version]] : []),
      ["Picture", words(source)],
      ...(radius ? [["Samples within", `${general(radius)} px of the centre`]] : []),
      ...Object.entries(settings).map(([name, value]) => [words(name), said(value)]),
    ]),
  ];
}

const said = (value) =>
  value === true
    ? "yes"
    : value === false
      ? "no"
      : typeof value === "number"
        ? general(value)
        : typeof value === "object" && value !== null
          ? JSON.stringify(value)
          : String(value);
