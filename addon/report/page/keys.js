"use strict";
// Keys, and the three buttons on top. The list is what the help shows.

const MODES = ["slider", "swap", "pair", "all"];

/** Show the next picture of those that there are on a side. */
function cycle(side) {
  const ids = [...layers.keys()];
  change({ [side]: ids[(ids.indexOf(state[side]) + 1) % ids.length] });
}

/** Exchange the pictures; in hover swap, show the other one. */
function exchange() {
  if (state.mode === "swap") change({ swapped: !state.swapped });
  else change({ left: state.right, right: state.left });
}

const KEYS = [
  [["?"], "these keys", () => byId("help").showModal()],
  [["n"], "the next example of a pixel that differs", () => goToExample(1)],
  [["p"], "the previous one", () => goToExample(-1)],
  [["s"], "exchange the two pictures (hover swap: show the other one)", exchange],
  [
    ["m"],
    "slider, hover swap, side by side, all",
    () => change({ mode: MODES[(MODES.indexOf(state.mode) + 1) % MODES.length] }),
  ],
  [["["], "another picture on the left", () => cycle("left")],
  [["]"], "another picture on the right", () => cycle("right")],
  [
    ["c"],
    "the map of causes on the right, or the picture compared",
    () => change({ right: state.right === "causes" ? "blender" : "causes" }),
  ],
  [["d"], "marks in every picture, or in the map alone", () => change({ marks: !state.marks })],
  [["+", "="], "zoom in on the pixel", () => zoomAbout(1.5)],
  [["-", "−"], "zoom out", () => zoomAbout(1 / 1.5)],
  [["0"], "the whole picture", () => setView(0, 0, 0)],
  [
    ["f"],
    "the pictures on the full screen",
    () => (document.fullscreenElement ? document.exitFullscreen() : stage.requestFullscreen()),
  ],
  [["t"], "light or dark", toggleTheme],
  [["l"], "larger type, for a projector", toggleLarge],
];
const STEPS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || byId("help").open) return;
  if (event.target.matches("input:not([type=radio]):not([type=checkbox]), select, textarea"))
    return;
  const step = STEPS[event.key];
  if (step && event.target === canvas) {
    const far = event.shiftKey ? 10 : 1;
    select(state.x + far * step[0], state.y + far * step[1]);
    follow();
    event.preventDefault();
    return;
  }
  const found = KEYS.find(([names]) =>
    names.includes(event.key.length === 1 ? event.key.toLowerCase() : event.key),
  );
  if (!found) return;
  event.preventDefault();
  found[2]();
});

function toggleLarge() {
  const large = document.documentElement.classList.toggle("large");
  byId("large").setAttribute("aria-pressed", String(large));
  redraw();
}

function drawHelp() {
  const entry = (names, text) => [
    element("dt", {}, ...names.flatMap((name) => [element("kbd", {}, name.toUpperCase()), " "])),
    element("dd", {}, text),
  ];
  byId("keys").replaceChildren(
    ...KEYS.flatMap(([names, text]) => entry(names.slice(0, 1), text)),
    ...entry(
      ["← → ↑ ↓"],
      "in the picture: the next pixel; with Shift, ten further. On the slider: move it",
    ),
    ...entry(["Tab"], "to the picture, the slider, every button and table"),
  );
}
