"""The tables of numbers of a derivation's Markdown."""

from __future__ import annotations

import re
from decimal import Decimal
from fractions import Fraction

import numpy as np

KINDS = {"float32": np.float32, "float64": np.float64, "exact": None}


def tables(markdown):
    """Those of a text: a list of (heading, {type: {label: number}}, {label: (off32, off64)})."""
    found, heading = [], ""
    for block in markdown.split("\n\n"):
        if block.startswith("#"):
            heading = block.lstrip("# ")
        if "| float32 | off | float64 | off | exact |" in block:
            found.append((heading, *_numbers(block.splitlines()[2:])))
    return found


def _numbers(lines):
    columns, off = {kind: {} for kind in KINDS}, {}
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
