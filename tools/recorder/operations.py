"""The node of each of numpy's operations; and the words in which others are refused."""

from __future__ import annotations

from collections.abc import Callable

from .nodes import Node, RefusedError, node, number


def select(test: Node, yes: Node, no: Node) -> Node:
    if yes.is_test:
        return node("Or", node("And", test, yes), node("And", node("Not", test), no))
    return node("Where", test, yes, no)


def _sign(x: Node) -> Node:
    """Of NaN, numpy's is NaN and this is 0: nothing asks for it."""
    zero = number(0)
    below = node("Where", node("Less", x, zero), number(-1), zero)
    return node("Where", node("Less", zero, x), number(1), below)


def _nextafter(x: Node, towards: Node) -> Node:
    inf = node("Inf")
    kinds = {inf: "Next", node("Neg", inf): "Prev"}
    if towards not in kinds:
        raise RefusedError("nextafter goes towards neither inf nor -inf")
    return node(kinds[towards], x)


def _made(kind: str) -> Callable[..., Node]:
    return lambda *args: node(kind, *args)


NUMBERS: dict[str, Callable[..., Node]] = {
    "add": _made("Add"),
    "subtract": _made("Sub"),
    "multiply": _made("Mul"),
    "divide": _made("Div"),
    "absolute": _made("Abs"),
    "negative": _made("Neg"),
    "maximum": _made("Max"),
    "minimum": _made("Min"),
    "floor": _made("Floor"),
    "ceil": _made("Ceil"),
    "copysign": _made("CopySign"),
    "sign": _sign,
    "nextafter": _nextafter,
    "less": _made("Less"),
    "less_equal": _made("LessEq"),
    "greater": lambda a, b: node("Less", b, a),
    "greater_equal": lambda a, b: node("LessEq", b, a),
    "equal": _made("Same"),
    "not_equal": lambda a, b: node("Not", node("Same", a, b)),
    "isfinite": _made("Finite"),
    "isnan": lambda a: node("Not", node("Same", a, a)),
}
LOGIC: dict[str, Callable[..., Node]] = {
    "bitwise_and": _made("And"),
    "logical_and": _made("And"),
    "bitwise_or": _made("Or"),
    "logical_or": _made("Or"),
    "invert": _made("Not"),
    "logical_not": _made("Not"),
}
# In any order the same but for the sign of zero, so that numpy may choose it.
REDUCED = frozenset({"maximum", "minimum", "logical_and", "logical_or"})


def refused(name: str) -> RefusedError:
    why = {
        "@": "numpy chooses the order of its sums, and may use fused operations",
        "matmul": "numpy chooses the order of its sums, and may use fused operations",
        "add.reduce": "numpy chooses the order of a sum: write it with +",
        ".sum": "numpy chooses the order of a sum: write it with +",
        ".mean": "numpy chooses the order of a sum: write it with +",
        ".dot": "numpy chooses the order of its sums, and may use fused operations",
    }.get(name, "proofs/floating_point/Trees.v has no word for it")
    return RefusedError(f"{name} of recorded numbers: {why}")
