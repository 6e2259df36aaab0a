// A right ray/triangle test in JavaScript: reftrace judge --run 'node textbook.js {rays} {answers}'
const fs = require("fs");
const [rays, answers] = process.argv.slice(2);

const sub = (a, b) => a.map((v, k) => v - b[k]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];

function intersect(o, d, p1, p2, p3) {
  const n = cross(sub(p3, p1), sub(p2, p1));
  const t = -dot(sub(o, p1), n) / dot(d, n);
  const x = o.map((v, k) => v + t * d[k]);
  const weight = (a, b) => dot(n, cross(sub(a, b), sub(x, b))) / dot(n, n);
  const s = [weight(p2, p3), weight(p3, p1), weight(p1, p2)];
  return t > 0 && s.every((v) => v >= 0) ? [t, ...s] : [Infinity];
}

const lines = fs.readFileSync(rays, "utf8").trim().split("\n");
const found = lines.map((line) => {
  const v = line.split(",").map(Number);
  return intersect(...[0, 3, 6, 9, 12].map((k) => v.slice(k, k + 3))).join(",");
});
fs.writeFileSync(answers, found.join("\n") + "\n");
