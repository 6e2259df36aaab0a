"use strict";
// The card of the diagnosis: each fault that was found, and the picture with it put right.

const PUT_RIGHT = "put_right_"; // of the layer of each fault, with its number
const CROP = [64, 36]; // pixels in the close-up
const NEARLY_ALL = 0.9; // of the unexplained pixels

const diagnosis = page.comparison.diagnosis;

/** Whether the named faults account for nearly all unexplained pixels. */
const isAccounted = () =>
  diagnosis?.told.length > 0 &&
  diagnosis.left <= (1 - NEARLY_ALL) * page.comparison.pixels.unexplained;

/** The last picture with all named faults put right; the traced one where none changes it. */
function lastPutRight() {
  const isTold = ({ id, of }) => of && !diagnosis.told[id.slice(PUT_RIGHT.length)].alternative;
  return page.pictures.findLast(isTold)?.id ?? "traced";
}

/** What is wrong where no fault is known: how many pixels, and where most of them are. */
function unknown({ silent, left }) {
  if (silent) return silent;
  const names = namesOf(page.regions[0]);
  return `no known fault accounts for ${count(left)} px, the most of them at ${names}`;
}

/** How many of the unexplained pixels a fault accounts for, and what it would break. */
function settledBy({ settled, unexplained: all, broken }) {
  const lost = broken
    ? broken === 1
      ? "1 that agreed is lost"
      : `${count(broken)} that agreed are lost`
    : "none that agreed is lost";
  const agree = `${count(settled)} of ${count(all)} unexplained pixels agree`;
  return `With this put right, ${agree}, and ${lost}.`;
}

function drawDiagnosis() {
  const { transform, advice } = page.comparison;
  byId("diagnosis").hidden = !diagnosis;
  byId("told").hidden = !diagnosis && !advice;
  byId("told").replaceChildren(
    element("strong", {}, "Diagnosis: "),
    advice && `the picture's colours: ${transform}. What to do: ${advice}.`,
  );
  if (!diagnosis) return;
  const { told, guesses, regions, untried, silent } = diagnosis;
  const names = untried.map((name) => name.replaceAll("_", " ")).join(", ");
  const work =
    `${count(guesses)} guesses were tried in ${seconds(diagnosis.seconds)}` +
    (names ? `; a limit of work ended the search for: ${names}.` : ".");
  byId("told").append(
    advice && " And ",
    told.length ? "" : element("a", { href: "#diagnosis" }, unknown(diagnosis)),
    ...told.flatMap(({ sentence, alternative }, k) => [
      alternative ? ", or, as likely, " : k ? ", and " : "",
      element("a", { href: "#diagnosis" }, sentence),
    ]),
  );
  byId("diagnosis").replaceChildren(
    element("h2", { id: "diagnosis-title" }, "What is wrong"),
    element(
      "p",
      { class: "muted" },
      told.length
        ? `${work} These faults were traced and compared again, pixel by pixel. The verdict stays.`
        : silent
          ? `${silent}.`
          : `${work} None accounts for the unexplained pixels.`,
    ),
    ...told.map(faultOf),
    ...(regions.length ? [leftOf(diagnosis)] : []),
  );
}

/** A fault: its sentence, what it settles, its numbers, and the pictures. */
function faultOf(fault, k) {
  const numbers = Object.entries(fault.numbers).map(([name, [value, low, high]]) => [
    name.replaceAll("_", " "),
    low === undefined || low === high
      ? general(value)
      : `${general(value)} (${general(low)} to ${general(high)})`,
  ]);
  return element(
    "article",
    { class: "fault" },
    element("h3", {}, fault.alternative ? "Or, as likely: " : "", fault.sentence),
    element("p", {}, settledBy(fault)),
    fault.also.length
      ? element("p", {}, `So do: ${fault.also.map((name) => name.replaceAll("_", " ")).join(", ")}.`)
      : null,
    fault.advice ? element("p", { class: "advice" }, fault.advice) : null,
    numbers.length ? facts(numbers) : null,
    layers.has(PUT_RIGHT + k) ? putRight(k) : null,
  );
}

/** One slider between a picture as it is and with the fault put right, over all and from near. */
function putRight(k) {
  const side = page.pictures.find(({ id }) => id === PUT_RIGHT + k).of;
  const other = side === "traced" ? "blender" : "traced";
  const ids = [side, PUT_RIGHT + k];
  const [x, y] = closeUp();
  const both = (...made) => element("div", { class: "both" }, ...made);
  const slider = element("input", {
    type: "range",
    min: 0,
    max: 100,
    value: 50,
    "aria-label": "From as it is to with this put right",
    oninput: (event) => figure.style.setProperty("--at", `${event.target.value}%`),
  });
  const under = (text) => element("figcaption", {}, text);
  const near = `from near, around (${x}, ${y})`;
  const figure = element(
    "div",
    { class: "put-right" },
    element(
      "div",
      { class: "ends" },
      element("span", {}, "as it is"),
      slider,
      element("span", {}, "with this put right"),
    ),
    element(
      "div",
      { class: "views" },
      element("figure", {}, both(...ids.map(whole)), under(layers.get(side).label)),
      element(
        "figure",
        {},
        both(...ids.map((id) => crop(id, x, y))),
        under(`${layers.get(side).label}, ${near}`),
      ),
      element("figure", {}, crop(other, x, y), under(`${layers.get(other).label}, ${near}`)),
    ),
    element(
      "button",
      {
        type: "button",
        onclick: () => {
          change({ left: PUT_RIGHT + k, right: other, mode: "pair" });
          visit(x, y);
          byId("viewer").scrollIntoView();
        },
      },
      "Look at it in the pictures",
    ),
  );
  return figure;
}

/** The unexplained example with the most unexplained pixels around it. */
function closeUp() {
  const wanted = unexplained().value;
  const around = ([x, y]) => {
    let found = 0;
    const [halfX, halfY] = CROP.map((size) => size / 2);
    for (let j = Math.max(0, y - halfY); j < Math.min(HEIGHT, y + halfY); j++)
      for (let i = Math.max(0, x - halfX); i < Math.min(WIDTH, x + halfX); i++)
        found += pixels.cause[j * WIDTH + i] === wanted;
    return found;
  };
  const examples = examplesOf(unexplained());
  return examples.reduce((best, one) => (around(one) > around(best) ? one : best), examples[0]);
}

/** A copy of a layer, all of it. */
function whole(id) {
  return crop(id, WIDTH / 2, HEIGHT / 2, [WIDTH, HEIGHT]);
}

/** A part of a layer around a pixel, with its own pixels. */
function crop(id, x, y, [width, height] = CROP) {
  const [w, h] = [Math.min(width, WIDTH), Math.min(height, HEIGHT)];
  const label = layers.get(id).label;
  const made = element("canvas", { width: w, height: h, role: "img", "aria-label": label });
  const left = clamp(Math.round(x - w / 2), 0, WIDTH - w);
  const top = clamp(Math.round(HEIGHT - 1 - y - h / 2), 0, HEIGHT - h);
  made.getContext("2d").drawImage(layerOf(id).canvas, left, top, w, h, 0, 0, w, h);
  return made;
}

/** The regions that nothing accounts for: each by the objects in it. */
function leftOf({ left, regions }) {
  const one = (region) =>
    element(
      "button",
      {
        type: "button",
        class: "chip",
        onclick: () => {
          visitRegion(region);
          byId("viewer").scrollIntoView();
        },
      },
      `${namesOf(region)}, ${count(region.pixels)} px`,
    );
  const many = regions.length === 1 ? "one region" : `${count(regions.length)} regions`;
  return element(
    "div",
    { class: "chips" },
    element("span", {}, `Nothing accounts for ${count(left)} px, in ${many}:`),
    ...regions.map(one),
  );
}
