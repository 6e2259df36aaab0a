"use strict";
// Numbers: arithmetic that rounds as numpy's does, and how they are written.

/**
 * Arithmetic in one precision. JavaScript computes in float64; of float32 operands, +, -, * and /
 * in float64, rounded to float32, are the float32 operations (Figueroa, "When is double rounding
 * innocuous?", 1995), so that every result has numpy's bits.
 */
function arithmetic(precision) {
  const round = precision === "float32" ? Math.fround : (value) => value;
  const add = (a, b) => round(a + b);
  const sub = (a, b) => round(a - b);
  const mul = (a, b) => round(a * b);
  const div = (a, b) => round(a / b);
  const each = (operation) => (a, b) => a.map((value, i) => operation(value, b[i]));
  return {
    round,
    add,
    sub,
    mul,
    div,
    plus: each(add),
    minus: each(sub),
    times: (scale, v) => v.map((value) => mul(scale, value)),
    // Summed in the order x, y, z.
    dot: (a, b) => add(add(mul(a[0], b[0]), mul(a[1], b[1])), mul(a[2], b[2])),
    cross: (a, b) => [
      sub(mul(a[1], b[2]), mul(a[2], b[1])),
      sub(mul(a[2], b[0]), mul(a[0], b[2])),
      sub(mul(a[0], b[1]), mul(a[1], b[0])),
    ],
  };
}

/** The fewest digits that mean this number and no other of its precision. */
function shortest(value, precision = "float64") {
  if (Object.is(value, -0)) return "−0";
  if (!Number.isFinite(value))
    return Number.isNaN(value) ? "not a number" : signed(String(value), "∞");
  if (precision === "float64") return signed(String(value));
  for (let digits = 1; digits < 10; digits++) {
    const text = value.toPrecision(digits);
    if (Math.fround(Number(text)) === value) return signed(String(Number(text)));
  }
  return signed(String(value));
}

/** With a true minus, and infinity as its sign. */
function signed(text, infinity) {
  if (infinity) return text.startsWith("-") ? `−${infinity}` : infinity;
  return text.replace(/-/g, "−");
}

/** As C and Python write %.<digits>g (but a number that lies just between two goes up). */
function general(value, digits = 6) {
  if (!Number.isFinite(value)) return shortest(value);
  if (value === 0) return "0";
  const exponent = Number(value.toExponential(digits - 1).split("e")[1]);
  if (exponent >= -4 && exponent < digits) {
    const text = value.toFixed(digits - 1 - exponent);
    return signed(text.includes(".") ? text.replace(/\.?0+$/, "") : text);
  }
  const [mantissa, power] = value.toExponential(digits - 1).split("e");
  const short = mantissa.includes(".") ? mantissa.replace(/\.?0+$/, "") : mantissa;
  return signed(`${short}e${power[0]}${power.slice(1).padStart(2, "0")}`);
}

/** Fill a sentence as Python's str.format does, for the fields {name} and {name:.<n>g}. */
function filled(sentence, values) {
  return sentence.replace(/\{(\w+)(?::(,|\.(\d+)([gf])))?\}/g, (_, name, format, digits, kind) => {
    const value = values[name];
    if (typeof value !== "number") return String(value);
    if (kind === "g") return general(value, Number(digits));
    if (kind === "f") return signed(value.toFixed(Number(digits)));
    return format === "," ? count(value) : shortest(value);
  });
}

/** An integer with commas. */
const count = (value) => value.toLocaleString("en-US");

/** A part of a whole in per cent; 100 and 0 only where it is all or nothing. */
function percent(part, whole) {
  if (part === whole) return "100 %";
  const text = ((100 * part) / whole).toFixed(2);
  if (Number(text) === 100) return "> 99.99 %";
  return part && Number(text) === 0 ? "< 0.01 %" : `${text} %`;
}

const bits = new DataView(new ArrayBuffer(8));

/** The float64 that lies so many units in the last place above another. */
function ulpsAbove(value, ulps) {
  bits.setFloat64(0, value);
  bits.setBigInt64(0, BigInt.asIntN(64, bits.getBigInt64(0) + ulps));
  return bits.getFloat64(0);
}

const words = (name) => {
  const text = String(name).replaceAll("_", " ");
  return text.charAt(0).toUpperCase() + text.slice(1);
};
