"""Reads formulas as they are printed into trees, computes them, and prints them again.

A tree of a formula is data: with one sign, letter or order changed it is another formula.
"""

from __future__ import annotations

import operator
import re
from collections.abc import Mapping
from fractions import Fraction
from functools import cache
from typing import Any, NamedTuple

from ..projections.sine import sine
from ..tracer.vector import cross, dot

Value = Any  # a number or a vector of one arithmetic, or an array of such: (n,), (3, n)

_TOKEN = re.compile(r"‖n‖²|[A-Za-z]+[ₛ₁₂₃]*(?:_[a-z]+)?|\S")
PRODUCT = " "  # side by side
# How strongly each binds, and what it computes.
OPERATIONS = {
    "+": (1, operator.add),
    "−": (1, operator.sub),
    "·": (2, dot),
    "×": (2, cross),
    "/": (2, operator.truediv),
    PRODUCT: (3, operator.mul),
}
_SINES = {"sin": 0, "cos": 1}  # of an angle plus this number of right angles
_UNIT = 1 << 2048  # of sines in integers: the series' terms are below 2^1500 of it


class Letter(NamedTuple):
    """A number or a vector by its name."""

    name: str


class Negated(NamedTuple):
    """A tree with the other sign."""

    of: Tree


class Sine(NamedTuple):
    """A sine or a cosine."""

    name: str
    of: Tree


class Operation(NamedTuple):
    """Two operands, and the sign between them: one of `OPERATIONS`."""

    sign: str
    left: Tree
    right: Tree


Tree = Letter | Negated | Sine | Operation


@cache
def parse(text: str) -> Tree:
    """Return the tree of a formula."""
    return _parse([*reversed(_TOKEN.findall(text))])


def _parse(tokens: list[str], binding: int = 0) -> Tree:
    """Take tokens off the end of the list, as far as operators bind more strongly."""
    tree = _operand(tokens)
    while tokens and tokens[-1] != ")":
        sign = tokens[-1] if tokens[-1] in OPERATIONS else PRODUCT
        strength = OPERATIONS[sign][0]
        if strength <= binding:
            break
        if sign != PRODUCT:
            tokens.pop()
        tree = Operation(sign, tree, _parse(tokens, strength))
    return tree


def _operand(tokens: list[str]) -> Tree:
    token = tokens.pop()
    if token == "−":
        return Negated(_operand(tokens))
    if token in _SINES:
        return Sine(token, _operand(tokens))
    if token != "(":
        return Letter(token)
    tree = _parse(tokens)
    tokens.pop()  # the closing bracket
    return tree


def printed(tree: Tree, binding: int = 0) -> str:
    """Return a formula as text, with brackets where they are needed."""
    match tree:
        case Letter(name):
            return name
        case Negated(of):
            return f"−{printed(of, 9)}"
        case Sine(name, of):
            return f"{name} {printed(of, 9)}"
        case Operation(sign, left, right):
            strength = OPERATIONS[sign][0]
            between = sign if sign == PRODUCT else f" {sign} "
            # Factors of one strength are separated by brackets, as printed formulas have them.
            inner = 9 if strength == 2 else strength
            first = printed(left, inner if strength == 2 else strength - 1)
            text = f"{first}{between}{printed(right, inner)}"
            return text if strength > binding else f"({text})"


def evaluate(tree: Tree, names: Mapping[str, Value]) -> Value:
    """Return the number or vector that a formula gives; `names` has the value of each letter.

    Raises
    ------
    ZeroDivisionError
        If a fraction would be divided by 0; floats have inf or NaN for that.
    """
    match tree:
        case Letter(name):
            return names[name]
        case Negated(of):
            return -evaluate(of, names)
        case Sine(name, of):
            return _sine(evaluate(of, names), _SINES[name])
        case Operation(sign, left, right):
            return OPERATIONS[sign][1](evaluate(left, names), evaluate(right, names))


def _sine(angle: Value, quarters: int) -> Value:
    """Return a sine, or a cosine; the exact one of a fraction to far more digits than are shown."""
    if not isinstance(angle, Fraction):
        return sine(angle, quarters)
    size = abs(angle.numerator) * _UNIT // angle.denominator
    term = _UNIT if quarters else size
    sign = -1 if angle < 0 and not quarters else 1
    total = 0
    k = 2 - quarters
    while term:
        total += sign * term
        term = term * size * size // (_UNIT * _UNIT * k * (k + 1))
        sign = -sign
        k += 2
    return Fraction(total, _UNIT)
