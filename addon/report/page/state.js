"use strict";
// What is shown now. `change` sets some of it; whoever asked with `onChange` hears which.

const state = {
  x: 0, // the chosen pixel
  y: 0,
  left: "traced", // pictures
  right: "blender",
  mode: "slider", // slider, swap, pair or all
  swapped: false, // of `swap`: the right one is seen
  split: 0.5, // of `slider`: where the left one ends
  only: null, // the one cause that is shown; null for all
  marks: true, // also in the pictures
  view: { x: WIDTH / 2, y: HEIGHT / 2, scale: 0 }, // scale: screen pixels a pixel; 0: all of it
};

const EXAMPLES = 10; // of a cause
const listeners = [];
const onChange = (names, listener) => listeners.push({ names, listener });

function change(values) {
  const changed = Object.keys(values).filter((name) => state[name] !== values[name]);
  Object.assign(state, values);
  for (const { names, listener } of listeners) {
    if (changed.some((name) => names.includes(name))) listener();
  }
}

const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

/** Look at a pixel; what lies outside means the nearest one inside. */
function select(x, y) {
  change({
    x: clamp(Math.round(x) || 0, 0, WIDTH - 1),
    y: clamp(Math.round(y) || 0, 0, HEIGHT - 1),
  });
}

/** Whether a cause is shown, as far as the legend says. */
const isShown = (cause) => state.only === null || state.only === cause;

/** The examples of the causes that are shown, [x, y, cause] each. */
function shownExamples() {
  return [...CAUSES.values()]
    .filter((cause) => cause.pixels && isShown(cause.value))
    .flatMap((cause) => examplesOf(cause).map(([x, y]) => [x, y, cause]));
}

/** Some pixels of a cause: those that the comparison names, else the first ones. */
function examplesOf(cause) {
  const named = page.comparison.pixels.examples[cause.name];
  if (named) return named;
  const found = [];
  const { index, cause: causes } = pixels.differing;
  for (let k = 0; k < index.length && found.length < EXAMPLES; k++) {
    if (causes[k] === cause.value) found.push([index[k] % WIDTH, Math.floor(index[k] / WIDTH)]);
  }
  return found;
}

/** Go to the next example (step 1) or the previous one (-1), and come near. */
function goToExample(step) {
  const examples = shownExamples();
  if (!examples.length) return;
  const here = examples.findIndex(([x, y]) => x === state.x && y === state.y);
  const next = here < 0 ? (step > 0 ? 0 : examples.length - 1) : here + step;
  const [x, y] = examples[(next + examples.length) % examples.length];
  visit(x, y);
}

/** Look at a pixel from near, so that it is seen in both pictures. */
function visit(x, y) {
  select(x, y);
  if (state.mode === "slider") {
    const sides = [state.left, state.right];
    change({ mode: "pair" });
    if (sides.includes("causes")) change({ left: "traced", right: "blender" });
  }
  change({ view: { x: state.x + 0.5, y: state.y + 0.5, scale: Math.max(state.view.scale, 20) } });
}
