"use strict";
// Everything together: fill the page, and keep what is shown true to the state.

const WALL = 0.25; // of a picture: so many unexplained pixels would hide it

/** The pixel that the address names, #x=..&y=..; null where it names none. */
function linked() {
  const named = new URLSearchParams(location.hash.slice(1));
  if (!named.has("x") || !named.has("y")) return null;
  const [x, y] = [Number(named.get("x")), Number(named.get("y"))];
  return Number.isFinite(x) && Number.isFinite(y) ? [x, y] : null;
}

function fillChoices() {
  for (const side of ["left", "right"]) {
    const choice = byId(side);
    choice.replaceChildren(
      ...[...layers.values()].map((layer) =>
        element("option", { value: layer.id, title: layer.note }, layer.label),
      ),
    );
    choice.addEventListener("change", () => change({ [side]: choice.value }));
  }
}

function keepControls() {
  for (const side of ["left", "right"]) byId(side).value = state[side];
  for (const radio of byId("mode").querySelectorAll("input"))
    radio.checked = radio.value === state.mode;
  byId("marks").checked = state.marks;
}

/** Where the picture's shape allows, the stage has it; else it is as high as the window allows. */
function keepShape() {
  stage.style.setProperty("--shape", `${WIDTH} / ${HEIGHT}`);
}

/** The line below the pixel's numbers; empty, it is not there. */
function say(text) {
  byId("status").textContent = text;
  byId("status").hidden = !text;
}

/** Look at a pixel that somebody named, and say so where there is no such pixel. */
function goTo(look, x, y) {
  look(x, y);
  const pair = (u, v) => `(${general(u, 9)}, ${general(v, 9)})`;
  const there = x === state.x && y === state.y;
  say(there ? "" : `No pixel ${pair(x, y)} in this picture; shown is ${pair(state.x, state.y)}.`);
}

function connect() {
  byId("mode").addEventListener("change", (event) =>
    change({ mode: event.target.value, swapped: false }),
  );
  byId("marks").addEventListener("change", (event) => change({ marks: event.target.checked }));
  byId("exchange").addEventListener("click", exchange);
  byId("zoom-in").addEventListener("click", () => zoomAbout(1.5));
  byId("zoom-out").addEventListener("click", () => zoomAbout(1 / 1.5));
  byId("fit").addEventListener("click", () => setView(0, 0, 0));
  byId("next").addEventListener("click", () => goToExample(1));
  byId("previous").addEventListener("click", () => goToExample(-1));
  byId("theme").addEventListener("click", toggleTheme);
  byId("large").addEventListener("click", toggleLarge);
  byId("help-button").addEventListener("click", () => byId("help").showModal());
  for (const name of ["x", "y"]) {
    byId(name).max = (name === "x" ? WIDTH : HEIGHT) - 1;
    byId(name).addEventListener("change", () => {
      goTo(select, Number(byId("x").value), Number(byId("y").value));
      drawPixel(); // also where the number was out of range and the pixel is the same
      follow();
    });
  }
  onChange(
    ["x", "y", "left", "right", "mode", "swapped", "split", "only", "marks", "view"],
    redraw,
  );
  onChange(["left", "right", "mode", "marks"], keepControls);
  onChange(["mode"], () => {
    setView(state.view.x, state.view.y, scaleNow());
    keepClear();
  });
  onChange(["x", "y"], () => say(""));
  new ResizeObserver(redraw).observe(stage);
  dark.addEventListener("change", redraw);
  window.addEventListener("hashchange", () => linked() && goTo(visit, ...linked()));
}

/** What is unexplained is what one came for: how it is seen best. */
function firstSight() {
  if (!linked() && isAccounted()) return { left: lastPutRight(), mode: "pair", marks: false };
  const { unexplained: many, total } = page.comparison.pixels;
  if (!linked() && (many > WALL * total || page.comparison.advice))
    return { mode: "pair", marks: false };
  return { right: "causes", split: 0 }; // its map covers the stage, and the slider uncovers
}

/** Look at what the address names, else the first example, else the middle of the picture. */
function begin() {
  const wrong = page.comparison.verdict === "differences" && page.comparison.pixels.unexplained;
  if (wrong || page.comparison.advice) change(firstSight());
  const first = wrong ? closeUp() : shownExamples()[0];
  const [x, y] = linked() ?? first ?? [Math.floor(WIDTH / 2), Math.floor(HEIGHT / 2)];
  goTo(linked() ? visit : select, x, y);
  for (const show of [
    drawSummary,
    drawTables,
    drawHelp,
    drawLegend,
    drawExamples,
    drawRegions,
    drawDiagnosis,
    drawPixel,
    drawDerivation,
    drawReadout,
    keepControls,
    redraw,
  ])
    show();
}

async function main() {
  if (!projection) throw new Error(`it has no rays of a ${camera.projection} camera`);
  await loadPixels();
  await loadLayers();
  fillChoices();
  keepShape();
  connect();
  begin();
  chooseLanguage();
  document.documentElement.dataset.ready = "yes"; // for whoever waits, such as a test
}

main().catch((error) => {
  const advice = projection ? " It needs a browser of 2023 or later." : "";
  const why = `This page cannot be shown: ${error.message}.${advice}`;
  document.querySelector("main").prepend(element("p", { class: "notice", role: "alert" }, why));
});

// For a browser's console, as a lecture may want it: referenceTracer.derive(316, 111, "float32")
window.referenceTracer = {
  page,
  pixels,
  state,
  cameraRay,
  surfaceOf,
  tracedT: (x, y) => tracedT(y * WIDTH + x),
  derive: (x, y, precision = "float64", surface = surfaceOf(pixels.surface[y * WIDTH + x])) =>
    derive(x, y, surface, precision),
};
