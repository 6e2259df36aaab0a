"use strict";
// The page of an animation: its curves, its worst frames, and a table of all.

document.title = `${page.title} – Reference Tracer`;
document.querySelector("h1").append(page.title);
byId("summary").append(page.summary);
byId("curves").append(...page.plots.map(plotFigure));
document.querySelector(".worst").append(...page.worst.map(figureOf));
document.querySelector("table").append(
  element("tr", {}, ...page.head.map((name) => element("th", {}, name))),
  ...page.frames.map(({ link, cells: [frame, ...counts] }) =>
    element(
      "tr",
      {},
      element("td", {}, link ? element("a", { href: link }, frame) : frame),
      ...counts.map((cell) => element("td", {}, cell)),
    ),
  ),
);

/** A frame's pictures, which lead to its page, with its counts below. */
function figureOf({ link, words, bad, pictures }) {
  const images = pictures.map(({ png, alt }) =>
    element("img", { src: `data:image/png;base64,${png}`, alt }),
  );
  return element(
    "figure",
    {},
    element("a", { href: link }, ...images),
    element("figcaption", { class: bad && "bad" }, words),
  );
}
