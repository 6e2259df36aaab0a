"""How floats become integers, and integers floats; in the tracer, and in certificates' checker.

numpy's `frexp` is trusted: of a float that is not zero it returns a mantissa and an exponent, which
the proofs have by these names. The floats that a function is given are numbers, by which each is
known; a record asks beforehand which of them are zero.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import ModuleType, SimpleNamespace
from unittest import mock

import numpy as np
from reference_tracer.certified import exact, integers, order
from reference_tracer.certified.exact import IntegerBatch
from reference_tracer.tracer.camera import Rays
from reference_tracer_verify import verify

from ..nodes import RefusedError, number
from ..whole import Asked, Whole, folded, least, listed, most, term, triple, whole
from .integers import WholeRecord, Z, batch
from .record import numpy_with

_R = "({} : R)"
_VECTORS = "o1 o2 d a1 a2 b1 b2 c1 c2 p n"


class _Mantissa:
    """A mantissa, or a multiple of it: a Coq term of type R, which is not zero."""

    __hash__ = None

    def __init__(self, term: str) -> None:
        self.term = term

    def __eq__(self, other: object) -> bool:
        if other != 0:
            raise RefusedError("a mantissa is compared with another number than 0")
        return False

    def __mul__(self, by: float) -> _Mantissa:
        m, e = number(by).args
        return _Mantissa(f"(rnd ({self.term} * (IZR {m} * bpow radix2 {e}))%R)")


class _Objects(np.ndarray):
    """An array of such, and of integers."""

    def astype(self, dtype) -> _Objects:
        if dtype != np.int64:
            raise RefusedError(f"a mantissa is made {dtype}")
        return _each(lambda v: Whole(f"(Ztrunc {v.term})") if isinstance(v, _Mantissa) else 0, self)

    def min(self, initial: int | None = None) -> Whole:
        return folded(least)([*self.flat] if initial is None else [initial, *self.flat])


def _each(make: Callable, *values) -> _Objects:
    return np.frompyfunc(make, len(values), 1)(*values).view(_Objects)


@contextmanager
def _floats(module: ModuleType, names: str) -> Iterator[list[float]]:
    """Let a module compute with the floats of these names; yields what they are known by."""
    known = dict(zip(np.sqrt([2, 3, 5]).tolist(), names.split(), strict=False))
    given = [0.0 if Asked(f"(Req_bool {name} 0)") else k for k, name in known.items()]

    def frexp(values) -> tuple[_Objects, _Objects]:
        return (
            _each(lambda v: _Mantissa(f"(mantissa {known[v]})") if v else 0, values),
            _each(lambda v: Whole(f"(exponent {known[v]})") if v else 0, values),
        )

    with (
        numpy_with(module, frexp=frexp, maximum=lambda *both: _each(most, *both)),
        mock.patch.object(module, "int", lambda v: v, create=True),
    ):
        yield given


def _integers(names: str, vectors: int) -> str:
    with _floats(integers, names) as given:
        values = np.zeros((3, vectors))
        values.T.flat[:: 3 if vectors > 1 else 1] = given
        found, unit = integers.integers(values)
    return f"([{'; '.join(map(triple, found))}], {term(unit)})"


class _Limit:
    """A clip limit: a Coq term of type R."""

    __hash__ = None

    def __init__(self, term: str) -> None:
        self.term = term

    def __eq__(self, zero: object) -> Asked:  # type: ignore[override]
        if zero != 0:
            raise RefusedError(f"a clip limit is compared with {zero}")
        return Asked(f"(Req_bool {self.term} 0)")


def _batch() -> str:
    """Of two origins, a direction, two triangles, a plane: each is known by a number.

    A power of two has the names of all that share it.
    """
    names = dict(enumerate(_VECTORS.split()))

    def converted(vectors) -> tuple[list[str], Whole]:
        found = [names[int(k)] for k in vectors[0]]
        return found, Whole("_".join(("unit", *found)))

    def vectors(*wanted: str):
        return np.array([[list(names.values()).index(name) for name in wanted]] * 3, float)

    rays = Rays(vectors("o1", "o2"), vectors("d"))
    corners = np.stack([vectors(f"{k}1", f"{k}2") for k in "abc"])
    planes = [(vectors("p")[:, 0], vectors("n")[:, 0])]
    with (
        mock.patch.object(exact, "integers", converted),
        mock.patch.object(IntegerBatch, "_limit", lambda _, limit: limit.term),
    ):
        own = IntegerBatch(rays, corners, planes, _Limit("start"), _Limit("end_"))
    parts = (
        *map(listed, (own.origins, own.directions, *own.corners)),
        *own.planes[0],
        term(own.unit),
        term(own._shift),
        own._start,
        own._end,
        own._open.term,
    )
    return f"({', '.join(parts)})"


def _limit() -> str:
    """`as_integer_ratio` returns m / p."""
    value = SimpleNamespace(as_integer_ratio=lambda: whole("m p"))
    with numpy_with(exact, isinf=lambda _: Asked("infinite")):
        limit = batch(_shift=Whole("shift"))._limit(value)
    return "None" if limit is None else f"(Some ({', '.join(map(term, limit))}))"


def _scaled() -> str:
    def to_float(value: Whole) -> Whole:
        return Whole(f"(to_float {term(value)})")

    with mock.patch.object(order, "float", to_float, create=True):
        return term(order._scaled(Whole("value"), Whole("shift")))


def _checkers() -> str:
    with _floats(verify, "x y z") as given:
        [found] = verify.integers(np.array([given]).T, Whole("unit"))
    return triple(found)


def _checkers_unit() -> str:
    """One of the numbers is of a corner, one of an origin, one of a direction."""
    with _floats(verify, "x y z") as given:
        corner, origin, direction = (np.array([[0.0], [0.0], [value]]) for value in given)
        of = SimpleNamespace(corners=corner[..., None], clip=())
        with mock.patch.object(verify, "integers"):
            return term(verify.Exact(of, origin, direction).unit)


CONVERSIONS = (
    WholeRecord(
        "whole_integers",
        "integers.integers",
        _R.format("x y z"),
        "list Integers * Z",
        lambda: _integers("x y z", 1),
        "ConversionsCode.integers_is",
        "of one vector",
    ),
    WholeRecord(
        "whole_integers_of_two",
        "integers.integers",
        _R.format("x y"),
        "list Integers * Z",
        lambda: _integers("x y", 2),
        "ConversionsCode.integers_of_two_is",
        "of two vectors along the first axis",
    ),
    WholeRecord(
        "whole_batch",
        "exact.IntegerBatch.__init__",
        f"({_VECTORS} : Integers) (unit_o1_o2_a1_a2_b1_b2_c1_c2_p unit_d : Z) (start end_ : R)",
        "list Integers * list Integers * list Integers * list Integers * list Integers * Integers "
        "* Integers * Z * Z * R * R * bool",
        _batch,
        "ConversionsCode.batch_is",
        "of two rays, two triangles and a plane: what shares a power of two",
    ),
    WholeRecord(
        "whole_limit",
        "exact.IntegerBatch._limit",
        f"(infinite : bool) {Z.format('m p shift')}",
        "option (Z * Z)",
        _limit,
        "ConversionsCode.limit_is",
    ),
    WholeRecord(
        "whole_scaled",
        "order._scaled",
        f"(division : Z -> Z -> option R) (to_float : Z -> option R) {Z.format('value shift')}",
        "option R",
        _scaled,
        "ConversionsCode.scaled_is",
    ),
    WholeRecord(
        "check_integers",
        "verify.integers",
        f"{_R.format('x y z')} {Z.format('unit')}",
        "Integers",
        _checkers,
        "ConversionsCode.check_integers_is",
        "of one vector",
    ),
    WholeRecord(
        "check_unit",
        "verify.Exact.__init__",
        _R.format("x y z"),
        "Z",
        _checkers_unit,
        "ConversionsCode.check_unit_is",
        "the power of two of three numbers",
    ),
)
HEAD = """\
(** Generated by `tools/record_trees.py`: do not edit. How to read it: README.md beside it. *)
Require Import ZArith Reals List Bool.
From Flocq Require Import Core.
From Reftrace Require Import Trees Integers CodeAnswers.
Import ListNotations.
Open Scope Z_scope.

(** What numpy's [frexp] returns of a float. *)
Definition mantissa (x : R) : R := (x * bpow radix2 (- exponent x))%R.
"""
