"use strict";
// The embedded JSON -> `page`, and what pages are made of: elements, and tables of them.

const page = JSON.parse(document.getElementById("data").textContent);

/** Make an element; children are elements or text, never markup. */
const element = (name, attributes, ...children) =>
  withAll(document.createElement(name), attributes, ...children);

/** Make an element of a drawing. */
const svgElement = (name, attributes, ...children) =>
  withAll(
    document.createElementNS("http://www.w3.org/2000/svg", name),
    attributes,
    ...children,
  );

function withAll(made, attributes = {}, ...children) {
  for (const [key, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith("on")) made.addEventListener(key.slice(2), value);
    else made.setAttribute(key, value === true ? "" : value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

const ruler = document.createElement("canvas").getContext("2d");

/** How wide words are in letters of a size. */
function widthOf(words, size) {
  ruler.font = `${size}px ${getComputedStyle(document.body).fontFamily}`;
  return ruler.measureText(words).width;
}

const byId = (id) => document.getElementById(id);

const ROWS = 200; // of a table: thousands would make the page slow

/** A table with a caption; `right` are the columns of numbers, `most` the rows that are shown. */
function table(caption, heads, rows, right = [], kind = "", most = ROWS) {
  const side = (k) => (right.includes(k) ? "number" : null);
  return element(
    "div",
    { class: `scroll ${kind}`, tabindex: "0", role: "group", "aria-label": caption },
    element("p", { class: "scrolls", hidden: true }, "This table goes on to the right: scroll it."),
    element(
      "table",
      {},
      element("caption", {}, caption),
      element(
        "thead",
        {},
        element(
          "tr",
          {},
          ...heads.map((head, k) => element("th", { scope: "col", class: side(k) }, head)),
        ),
      ),
      element(
        "tbody",
        {},
        ...rows
          .slice(0, most)
          .map((row) =>
            element(
              "tr",
              {},
              ...row.map((cell, k) =>
                element("td", { class: side(k), "data-head": side(k) && heads[k] }, cell),
              ),
            ),
          ),
      ),
    ),
    rows.length > most
      ? element("p", {}, `${count(rows.length - most)} more: comparison.json has them all.`)
      : null,
  );
}

/** Say of each table whether it is wider than its place, now and whenever that changes. */
const watched = new ResizeObserver((entries) => {
  for (const { target } of entries) {
    const box = target.closest(".scroll");
    if (box) box.querySelector(".scrolls").hidden = box.scrollWidth <= box.clientWidth;
  }
});
new MutationObserver(() => {
  watched.disconnect();
  for (const box of document.querySelectorAll(".scroll:has(> .scrolls)")) {
    watched.observe(box);
    watched.observe(box.querySelector("table"));
  }
}).observe(document.querySelector("main"), { childList: true, subtree: true });
