"use strict";
// The textbook's formulas, which the page is sent as text: evaluated, and written for the reader.
//
// A formula is [left side, right side, remark]. It is evaluated as `derivation/textbook.py` does it, one
// operation after the other as it is printed, so that every number has the tracer's bits.

const TOKEN = /‖n‖²|[A-Za-z]+[ₛ₁₂₃]*(?:_[a-z]+)?|\S/gu;
const OPERATIONS = {
  "+": { binding: 1, of: (a) => a.add, ofVectors: (a) => a.plus },
  "−": { binding: 1, of: (a) => a.sub, ofVectors: (a) => a.minus },
  "·": { binding: 2, ofVectors: (a) => a.dot },
  "×": { binding: 2, ofVectors: (a) => a.cross },
  "/": { binding: 2, of: (a) => a.div },
};
const parsed = new Map(); // a formula's text, as a function of an arithmetic and the letters' values

/** Text -> a function (arithmetic, names) -> number or vector. */
function parse(text) {
  if (!parsed.has(text)) parsed.set(text, expression(text.match(TOKEN).reverse(), 0));
  return parsed.get(text);
}

/** Take tokens off the end of the list, as far as operators bind more strongly. */
function expression(tokens, binding) {
  let value = operand(tokens);
  while (tokens.length && tokens.at(-1) !== ")") {
    const left = value;
    const operation = OPERATIONS[tokens.at(-1)];
    if (!operation) {
      const right = operand(tokens); // side by side: a product
      value = (a, names) => product(a, left(a, names), right(a, names));
      continue;
    }
    if (operation.binding <= binding) break;
    tokens.pop();
    const right = expression(tokens, operation.binding);
    value = (a, names) => {
      const [x, y] = [left(a, names), right(a, names)];
      return (Array.isArray(x) ? operation.ofVectors : operation.of)(a)(x, y);
    };
  }
  return value;
}

function operand(tokens) {
  const token = tokens.pop();
  if (token === "−") {
    const value = operand(tokens);
    return (a, names) => product(a, -1, value(a, names));
  }
  if (token !== "(") return (_, names) => names.get(token);
  const value = expression(tokens, 0);
  tokens.pop(); // the closing bracket
  return value;
}

function product(a, x, y) {
  if (Array.isArray(x)) return a.times(y, x);
  return Array.isArray(y) ? a.times(x, y) : a.mul(x, y);
}

/** The values of formulas by their keys, each made of what is given and of those before it. */
function evaluateAll(formulas, given, precision) {
  const a = arithmetic(precision);
  const names = new Map(Object.entries(given));
  const found = {};
  for (const [key, [label, right]] of Object.entries(formulas)) {
    if (!names.has(label)) names.set(label, parse(right || label)(a, names));
    found[key] = names.get(label);
  }
  return found;
}

const VECTORS = new Set(page.formulas.vectors);

/** A formula for the reader: letters slanted, vectors upright and bold. */
function formula(text) {
  const made = element("span", { class: "formula" });
  for (const [token, name, below] of text.matchAll(/(\.?[a-zA-Z]+)(?:_([a-z]+))?|[^a-zA-Z.]+|\./g)) {
    if (name)
      made.append(element("var", { class: VECTORS.has(name) ? "vector" : null }, name));
    else made.append(token);
    if (below) made.append(element("sub", {}, below));
  }
  return made;
}
