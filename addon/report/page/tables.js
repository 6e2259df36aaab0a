"use strict";
// What was compared, and how: a card each; the cards of `evidence.js` and `studies.js` among them.

const card = (title, ...children) =>
  element("section", { class: "card" }, element("h2", {}, title), ...children);
const px = (value) => `${general(value, 3)} px`;
const wide = (made) => (made.classList.add("wide"), made);
const facts = (pairs) =>
  element(
    "dl",
    { class: "facts" },
    ...pairs.flatMap(([name, value]) => [element("dt", {}, name), element("dd", {}, value)]),
  );
const seconds = (value) => `${general(value, 3)} s`;

function drawTables() {
  byId("tables").replaceChildren(
    ...[
      methodsCard(),
      metricsCard(),
      splitCard(),
      blenderCard(),
      certificateCard(),
      selfCheckCard(),
      manifestCard(),
      tradeCard(),
      extremesCard(),
      leftOutCard(),
    ].filter(Boolean),
  );
  byId("colophon").textContent =
    `Traced in plain Python and numpy, and compared with ${OTHER}, by Reference Tracer. ` +
    "This page fetches nothing.";
}

function methodsCard() {
  const rows = page.comparison.methods.map((m) => [
    `${words(m.method)}, ${m.precision}`,
    seconds(m.seconds),
    m.wrong_pixels === null ? "?" : count(m.wrong_pixels),
    count(m.ambiguous),
  ]);
  const required = [...new Set(page.comparison.methods.flatMap((m) => m.required))];
  return card(
    "Traced by",
    table(
      "Methods, side by side",
      ["Method", "Time", "Wrong pixels", "Ambiguous"],
      rows,
      [1, 2, 3],
    ),
    ...[...required, ...roundedBefore()].map((line) => element("p", { class: "muted" }, `${line}.`)),
  );
}

/** What is rounded before the proof begins, in a sentence; nothing where nothing is proven. */
function roundedBefore() {
  const { method, rounding } = page.comparison.tracer;
  if (method !== "certified" || rounding.pixels === null) return [];
  const rays = `rays by at most ${general(rounding.pixels, 1)} px`;
  const corners = `corners by at most ${general(rounding.corner, 1)} m`;
  return [`before any test, rounding moves ${rays}, ${corners}`];
}

function metricsCard() {
  const { rmse, psnr, ssim, largest_difference: most } = page.comparison.metrics;
  const [x, y] = most.pixel;
  return card(
    "How far apart",
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
  );
}

function blenderCard() {
  const { version, source, settings = {}, sample_radius: radius } = page.comparison.blender;
  return card(
    page.comparison.blender.version ? "How Blender drew it" : "The picture",
    facts([
      ...(version ? [["Version", version]] : []),
      ["Picture", words(source)],
      ...(radius ? [["Samples within", `${general(radius)} px of the centre`]] : []),
      ...Object.entries(settings).map(([name, value]) => [words(name), said(value)]),
    ]),
  );
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
