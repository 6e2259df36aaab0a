"use strict";
// Each cause has a shape beside its colour, so that no two are told apart by colour alone.

// Drawn in a square from -1 to 1; a shape is a list of polygons, closed or open.
const SHAPES = {
  circle: null, // the one that is no polygon
  cross: [
    [
      [-0.8, -0.8],
      [0.8, 0.8],
    ],
    [
      [-0.8, 0.8],
      [0.8, -0.8],
    ],
  ],
  triangle: [
    [
      [0, -0.95],
      [0.9, 0.7],
      [-0.9, 0.7],
      [0, -0.95],
    ],
  ],
  square: [
    [
      [-0.75, -0.75],
      [0.75, -0.75],
      [0.75, 0.75],
      [-0.75, 0.75],
      [-0.75, -0.75],
    ],
  ],
  diamond: [
    [
      [0, -1],
      [1, 0],
      [0, 1],
      [-1, 0],
      [0, -1],
    ],
  ],
  plus: [
    [
      [0, -1],
      [0, 1],
    ],
    [
      [-1, 0],
      [1, 0],
    ],
  ],
  turned: [
    [
      [0, 0.95],
      [0.9, -0.7],
      [-0.9, -0.7],
      [0, 0.95],
    ],
  ],
  bars: [
    [
      [-0.9, -0.5],
      [0.9, -0.5],
    ],
    [
      [-0.9, 0.5],
      [0.9, 0.5],
    ],
  ],
  hexagon: [
    [
      [-0.5, -0.87],
      [0.5, -0.87],
      [1, 0],
      [0.5, 0.87],
      [-0.5, 0.87],
      [-1, 0],
      [-0.5, -0.87],
    ],
  ],
  chevron: [
    [
      [-0.9, 0.5],
      [0, -0.5],
      [0.9, 0.5],
    ],
  ],
  hourglass: [
    [
      [-0.8, -0.8],
      [0.8, -0.8],
      [-0.8, 0.8],
      [0.8, 0.8],
      [-0.8, -0.8],
    ],
  ],
  line: [
    [
      [-0.9, 0],
      [0.9, 0],
    ],
  ],
  star: [
    [
      [0, -1],
      [0, 1],
    ],
    [
      [-0.87, -0.5],
      [0.87, 0.5],
    ],
    [
      [-0.87, 0.5],
      [0.87, -0.5],
    ],
  ],
};
const SHAPE_OF = {
  edge: "circle",
  depth_tie: "triangle",
  not_modelled: "diamond",
  not_decidable: "bars",
  unexplained: "cross",
  not_traced: "line",
};

/** By their values, the causes that a pixel may differ for, the worst first, each with its shape. */
const CAUSES = new Map();
{
  const free = Object.keys(SHAPES).filter((shape) => !Object.values(SHAPE_OF).includes(shape));
  const worst = (cause) => Number(cause.name !== "unexplained");
  for (const cause of page.causes.filter((c) => c.color).sort((a, b) => worst(a) - worst(b))) {
    CAUSES.set(cause.value, { ...cause, shape: SHAPE_OF[cause.name] ?? free.shift() ?? "circle" });
  }
}

/** Add a shape to a canvas's path, around (x, y), so many pixels high and wide. */
function trace(context, shape, x, y, size) {
  const r = size / 2;
  context.beginPath();
  if (!SHAPES[shape]) {
    context.arc(x, y, 0.9 * r, 0, 2 * Math.PI);
    return;
  }
  for (const polygon of SHAPES[shape]) {
    polygon.forEach(([u, v], k) => context[k ? "lineTo" : "moveTo"](x + r * u, y + r * v));
  }
}

/** Draw a cause's sign, with a dark rim that shows it on any picture. */
function drawGlyph(context, cause, x, y, size, width = 2) {
  trace(context, cause.shape, x, y, size);
  context.lineJoin = context.lineCap = "round";
  for (const [color, line] of [
    ["#000000", width + 2.5],
    [cause.color, width],
  ]) {
    context.strokeStyle = color;
    context.lineWidth = line;
    context.stroke();
  }
}

/** A cause's sign for the legend and tables. */
function glyphOf(cause, size = 18) {
  const canvas = element("canvas", { class: "glyph", "aria-hidden": "true" });
  const ratio = 3; // also sharp on a projector, in large type and in print
  canvas.width = canvas.height = size * ratio;
  const context = canvas.getContext("2d");
  context.scale(ratio, ratio);
  context.fillStyle = "#2b2b2b";
  context.beginPath();
  context.roundRect(0, 0, size, size, 3);
  context.fill();
  drawGlyph(context, cause, size / 2, size / 2, size * 0.58);
  return canvas;
}
