"""Arrays that remember how each of their numbers was computed.

Beside the values, computed by numpy itself, a `Recorded` array holds the expression of every
element. It isn't an ndarray: what is not written here cannot be done with it, so nothing that is
computed goes past the recorder. What the language of `proofs/floating_point/Trees.v` has no word
for, above all sums in an order of numpy's choosing, is refused.

Which elements a function picks by a test (flatnonzero, `if`) is taken from the values. What was
asked, and the answer, are `choices` of the recording: the expressions hold on that path.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import reduce
from typing import Any

import numpy as np
from numpy.lib.mixins import NDArrayOperatorsMixin
from numpy.typing import NDArray

from .nodes import Node, RefusedError, node, number, truth
from .operations import LOGIC, NUMBERS, REDUCED, refused, select

Choices = list[tuple[Node, bool]]
choices: list[Choices] = []  # of the recordings that are on


def choose(test: Node, value: bool) -> bool:
    """Note that a path was taken by a test."""
    if choices:
        choices[-1].append((test, bool(value)))
    return bool(value)


class Recorded(NDArrayOperatorsMixin):
    """Values with a node each, of the same shape; slices are views, as numpy's are."""

    __hash__ = None

    def __init__(self, values: NDArray, nodes: NDArray[np.object_]) -> None:
        self.values, self.nodes = values, nodes

    dtype = property(lambda self: self.values.dtype)
    shape = property(lambda self: self.values.shape)
    ndim = property(lambda self: self.values.ndim)
    size = property(lambda self: self.values.size)
    T = property(lambda self: self.transpose())

    def __array__(self, *_, **__):
        raise RefusedError("a recorded array would lose its expressions: numpy wants a plain one")

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs, out=(), **options):
        return apply(ufunc, method, inputs, out, options)

    def __array_function__(self, function, types, args, options):
        from .functions import call

        return call(function, *args, **options)

    def _each(self, change: Callable[[NDArray], Any]) -> Recorded:
        return paired(change(self.values), change(self.nodes))

    def __len__(self) -> int:
        return len(self.values)

    def __iter__(self) -> Iterator[Recorded]:
        return (self[k] for k in range(len(self)))

    def __getitem__(self, index) -> Recorded:
        index = _chosen(index)
        return self._each(lambda v: v[index])

    def __setitem__(self, index, value) -> None:
        parts = index if isinstance(index, tuple) else (index,)
        if isinstance(parts[-1], Recorded):  # a mask: where it holds, the value; else as it was
            mask, target = parts[-1], self[(*parts[:-1], slice(None))]
            value = lift(value)
            if value.size != 1:  # as many as there are places: those of the path that is taken
                self[(*parts[:-1], mask.nonzero()[0])] = value
                return
            old = paired(target.values.copy(), target.nodes.copy())
            target[...] = where(mask, value, old)
            return
        value = lift(value)
        if (self.dtype == bool) != (value.dtype == bool):
            raise RefusedError("a test is assigned to an array of numbers, or a number to tests")
        if np.issubdtype(self.dtype, np.integer):
            _integral(value.values)
        self.values[index] = value.values
        self.nodes[index] = value.nodes[()]  # an array of no axes is its one node

    def __bool__(self) -> bool:
        if self.size != 1 or self.dtype != bool:
            raise RefusedError("only one test can decide which way a function goes")
        return choose(self.nodes.reshape(-1)[0], self.values.reshape(-1)[0])

    def __matmul__(self, other):
        raise refused("@")

    __rmatmul__ = __imatmul__ = __matmul__

    def transpose(self, *axes) -> Recorded:
        return self._each(lambda v: v.transpose(*axes))

    def swapaxes(self, one: int, other: int) -> Recorded:
        return self._each(lambda v: v.swapaxes(one, other))

    def reshape(self, *shape) -> Recorded:
        return self._each(lambda v: v.reshape(*shape))

    def ravel(self) -> Recorded:
        return self._each(lambda v: v.ravel())

    def copy(self) -> Recorded:
        return self._each(lambda v: v.copy())

    def take(self, index, axis=None) -> Recorded:
        return self._each(lambda v: v.take(index, axis=axis))

    def max(self, axis=None, keepdims=False) -> Recorded:
        return apply(np.maximum, "reduce", (self,), (), {"axis": axis, "keepdims": keepdims})

    def min(self, axis=None, keepdims=False) -> Recorded:
        return apply(np.minimum, "reduce", (self,), (), {"axis": axis, "keepdims": keepdims})

    def any(self, axis=None) -> Recorded:
        return apply(np.logical_or, "reduce", (_tests(self),), (), {"axis": axis})

    def all(self, axis=None) -> Recorded:
        return apply(np.logical_and, "reduce", (_tests(self),), (), {"axis": axis})

    def nonzero(self) -> tuple[NDArray[np.intp], ...]:
        """Which tests hold, by the values: each is a choice."""
        if self.dtype != bool:
            raise RefusedError("only of tests can be asked which hold")
        for test, value in zip(self.nodes.ravel(), self.values.ravel(), strict=True):
            choose(test, value)
        return self.values.nonzero()

    def astype(self, dtype) -> Recorded:
        dtype = np.dtype(dtype)
        if dtype == self.dtype:
            return self.copy()
        if dtype == np.float64 or (np.issubdtype(dtype, np.integer) and self.dtype != bool):
            _integral(self.values)
            return Recorded(self.values.astype(dtype), self.nodes.copy())
        raise RefusedError(f"{self.dtype} is made {dtype}, which rounds once more")

    def view(self, dtype) -> Bits:
        if np.dtype(dtype) != np.int64 or self.dtype != np.float64:
            raise RefusedError(f"the bits of {self.dtype} are seen as {np.dtype(dtype)}")
        return Bits(self)

    def __getattr__(self, name: str):
        if name.startswith("_"):
            raise AttributeError(name)
        raise refused(f".{name}")


class Bits:
    """The bits of recorded floats, some of which may be masked away."""

    def __init__(self, floats: Recorded) -> None:
        self._floats = floats

    def __and__(self, mask: np.int64) -> Bits:
        kept = {-1 << (53 - n): (lambda x, n=n: node("Keep", n, x)) for n in range(1, 53)}
        kept[0x7FF << 52] = lambda x: node("Keep", 1, node("Abs", x))
        if int(mask) not in kept:
            raise RefusedError(f"the mask {int(mask):#x} keeps neither high digits nor exponents")
        values = (self._floats.values.view(np.int64) & mask).view(np.float64)
        return Bits(Recorded(values, _each(kept[int(mask)], self._floats.nodes)))

    def view(self, dtype) -> Recorded:
        if np.dtype(dtype) != np.float64:
            raise RefusedError(f"bits are seen as {np.dtype(dtype)}")
        return self._floats


def paired(values, nodes) -> Recorded:
    """Return values and nodes, arrays or single ones, as an array."""
    if not isinstance(nodes, np.ndarray):
        single, nodes = nodes, np.empty((), object)
        nodes[()] = single
    return Recorded(np.asarray(values), nodes)


def variable(name: str, value: float | bool) -> Recorded:
    """Return a number, or what is true or false, of the input, as an array of one."""
    leaf = node("Given" if isinstance(value, bool) else "Var", name)
    values = np.array([value])
    return Recorded(values, _each(lambda _: leaf, values))


def lift(value) -> Recorded:
    """Return what is not recorded as constants."""
    if isinstance(value, Recorded):
        return value
    if isinstance(value, list | tuple) and holds(value):
        parts = [lift(v) for v in value]
        shape = np.broadcast_shapes(*(p.shape for p in parts))
        if any(p.shape != shape for p in parts):
            raise RefusedError("arrays of different shapes are put together")
        return paired(np.stack([p.values for p in parts]), np.stack([p.nodes for p in parts]))
    values = np.asarray(value)
    if values.dtype == np.float32 or values.dtype.kind not in "fiub":
        raise RefusedError(f"numbers of {values.dtype} are used with recorded ones")
    leaf = truth if values.dtype == bool else number
    return Recorded(values, _each(lambda v: leaf(v.item() if hasattr(v, "item") else v), values))


def holds(value) -> bool:
    """Return whether something is recorded, or a sequence with something that is."""
    if isinstance(value, list | tuple):
        return any(map(holds, value))
    return isinstance(value, Recorded)


def where(test, yes, no) -> Recorded:
    """Return `np.where`; a test that is not recorded is known beforehand."""
    if not isinstance(test, Recorded):
        yes, no = lift(yes), lift(no)
        test = np.asarray(test)
        return paired(np.where(test, yes.values, no.values), np.where(test, yes.nodes, no.nodes))
    yes, no = lift(yes), lift(no)
    nodes = _each(select, test.nodes, yes.nodes, no.nodes)
    return paired(np.where(test.values, yes.values, no.values), nodes)


def most(*values):
    """Return what Python's `max` returns."""
    some = [lift(v) for v in values]
    return reduce(lambda a, b: apply(np.maximum, "__call__", (a, b), (), {}), some)


def apply(ufunc: np.ufunc, method: str, inputs, out, options: dict) -> Recorded:
    """Compute a ufunc of recorded and plain arrays, and record it."""
    if method == "reduce" and ufunc.__name__ in REDUCED:
        return _reduced(ufunc, *inputs, out=out, **options)
    name = ufunc.__name__
    if method == "at" and name in REDUCED:
        target, index, some = inputs
        for place, value in zip(index, lift(some), strict=True):
            target[place] = apply(ufunc, "__call__", (target[place], value), (), {})
        return target
    if method != "__call__" or (name not in NUMBERS and name not in LOGIC):
        raise refused(name if method == "__call__" else f"{name}.{method}")
    if options:
        raise RefusedError(f"{name} is given {', '.join(options)}")
    lifted = [lift(v) for v in inputs]
    if any((v.dtype == bool) != (name in LOGIC) for v in lifted):
        raise RefusedError(f"{name} mixes numbers and tests")
    # Integers, which are pixels, are computed exactly, and so are floats of their size.
    nodes = _each((NUMBERS | LOGIC)[name], *(v.nodes for v in lifted))
    result = paired(ufunc(*(v.values for v in lifted)), nodes)
    target = out[0] if isinstance(out, tuple) and out else None
    if target is None:
        return result
    if not isinstance(target, Recorded):
        raise RefusedError(f"the result of {name} is put into an array that is not recorded")
    target[...] = result
    return target


def _reduced(ufunc: np.ufunc, some: Recorded, axis=0, keepdims=False, out=(), **options):
    if out not in ((), None, (None,)) or {k for k, v in options.items() if v is not None}:
        raise RefusedError(f"{ufunc.__name__}.reduce is given {', '.join(options) or 'out'}")
    if axis is None:
        shape = (1,) * some.ndim
        some, axis = some.ravel(), 0
        result = _reduced(ufunc, some)
        return result.reshape(shape) if keepdims else result
    if isinstance(axis, tuple):
        raise RefusedError("more than one axis is reduced at once")
    first, *rest = (
        some[(slice(None),) * (axis % some.ndim) + (k,)] for k in range(some.shape[axis])
    )
    for other in rest:
        first = apply(ufunc, "__call__", (first, other), (), {})
    return first._each(lambda v: np.expand_dims(v, axis)) if keepdims else first


def _tests(some: Recorded) -> Recorded:
    return some if some.dtype == bool else some != 0


def _each(make: Callable[..., Node], *arrays: NDArray) -> Any:
    out = np.frompyfunc(make, len(arrays), 1)(*arrays)
    return out if isinstance(out, np.ndarray) else paired(0.0, out).nodes


def _chosen(index):
    if isinstance(index, tuple):
        return tuple(map(_chosen, index))
    return index.nonzero()[0] if isinstance(index, Recorded) else index


def _integral(values: NDArray) -> None:
    if not np.array_equal(values, np.floor(values)) or (np.abs(values) > 2**53).any():
        raise RefusedError("numbers that are not whole are made integers")
