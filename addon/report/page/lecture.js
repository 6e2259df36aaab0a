"use strict";
// A derivation for the reader, of what `report/shown.py` sends: headings, sentences and tables.

/** A derivation as an element; its headings stand so many levels below the page's own. */
function lecture({ blocks, drawn }, below = 0) {
  const parts = [];
  for (const block of blocks) {
    if (block.is === "heading") parts.push([block]);
    else parts.at(-1).push(block);
  }
  const [first, ...others] = parts.map((part) => partOf(part, below));
  const heads = parts.map(([head]) => head);
  return element(
    "section",
    { class: "lecture", lang: "en", translate: "no" },
    first,
    contentsOf(heads.filter(({ name, folded }) => name && !folded)),
    element("div", { class: "drawings" }, ...drawings(drawn)),
    ...others,
  );
}

/** A heading and what is below it; below a candidate's name it can be folded. */
function partOf([head, ...blocks], below) {
  const attributes = { id: head.name && `derivation-${head.name}`, "aria-level": head.level + below };
  const heading = element(`h${head.level}`, attributes, head.text);
  const made = blocks.map((block) => blockOf(block, head));
  if (head.level < 3) return element("div", {}, heading, ...made);
  return element("details", { open: !head.folded }, element("summary", {}, heading), ...made);
}

function contentsOf(heads) {
  const links = heads.map(({ name, text }) =>
    element("li", {}, element("a", { href: `#derivation-${name}` }, text)),
  );
  return element("nav", { "aria-label": "Contents" }, element("ol", {}, ...links));
}

function blockOf({ is, text, tone, srgb, head, rows, kind }, { text: caption }) {
  if (is === "table")
    return table(caption, head, rows.map((row) => row.map(cellOf)), [], kind, Infinity);
  const color = srgb && element("i", { style: `background: ${srgb}` });
  return element("p", { class: tone }, color || null, text);
}

/** Text, a formula with its remark, or a number with its wrong digits marked. */
function cellOf(cell) {
  if (cell.is === "formula") {
    const { label, right, remark } = cell;
    const said = element("small", { class: "muted" }, remark);
    return element("span", {}, formula(right ? `${label} = ${right}` : label), remark ? said : null);
  }
  if (cell.is !== "parts") return cell;
  const wrong = cell.wrong ? element("mark", { class: "off" }, cell.wrong) : null;
  return element("span", { class: "digits" }, cell.right, wrong, cell.exponent);
}
