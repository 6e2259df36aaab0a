"use strict";
// Plots of what `report/plots.py` sends: axes with round numbers, marks and lines, on white paper.

const PLOT_WIDTH = 1920; // what a projector shows
const PLOT_LINE = 1.25; // from one line of words to the next, in sizes of the font
const ACROSS = 4; // small plots beside one another
// Sizes of a title, the labels and the numbers at the axes: legible from the back row, or as large as
// small multiples have room for; and where the axes are in a panel of so many units.
const LAYOUTS = {
  large: { sizes: [32, 27, 23], box: [220, 90, 1660, 280], wide: PLOT_WIDTH, high: 440 },
  small: { sizes: [22, 19, 17], box: [85, 65, 365, 200], wide: PLOT_WIDTH / ACROSS, high: 360 },
};
const INKS = { ink: "#222222", grey: "#707070", faint: "#c8c8c8" };

/** A plot with its legend, as a figure, which can be saved as a file. */
function plotFigure(plot) {
  const drawn = plotOf(plot);
  const save = () => {
    const copy = drawn.cloneNode(true);
    copy.setAttribute("font-family", "sans-serif");
    const file = new Blob([new XMLSerializer().serializeToString(copy)], { type: "image/svg+xml" });
    const link = element("a", { href: URL.createObjectURL(file), download: "plot.svg" });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  };
  const button = element("button", { type: "button", class: "link", onclick: save }, "Save as SVG");
  const box = element("div", { class: "plot", tabindex: "0", role: "group" }, drawn);
  return element("figure", { translate: "no" }, box, element("figcaption", {}, button));
}

function plotOf({ title, about, heading, note, small, panels, legend }) {
  const layout = LAYOUTS[small ? "small" : "large"];
  const parts = [];
  let top = 28;
  for (const [words, size, color] of [
    [heading, 27, INKS.ink],
    [note, 19, INKS.grey],
  ]) {
    const lines = words ? words.split("\n") : [];
    parts.push(wordsAt([20, top + ((lines.length - 1) * PLOT_LINE * size) / 2], words, size, { fill: color }));
    top += lines.length * PLOT_LINE * size;
  }
  const across = small ? ACROSS : 1;
  panels.forEach((panel, k) => {
    const [left, above, width, height] = layout.box;
    const column = layout.wide * (k % across);
    const row = top + layout.high * Math.floor(k / across);
    parts.push(panelOf(panel, [left + column, above + row, width, height], layout.sizes, small));
  });
  const height = top + layout.high * Math.ceil(panels.length / across) + 60;
  parts.push(legendOf(legend, height - 30));
  return svgElement(
    "svg",
    { viewBox: `0 0 ${PLOT_WIDTH} ${height}`, role: "img" },
    svgElement("title", {}, legal(title)),
    svgElement("desc", {}, legal(about)),
    svgElement("rect", { width: PLOT_WIDTH, height, fill: "white" }),
    ...parts,
  );
}

/** Lines of words with their middle at a place, where they start, end, or have their own middle. */
function wordsAt([x, middle], words, size, { anchor = "start", fill = INKS.ink, turn = 0 } = {}) {
  const lines = (words || "").split("\n");
  const foot = middle + size * (0.35 - (PLOT_LINE * (lines.length - 1)) / 2);
  const texts = lines.map((line, k) => {
    const place = { x, y: foot + PLOT_LINE * size * k, "font-size": size };
    const transform = turn ? `rotate(${turn} ${x} ${middle})` : null;
    return svgElement("text", { ...place, fill, "text-anchor": anchor, transform }, legal(line));
  });
  return svgElement("g", {}, ...texts.filter(({ textContent }) => textContent.trim()));
}

/** Words with what XML cannot hold, as control characters, made visible. */
const legal = (words) => words.replace(/[^\t\n\r\u{20}-\u{fffd}\u{10000}-\u{10ffff}]/gu, "\ufffd");

function path(places, { color, width, hollow, opacity = 1 }) {
  return svgElement("polyline", {
    points: places.map((place) => place.join()).join(" "),
    stroke: color,
    "stroke-width": width,
    fill: "none",
    opacity,
    "stroke-dasharray": hollow ? 1.2 * width : null,
  });
}

/** A round mark, which says its words where it is pointed at. */
function dot([cx, cy], { color, radius, hollow }, words) {
  const title = words ? svgElement("title", {}, legal(words)) : null;
  const fill = hollow ? "white" : color;
  const stroke = { stroke: color, "stroke-width": 0.3 * radius };
  return svgElement("circle", { cx, cy, r: radius, fill, ...stroke }, title);
}

/** The sides, a faint grid, all that is written (slanted below small axes), and the series. */
function panelOf({ title, along, up, x, y, series }, [left, top, width, height], sizes, small) {
  const [ofTitle, ofLabels, ofTicks] = sizes;
  const [bottom, right] = [top + height, left + width];
  const at = ([u, v]) => [left + width * share(x, u), bottom - height * share(y, v)];
  const [xTicks, yTicks] = [ticksOf(x), ticksOf(y)];
  const longest = (ticks) => Math.max(...ticks.map(([, words]) => widthOf(words, ofTicks)));
  const beside = left - longest(yTicks) - 22 - 0.7 * ofLabels;
  const deep = small ? longest(xTicks) / Math.SQRT2 + 2 * ofTicks : 1.9 * ofTicks;
  const grid = { color: INKS.faint, width: 1, opacity: 0.6 };
  const slant = small ? { anchor: "end", turn: -45 } : { anchor: "middle" };
  const sides = [[left, top], [left, bottom], [right, bottom]];
  return svgElement(
    "g",
    { "data-panel": title },
    wordsAt([small ? left - 65 : left, top - 14 - (ofTitle * PLOT_LINE) / 2], title, ofTitle),
    wordsAt([left + width / 2, bottom + 0.7 * ofLabels + deep], along, ofLabels, { anchor: "middle" }),
    wordsAt([beside, (top + bottom) / 2], up, ofLabels, { anchor: "middle", turn: -90 }),
    ...xTicks.flatMap(([value, words]) => {
      const place = left + width * share(x, value);
      const said = wordsAt([place, bottom + 1.1 * ofTicks], words, ofTicks, slant);
      return [path([[place, top], [place, bottom]], grid), said];
    }),
    ...yTicks.flatMap(([value, words]) => {
      const place = bottom - height * share(y, value);
      const said = wordsAt([left - 12, place], words, ofTicks, { anchor: "end" });
      return [path([[left, place], [right, place]], grid), said];
    }),
    path(sides, { color: INKS.faint, width: 1.5 }),
    ...series.flatMap((one) => [
      one.width ? path(one.points.map(at), one) : null,
      ...(one.radius ? one.points.map((point) => dot(at(point), one, point[2])) : []),
    ]),
  );
}

/** Marks and lines with their meaning, in one row in the middle of the picture's width. */
function legendOf(entries, y, size = LAYOUTS.large.sizes[2]) {
  const side = 1.4 * size; // from the middle of a mark to its words
  const widths = entries.map(({ words }) => side + widthOf(words, size) + 2 * size);
  const whole = widths.reduce((sum, width) => sum + width, 0);
  if (whole > PLOT_WIDTH) return legendOf(entries, y, (size * (PLOT_WIDTH - 1)) / whole);
  let x = PLOT_WIDTH / 2 - whole / 2 + size;
  const parts = entries.flatMap(({ words, sample }, k) => {
    const at = x;
    x += widths[k];
    return [
      sample.width ? path([[at - 20, y], [at + 20, y]], sample) : null,
      sample.radius ? dot([at, y], sample) : null,
      wordsAt([at + side, y], words, size),
    ];
  });
  return svgElement("g", { class: "entries" }, ...parts);
}

/** Where a number is on a scale: 0 at the low end, 1 at the high one. */
function share({ low, high, kind }, value) {
  if (kind === "log") return Math.log(value / low) / Math.log(high / low);
  return (value - low) / (high - low);
}

/** The numbers that are written along a scale, and the words of each. */
function ticksOf({ low, high, kind, named, least }) {
  const begin = least ?? low;
  const round = {
    named: () => [],
    integers: () => steps125(begin, high, 8).filter(Number.isInteger),
    log: () => logarithmic(begin, high),
  }[kind]();
  const words = kind === "integers" ? count : general;
  return [...round.map((value) => [value, words(value)]), ...named];
}

/** The multiples between two numbers of 1, 2 or 5 times a power of ten. */
function steps125(low, high, most) {
  const least = (high - low) / most;
  const power = 10 ** Math.floor(Math.log10(least));
  const step = [1, 2, 5, 10].map((s) => s * power).find((s) => s >= least);
  const first = Math.ceil(low / step);
  return Array.from({ length: Math.floor(high / step) - first + 1 }, (_, k) => (first + k) * step);
}

/** About five to ten round numbers of a logarithmic scale. */
function logarithmic(low, high) {
  if (high < 5 * low) return steps125(low, high, 6); // there may be no 1, 2 or 5 in between
  const [first, last] = [Math.floor(Math.log10(low)), Math.ceil(Math.log10(high))];
  const powers = Array.from({ length: last - first + 1 }, (_, k) => first + k);
  const every = Math.ceil(powers.length / 10);
  const steps = high < 500 * low ? [1, 2, 5] : [1];
  return powers
    .filter((_, k) => k % every === 0)
    .flatMap((power) => steps.map((s) => Number(`${s}e${power}`)))
    .filter((value) => value >= low && value <= high);
}
