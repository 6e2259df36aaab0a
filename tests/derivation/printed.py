"""The steps once more, by themselves, from nothing but printed numbers.

Written apart from the add-on: a dict of labels as printed, to numbers of one type, in; the same
labels to what their formulas make of the numbers before them, out.
"""

from __future__ import annotations

import re
from decimal import Decimal
from fractions import Fraction

import numpy as np

AXES = "xyz"


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return [a[k - 2] * b[k - 1] - a[k - 1] * b[k - 2] for k in range(3)]


def minus(a, b):
    return [x - y for x, y in zip(a, b, strict=True)]


class Printed(dict):
    """Labels as printed to numbers of one type."""

    def vector(self, name):
        return [self[f"{name}.{k}"] for k in AXES]


def along(p, o, d):
    return [o[k] + p["t"] * d[k] for k in range(3)]


def camera(p, columns, rows, column, row, orthographic):
    """What follows from the numbers of the camera's table; w and h from float64's."""
    number = type(p["u_min"])
    right, up, forward, e = (p.vector(n) for n in ("right", "up", "forward", "e"))
    aside = [p["u"] * right[k] + p["v"] * up[k] for k in range(3)]
    turned = aside if orthographic else [aside[k] + forward[k] for k in range(3)]
    return {
        "w": (p["u_max"] - p["u_min"]) / number(columns),
        "h": (p["v_max"] - p["v_min"]) / number(rows),
        "X": number(column) + number(1) / number(2),
        "Y": number(row) + number(1) / number(2),
        "u": p["u_min"] + p["X"] * p["w"],
        "v": p["v_min"] + p["Y"] * p["h"],
        "o": [e[k] + aside[k] for k in range(3)] if orthographic else e,
        "d": forward if orthographic else turned,
    }


def triangle(p, ray):
    """What follows from the ray's table and a triangle's."""
    o, d = ray.vector("o"), ray.vector("d")
    p1, p2, p3, n = (p.vector(name) for name in ("p₁", "p₂", "p₃", "n"))
    out = {
        "n": cross(minus(p3, p1), minus(p2, p1)),
        "(o − p₁) · n": dot(minus(o, p1), n),
        "d · n": dot(d, n),
    }
    if "t" not in p:
        return out
    x = p.vector("x")
    return out | {
        "t": -p["(o − p₁) · n"] / p["d · n"],
        "x": along(p, o, d),
        "nₛ₁": cross(minus(p2, p3), minus(x, p3)),
        "nₛ₂": cross(minus(p1, p2), minus(x, p2)),
        "nₛ₃": cross(minus(p3, p1), minus(x, p1)),
        "‖n‖²": dot(n, n),
        "s₁": dot(n, p.vector("nₛ₁")) / p["‖n‖²"],
        "s₂": dot(n, p.vector("nₛ₃")) / p["‖n‖²"],
        "s₃": dot(n, p.vector("nₛ₂")) / p["‖n‖²"],
        "s₁ + s₂ + s₃": p["s₁"] + p["s₂"] + p["s₃"],
    }


def plane(p, ray):
    """What follows from the ray's table and a plane's."""
    o, d, n = ray.vector("o"), ray.vector("d"), p.vector("n")
    out = {"(o − p) · n": dot(minus(o, p.vector("p")), n), "d · n": dot(d, n)}
    if "t" not in p:
        return out
    return out | {"t": -p["(o − p) · n"] / p["d · n"], "x": along(p, o, d)}


def color(p, weights):
    c = [p.vector(name) for name in ("c₁", "c₂", "c₃")]
    s = [weights[name] for name in ("s₁", "s₂", "s₃")]
    return {"c": [s[0] * c[0][k] + s[1] * c[1][k] + s[2] * c[2][k] for k in range(3)]}


def flat(made):
    """The same with a label for each component."""
    out = {}
    for name, value in made.items():
        if isinstance(value, list):
            out |= {f"{name}.{k}": v for k, v in zip(AXES, value, strict=True)}
        else:
            out[name] = value
    return out


# Markdown

KINDS = {"float32": np.float32, "float64": np.float64, "exact": None}


def tables(markdown):
    """The tables of numbers: a list of (heading, {type: Printed}, {label: (off32, off64)})."""
    found, heading = [], ""
    for block in markdown.split("\n\n"):
        if block.startswith("#"):
            heading = block.lstrip("# ")
        if "| float32 | off | float64 | off | exact |" in block:
            found.append((heading, *_numbers(block.splitlines()[2:])))
    return found


def _numbers(lines):
    columns, off = {kind: Printed() for kind in KINDS}, {}
    for line in lines:
        _, label, f32, off32, f64, off64, exact = (c.strip() for c in line.strip("|").split(" | "))
        columns["float32"][label] = np.float32(float(f32.replace("**", "")))
        columns["float64"][label] = np.float64(f64.replace("**", ""))
        if exact != "undefined":
            columns["exact"][label] = exact
        off[label] = off32, off64
    return columns, off


def as_fraction(text):
    return Fraction(Decimal(re.sub("…", "", text)))
