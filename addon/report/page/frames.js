"use strict";
// Frames around the regions of unexplained pixels, each with its number, and the list of them.

const LISTED_REGIONS = 12;
const ROOM = 5; // screen pixels between a region and its frame
const LEAST = 22; // screen pixels: what a frame of one pixel has from afar
const NAMED_IN = 3; // objects that a region is named by

const unexplained = () => page.causes.find((cause) => cause.name === "unexplained");
const framesShown = () =>
  page.regions.length && isShown(unexplained().value) && !isAccounted();

/** Frame each region in a pane. A frame's number stands where no other one does. */
function drawFrames(context, pane) {
  if (!framesShown()) return;
  const size = 12;
  const taken = [];
  context.font = `600 ${size}px system-ui, sans-serif`;
  context.textBaseline = "middle";
  const boxes = page.regions.map((region) => frameOf(pane, region));
  boxes.forEach((box, k) => {
    const inner = boxes.slice(0, k).some((larger) => overlap(box, larger));
    for (const [color, width] of [
      ["#000000", inner ? 2.5 : 4],
      [unexplained().color, inner ? 1 : 2], // thin where it crosses a larger one's
    ]) {
      context.strokeStyle = color;
      context.lineWidth = width;
      context.strokeRect(box.x, box.y, box.width, box.height);
    }
    const text = String(k + 1);
    const label = { width: context.measureText(text).width + 8, height: size + 4 };
    const free = [box.y - label.height, box.y + box.height, box.y].flatMap((y) =>
      [box.x, box.x + box.width - label.width].map((x) => ({ ...label, x, y })),
    );
    const place = free.find((f) => within(f, pane) && !taken.some((t) => overlap(f, t)));
    if (!place) return; // the list below numbers it, too
    taken.push(place);
    context.fillStyle = "#000000d0";
    context.fillRect(place.x, place.y, place.width, place.height);
    context.fillStyle = "#ffffff";
    context.fillText(text, place.x + 4, place.y + place.height / 2 + 1);
  });
}

/** A region's frame on the canvas: around it, never smaller than one sees. */
function frameOf(pane, region) {
  const [left, top] = toPane(pane, region.left, region.top + 1);
  const s = scaleNow();
  const grow = (length) => Math.max(length * s + 2 * ROOM, LEAST);
  const [width, height] = [grow(region.width), grow(region.height)];
  const x = left + (region.width * s - width) / 2;
  const y = top + (region.height * s - height) / 2;
  return { x, y, width, height };
}

const within = (a, pane) =>
  a.x >= pane.x &&
  a.y >= pane.y &&
  a.x + a.width <= pane.x + pane.width &&
  a.y + a.height <= pane.y + pane.height;
const overlap = (a, b) =>
  a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;

/** The names of a region's objects, the first few of them. */
function namesOf({ objects }) {
  const more = objects.length - NAMED_IN;
  const named = objects.slice(0, NAMED_IN).join(", ") || "nothing";
  return more > 0 ? `${named} and ${count(more)} more` : named;
}

/** Say how many regions are framed, and list the largest: each is a way to it. */
function drawRegions() {
  const { regions } = page;
  const where = byId("regions");
  where.hidden = !regions.length || !isShown(unexplained().value);
  if (where.hidden) return;
  if (isAccounted()) {
    const all = page.comparison.pixels.unexplained;
    const said = `What is wrong accounts for ${count(all - diagnosis.left)} of ${count(all)} unexplained pixels: no region is framed.`;
    where.replaceChildren(element("span", {}, said));
    return;
  }
  const said =
    regions.length === 1
      ? "The unexplained pixels are in one region, which is framed:"
      : `The unexplained pixels are in ${count(regions.length)} regions, each framed:`;
  const chip = (region, k) =>
    element(
      "button",
      { type: "button", class: "chip", onclick: () => visitRegion(region) },
      element("strong", {}, k + 1),
      `${namesOf(region)}, ${count(region.pixels)} px`,
    );
  const more = regions.length - LISTED_REGIONS;
  where.replaceChildren(
    element("span", {}, said),
    ...regions.slice(0, LISTED_REGIONS).map(chip),
    ...(more > 0 ? [element("span", { class: "muted" }, `and ${count(more)} smaller ones`)] : []),
  );
}

/** Come so near to a region that it fills half of a pane; look at its first unexplained pixel. */
function visitRegion(region) {
  const bottom = region.top - region.height + 1;
  const pixel = pixels.differing.index.find(
    (i, k) =>
      pixels.differing.cause[k] === unexplained().value &&
      i % WIDTH >= region.left &&
      i % WIDTH < region.left + region.width &&
      i >= bottom * WIDTH &&
      i < (region.top + 1) * WIDTH,
  );
  select(pixel % WIDTH, Math.floor(pixel / WIDTH));
  const [pane] = panes();
  const scale = Math.min(pane.width / region.width, pane.height / region.height) / 2;
  setView(region.left + region.width / 2, bottom + region.height / 2, clamp(scale, 0, 24));
}

onChange(["only"], drawRegions);
