"""Nodes of recorded expressions: those of `proofs/floating_point/Trees.v`, by the same names.

Equal nodes are one object, so that what is used twice is seen to be.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

TESTS = frozenset({"Less", "LessEq", "Same", "And", "Or", "Not", "Finite", "Given"})


@dataclass(frozen=True, eq=False, slots=True)
class Node:
    """An expression, or a test: `args` are nodes, or a leaf's name or numbers."""

    kind: str
    args: tuple

    @property
    def is_test(self) -> bool:
        return self.kind in TESTS

    @property
    def children(self) -> tuple[Node, ...]:
        return tuple(a for a in self.args if isinstance(a, Node))

    def __repr__(self) -> str:
        return words(self)


class RefusedError(TypeError):
    """Something was computed that `proofs/floating_point/Trees.v` has no word for."""


_known: dict[tuple, Node] = {}


def node(kind: str, *args: Node | str | int) -> Node:
    if None in args:
        raise RefusedError("a number is read before it was written")
    key = kind, *args
    if key not in _known:
        _known[key] = Node(kind, args)
    return _known[key]


def number(value: float | int) -> Node:
    """Return a constant as m 2^e, exactly, with an odd m."""
    if isinstance(value, int) and float(value) != value:
        raise RefusedError(f"the integer {value} is not a float64")
    value = float(value)
    if math.isnan(value):
        return node("Sub", node("Inf"), node("Inf"))
    if math.copysign(1.0, value) < 0 and (math.isinf(value) or value == 0):
        return node("Neg", number(-value))
    if math.isinf(value):
        return node("Inf")
    m, power = value.as_integer_ratio()
    e = 1 - power.bit_length()
    while m and m % 2 == 0:
        m, e = m // 2, e + 1
    return node("Num", m, e if m else 0)


TRUE = node("Same", number(0), number(0))
FALSE = node("Not", TRUE)


def truth(value: bool) -> Node:
    return TRUE if value else FALSE


def every(tests: Iterable[Node]) -> Node:
    """Return the test that all of some hold, at least one."""
    first, *rest = tests
    for test in rest:
        first = node("And", first, test)
    return first


def in_order(roots: Iterable[Node]) -> Iterator[Node]:
    """Yield all nodes below, each once, what a node is made of before it."""
    done: set[Node] = set()
    stack = [(root, False) for root in reversed(list(roots))]
    while stack:
        top, is_open = stack.pop()
        if top in done:
            continue
        if is_open:
            done.add(top)
            yield top
        else:
            stack.append((top, True))
            stack += [(child, False) for child in reversed(top.children)]


_SIGNS = {"Add": "+", "Sub": "-", "Mul": "*", "Div": "/", "Less": "<", "LessEq": "<=", "Same": "="}
_SIGNS |= {"And": "and", "Or": "or"}


def words(of: Node, depth: int = 6) -> str:
    """Return an expression as a formula that a person can read; what is deep is left out."""
    if of.kind in ("Var", "Given"):
        return of.args[0]
    if of.kind == "Inf":
        return "inf"
    if of.kind == "Num":
        m, e = of.args
        return f"{m * 2**e}" if 0 <= e < 20 else f"{'' if m == 1 else f'{m} '}2^{e}"
    if not depth:
        return "..."
    inner = [words(a, depth - 1) if isinstance(a, Node) else str(a) for a in of.args]
    if of.kind in _SIGNS:
        return f"({inner[0]} {_SIGNS[of.kind]} {inner[1]})"
    return f"{of.kind.lower()}({', '.join(inner)})"
