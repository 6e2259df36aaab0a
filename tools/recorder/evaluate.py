"""Recorded expressions, computed again by numpy: to hold them against the functions themselves."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from .nodes import Node, in_order


def _keep(n: int, x: NDArray[np.float64]) -> NDArray[np.float64]:
    return (x.view(np.int64) & np.int64(-1 << (53 - n))).view(np.float64)


_COMPUTED: dict[str, Callable] = {
    "Add": np.add,
    "Sub": np.subtract,
    "Mul": np.multiply,
    "Div": np.divide,
    "Abs": np.abs,
    "Neg": np.negative,
    "Max": np.maximum,
    "Min": np.minimum,
    "Next": lambda x: np.nextafter(x, np.inf),
    "Prev": lambda x: np.nextafter(x, -np.inf),
    "Floor": np.floor,
    "Ceil": np.ceil,
    "CopySign": np.copysign,
    "Keep": _keep,
    "Where": np.where,
    "Less": np.less,
    "LessEq": np.less_equal,
    "Same": np.equal,
    "And": np.logical_and,
    "Or": np.logical_or,
    "Not": np.logical_not,
    "Finite": np.isfinite,
}


def evaluate(roots: Sequence[Node], values: Mapping[str, NDArray]) -> list[NDArray]:
    """Return what expressions are worth for n values of each variable, (n,) each."""
    count = len(next(iter(values.values())))
    known: dict[Node, NDArray] = {}
    with np.errstate(all="ignore"):
        for node in in_order(roots):
            if node.kind in ("Var", "Given"):
                known[node] = values[node.args[0]]
            elif node.kind == "Num":
                m, e = node.args
                known[node] = np.full(count, m * 2**e if e >= 0 else m / 2**-e)
            elif node.kind == "Inf":
                known[node] = np.full(count, np.inf)
            else:
                args = (known[a] if isinstance(a, Node) else a for a in node.args)
                known[node] = _COMPUTED[node.kind](*args)
    return [known[root] for root in roots]
