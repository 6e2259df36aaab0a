"""`packages/verify/verify.py`: which surfaces the checker of certificates drops from a square."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import NamedTuple

import numpy as np
from reference_tracer_verify import verify

from .record import Inputs, Kept, Record, locals_of, named, numpy_with

_POINTS = dict(zip("abc", ((1.0, 2.0, -9.0), (3.0, 2.5, -8.0), (2.0, 4.0, -9.5)), strict=True))
_BOX = dict(middle=(0.25, 0.5, -1.0), half=(0.125, 0.25, 0.0))
_CAMERA = dict(eye=(0.0, 0.5, 1.0), back=(0.1, 0.2, 0.9), q=(1.0, 0.4, 0.0))
_SQUARE = dict(start=0.1, far=50.0, largest=1.5)


def _numbers(vectors: dict[str, tuple[float, ...]]) -> dict[str, float]:
    return {k + "xyz"[n]: v for k, each in vectors.items() for n, v in enumerate(each)}


def _vector(v: Inputs, name: str):
    return v.vector(" ".join(name + axis for axis in "xyz"))


class _Pair(tuple):
    """A square and a surface, of which nothing is picked."""

    def __getitem__(self, index):
        return self if isinstance(index, tuple) else super().__getitem__(index)


def _gone(v: Inputs, is_triangle: bool, is_parallel: bool):
    corners = v.stacked([_vector(v, k) for k in ("abc" if is_triangle else "abb")])
    camera = {k: _vector(v, k) for k in ("eye", "back")}
    triangles = v.columns if is_triangle else 0
    of = SimpleNamespace(corners=corners, triangles=triangles, aside=_vector(v, "q"), **camera)
    box = v.vector("middlex middley middlez halfx halfy halfz far").reshape(7, 1, -1)
    forms = verify.forms(of, is_parallel, v.shared_one("largest"))
    with locals_of(verify.candidates) as local:
        pair = _Pair((0 * v.rows, v.rows, v.rows))
        next(verify.candidates(forms, [box], v.shared_one("start"), pair))
    return local["gone"]


class _Ends(NamedTuple):
    """A ufunc with another `reduceat`."""

    ufunc: Callable
    reduceat: Callable

    def __call__(self, *some):
        return self.ufunc(*some)


def _box(v: Inputs) -> Kept:
    """Two pixels become a square; its ends are variables."""
    low, high = (_vector(v, k).reshape(3, 1, 1) for k in ("low", "high"))

    def ends(ufunc, end):
        far = v.one("far").reshape(1, 1)
        return _Ends(ufunc, lambda some, *_: end if some.ndim == 3 else far)

    two = v.stacked([low, high])[..., 0, 0].T.reshape(3, 1, 2)
    with numpy_with(verify, minimum=ends(np.minimum, low), maximum=ends(np.maximum, high)):
        _, square = verify.levels(two, np.zeros((1, 2)))
    return square.reshape(7, 1)[:6]


_CASES = [
    (f"gone_{shape}_{rays}", shape == "triangle", rays == "parallel")
    for shape in ("triangle", "plane")
    for rays in ("point", "parallel")
]
RECORDS = (
    *(
        Record(
            name,
            "verify.candidates",
            _numbers(_POINTS | _BOX | _CAMERA) | _SQUARE,
            lambda v, how=how: [_gone(v, *how)],
            {name: f"Dropping.{name.removeprefix('gone_')}_ruled_out"},
            name.removeprefix("gone_").replace("_", ", "),
        )
        for name, *how in _CASES
    ),
    Record(
        "square",
        "verify.levels",
        _numbers(dict(low=(0.0, 0.25, -1.0), high=(0.5, 0.75, -1.0))) | dict(far=50.0),
        _box,
        named("square", "middle_x middle_y middle_z half_x half_y half_z", "Box.code_covers"),
    ),
)
