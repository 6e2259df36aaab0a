"use strict";
// The legend, which filters the map of causes, and the examples, which jump to a pixel.

/** The causes that the legend lists: those that there are, and unexplained, which should be 0. */
const listed = () => [...CAUSES.values()].filter((c) => c.pixels || c.name === "unexplained");

function drawLegend() {
  const all = listed().reduce((sum, cause) => sum + cause.pixels, 0);
  byId("legend").replaceChildren(
    legendEntry(null, "All", all),
    ...listed().map((cause) => legendEntry(cause, cause.label, cause.pixels)),
  );
}

function legendEntry(cause, label, number) {
  const value = cause ? cause.value : null;
  return element(
    "button",
    {
      type: "button",
      class: "entry",
      "aria-pressed": String(state.only === value),
      disabled: cause && !number,
      "data-cause": cause ? cause.name : "all",
      onclick: () => {
        change({ only: state.only === value ? null : value });
        byId("legend")
          .querySelector(`[data-cause="${cause ? cause.name : "all"}"]`)
          .focus();
      },
    },
    cause ? glyphOf(cause) : null,
    element("span", {}, label),
    element("span", { class: "number" }, count(number)),
  );
}

function drawExamples() {
  const examples = shownExamples();
  byId("previous").disabled = byId("next").disabled = !examples.length;
  byId("examples").replaceChildren(
    ...(examples.length
      ? examples.map(([x, y, cause]) => exampleChip(x, y, cause))
      : [element("span", { class: "muted" }, noExamples())]),
  );
}

function noExamples() {
  const { differ, not_decidable: open } = page.comparison.pixels;
  return differ + open ? "No example of this." : "No pixel differs.";
}

function exampleChip(x, y, cause) {
  const here = x === state.x && y === state.y;
  return element(
    "button",
    { type: "button", class: "chip", "aria-pressed": String(here), onclick: () => visit(x, y) },
    glyphOf(cause, 14),
    `${x}, ${y}`,
  );
}

onChange(["only"], drawLegend);
onChange(["only", "x", "y"], drawExamples);
