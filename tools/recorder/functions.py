"""numpy as the recorded modules see it: its own, but that some arrays are `Recorded`.

Arrays that a function makes to put results into (`np.empty`) are recorded, too.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from functools import partial
from typing import Any
from unittest import mock

import numpy as np
from numpy.typing import NDArray
from reference_tracer.tracer import vector

from .arrays import Choices, Recorded, apply, choices, holds, lift, paired, where
from .nodes import RefusedError, number, truth


def call(function: Callable, *args, **options) -> Any:
    """Call a function of numpy; what it does to recorded arrays must be listed below."""
    name = function.__name__
    if not (holds(args) or holds(tuple(options.values()))):
        return function(*args, **options)
    if name not in _OF_RECORDED:
        raise RefusedError(
            f"np.{name} of recorded numbers: proofs/floating_point/Trees.v has no word for it"
        )
    return _OF_RECORDED[name](*args, **options)


class Ufunc:
    """A ufunc that takes sequences of recorded arrays as arrays."""

    def __init__(self, ufunc: np.ufunc, method: str = "__call__") -> None:
        self._ufunc, self._method = ufunc, method

    def __call__(self, *inputs, **options):
        inputs = tuple(lift(v) if holds(v) else v for v in inputs)
        return getattr(self._ufunc, self._method)(*inputs, **options)

    def __getattr__(self, method: str):
        return Ufunc(self._ufunc, method)


class Numpy:
    """Stands in for the module numpy."""

    def __getattr__(self, name: str):
        real = getattr(np, name)
        if name in _MADE:
            return partial(_made, real)
        if isinstance(real, np.ufunc):
            return Ufunc(real)
        if name in _OF_RECORDED or (callable(real) and not isinstance(real, type)):
            return partial(call, real) if hasattr(real, "__name__") else real
        return real


_MADE = frozenset({"empty", "zeros", "ones", "full", "empty_like", "zeros_like", "ones_like"})


def _made(function: Callable, *args, **options) -> Recorded | NDArray:
    args = tuple(v.values if isinstance(v, Recorded) else v for v in args)
    values = function(*args, **options)
    if np.issubdtype(values.dtype, np.integer) and "empty" not in function.__name__:
        return values  # to count with; of integers, only what is computed last is recorded
    if "empty" in function.__name__:  # what is read before it is written shows
        values.fill(False if values.dtype == bool else 0)
    leaf = truth if values.dtype == bool else number
    nodes = np.empty(values.shape, object)
    for place, value in np.ndenumerate(values):
        nodes[place] = None if "empty" in function.__name__ else leaf(value.item())
    return Recorded(values, nodes)


def _joined(function: Callable) -> Callable[..., Recorded]:
    """Of shapes alone: the same for values and nodes."""

    def join(arrays, *args, **options) -> Recorded:
        parts = [lift(v) for v in arrays]
        values, nodes = ([getattr(p, kind) for p in parts] for kind in ("values", "nodes"))
        return paired(function(values, *args, **options), function(nodes, *args, **options))

    return join


def _array(value, dtype=np.float64) -> Recorded:
    return lift(value).astype(dtype) if np.dtype(dtype) != bool else lift(value)


def _values(*args):
    return (v.values if isinstance(v, Recorded) else v for v in args)


_RECORDED = "reference_tracer.", "reference_tracer_verify."  # whose modules record
_OF_RECORDED: dict[str, Callable] = {
    "array": _array,
    "asarray": _array,
    "broadcast": lambda *some: np.broadcast(*_values(*some)),
    "broadcast_arrays": lambda *some: [
        call(np.broadcast_to, v, np.broadcast_shapes(*(each.shape for each in some))) for v in some
    ],
    "broadcast_to": lambda some, shape: some._each(lambda v: np.broadcast_to(v, shape)),
    "clip": lambda some, low, high, out=None: apply(
        np.minimum,
        "__call__",
        (apply(np.maximum, "__call__", (some, low), (), {}), high),
        () if out is None else (out,),
        {},
    ),
    "concatenate": _joined(np.concatenate),
    "flatnonzero": lambda some: some.ravel().nonzero()[0],
    "hstack": _joined(np.hstack),
    "roll": lambda some, by, axis: some._each(lambda v: np.roll(v, by, axis)),
    "result_type": lambda *some: np.result_type(*_values(*some)),
    "stack": _joined(np.stack),
    "vstack": _joined(np.vstack),
    "where": where,
}


@contextmanager
def recording() -> Iterator[Choices]:
    """Let the tracer's modules record; yields what they decide by tests of what is recorded."""
    proxy, made = Numpy(), []
    with ExitStack() as stack:
        for name, module in list(sys.modules.items()):
            if name.startswith(_RECORDED) and getattr(module, "np", None) is np:
                stack.enter_context(mock.patch.object(module, "np", proxy))
        stack.enter_context(mock.patch.object(vector, "_TAKE_IS_FAST", True))  # either way the same
        choices.append(made)
        try:
            yield made
        finally:
            choices.pop()
