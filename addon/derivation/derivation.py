"""Derives one pixel step by step: camera, ray, candidates, the nearest, its colour, its certainty.

Every number is computed in float32, in float64 and exactly, side by side. The files beside
this one turn a `Derivation` into Markdown, JSON and what a page shows.

The camera's steps are exact for the numbers of the camera as float64 stores them. From the ray on,
the steps are exact for that ray and the corners in world space as float64 has them: *these* are the
scene, as they are for the certified tracer, and no rounding follows.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np

from ..scene import Scene
from ..tracer.ties import Name
from . import textbook
from .candidates import LIMIT, gather_pixel
from .formulas import CAMERA, COLOR, PLANE, STORED, TRIANGLE, Formula, ray_formulas
from .pixel import Answer, Candidate, Pixel, answer, plain_answers
from .textbook import Arithmetic, Judgement, Labelled, Number

Columns = dict[Arithmetic, Labelled]


@dataclass(frozen=True, eq=False)
class Quantity:
    """A number, or a vector of three, in every arithmetic.

    `values` has 1 or 3 numbers for each; none are exact where one would divide by 0.
    """

    key: str
    formula: Formula
    values: Mapping[Arithmetic, tuple[Any, ...]]  # floats of numpy's, or fractions

    @property
    def count(self) -> int:
        """How many numbers it has: 1, or 3 for a vector."""
        return len(self.values[Arithmetic.FLOAT64])

    def exact(self, index: int) -> Fraction | None:
        """Return a component's exact value, None where there is none."""
        values = self.values[Arithmetic.EXACT]
        return values[index] if values else None


@dataclass(frozen=True, eq=False)
class Test:
    """The ray against one candidate."""

    __test__ = False  # no test of pytest's

    candidate: Candidate
    quantities: tuple[Quantity, ...]
    judgements: Mapping[Arithmetic, Judgement]

    def number(self, key: str, kind: Arithmetic) -> Number:
        """Return a step's value; for a vector, its first component."""
        return next(q.values[kind][0] for q in self.quantities if q.key == key)


@dataclass(frozen=True, eq=False)
class Derivation:
    """All steps of one pixel."""

    pixel: Pixel
    camera: tuple[Quantity, ...]
    ray: tuple[Quantity, ...]
    tests: tuple[Test, ...]
    # By arithmetic: the index of the nearest test that the textbook accepts in it, None for none.
    nearest: Mapping[Arithmetic, int | None]
    answers: tuple[Answer, ...]
    certified: Answer
    seen_test: Test | None  # the ray against what is certainly seen
    shading: tuple[Quantity, ...]  # the colour's steps; none where it is constant
    color: tuple[float, ...]  # of what is certainly seen, linear RGBA

    @property
    def seen(self) -> Candidate | None:
        """The candidate that is certainly seen; None for the background."""
        return self.seen_test.candidate if self.seen_test else None

    def title_of(self, name: Name) -> str:
        """Return the words for the candidate of a name, or for NOWHERE."""
        titles = (t.candidate.title for t in self.tests if t.candidate.name == name)
        return next(titles, "nothing")


def derive(scene: Scene, x: int, y: int, limit: int = LIMIT, source: str = "") -> Derivation:
    """Derive a pixel of a scene; takes and raises what :func:`candidates.gather_pixel` does."""
    return derive_pixel(gather_pixel(scene, x, y, limit, source))


def derive_pixel(pixel: Pixel) -> Derivation:
    """Derive a pixel that stands alone."""
    at = pixel.camera, pixel.column, pixel.row
    camera: Columns = {kind: textbook.camera_steps(kind, *at) for kind in Arithmetic}
    ray: Columns = {kind: {"o": made["o"], "d": made["d"]} for kind, made in camera.items()}
    ray[Arithmetic.EXACT] = {  # from here on, the truth is about what float64 has stored
        name: Arithmetic.EXACT.vector(ray[Arithmetic.FLOAT64][name]) for name in ("o", "d")
    }
    tests = tuple(_test(pixel, ray, candidate) for candidate in pixel.candidates)
    certified = answer(pixel, pixel.world_triangles())
    seen = next((t for t in tests if t.candidate.name == certified.seen), None)
    shading, color = _color(pixel, seen, certified)
    return Derivation(
        pixel,
        _quantities(camera, CAMERA | ray_formulas(pixel.camera.projection)),
        _quantities(ray, STORED),
        tests,
        {kind: _nearest(tests, kind) for kind in Arithmetic},
        tuple(plain_answers(pixel)),
        certified,
        seen,
        shading,
        color,
    )


def _quantities(columns: Columns, formulas: Mapping[str, Formula]) -> tuple[Quantity, ...]:
    def values(kind: Arithmetic, key: str) -> tuple[Any, ...]:
        value = columns[kind].get(key, ())
        return (value,) if np.ndim(value) == 0 else tuple(value)

    return tuple(
        Quantity(key, formula, {kind: values(kind, key) for kind in Arithmetic})
        for key, formula in formulas.items()
        if key in columns[Arithmetic.FLOAT64]
    )


def _test(pixel: Pixel, ray: Columns, candidate: Candidate) -> Test:
    formulas = PLANE if candidate.is_plane else TRIANGLE
    columns = {}
    for kind in Arithmetic:
        points = [kind.vector(p) for p in candidate.points]
        columns[kind] = textbook.surface_steps(formulas, ray[kind]["o"], ray[kind]["d"], *points)
    return Test(
        candidate,
        _quantities(columns, formulas),
        {kind: textbook.judge(found, pixel.camera) for kind, found in columns.items()},
    )


def _nearest(tests: tuple[Test, ...], kind: Arithmetic) -> int | None:
    """Return the accepted test with the least t, of equals that of the lowest name."""
    accepted = [
        (test.number("t", kind), test.candidate.name, k)
        for k, test in enumerate(tests)
        if test.judgements[kind].accepted
    ]
    return min(accepted)[2] if accepted else None


def _color(
    pixel: Pixel, seen: Test | None, certified: Answer
) -> tuple[tuple[Quantity, ...], tuple[float, ...]]:
    """Return the steps and the value of the colour of what is certainly seen."""
    if seen is None:
        return (), tuple(map(float, pixel.background))
    colors = seen.candidate.colors
    if len(colors) == 1:
        return (), (*map(float, colors[0][:3]), 1.0)
    mean = (colors * certified.s[:, None]).sum(axis=0)  # as `tracer.shading.colors` has it
    color = (*map(float, mean[:3].astype("float32")), 1.0)
    if not np.isfinite(colors).all():  # there is nothing to compute exactly
        return (), color
    columns = {}
    for kind in Arithmetic:
        given = {TRIANGLE[k].label: seen.number(k, kind) for k in ("s1", "s2", "s3")}
        corners = (kind.vector(c[:3]) for c in colors)
        columns[kind] = textbook.evaluate_all(
            COLOR, given | dict(zip(("c₁", "c₂", "c₃"), corners, strict=True))
        )
    return _quantities(columns, COLOR), color
