"""The numbers of a derivation as its drawings need them: also by the camera's own axes.

They are the textbook's in float64, which the tables have.
"""

from __future__ import annotations

import numpy as np

from ..arrays import Floats
from .derivation import Derivation, Quantity, Test
from .plate import kept
from .textbook import Arithmetic

CORNERS = "p₁", "p₂", "p₃"
_PIECES = 24  # of an edge that a panorama's film bends
_NEAR_DEPTH = 1e-6  # of the farthest corner's depth: what is before it has no place on the film


class View:
    """The numbers of a derivation, in the camera's axes too: right, up, forward."""

    def __init__(self, derivation: Derivation) -> None:
        self.pixel = derivation.pixel
        camera = {q.key: _value(q) for q in derivation.camera}
        ray = {q.key: _value(q) for q in derivation.ray}
        self.u, self.v = float(camera["u"][0]), float(camera["v"][0])
        self.width, self.height = float(camera["width"][0]), float(camera["height"][0])
        window = derivation.pixel.camera.window
        self.edges = np.array([[window.left, window.bottom], [window.right, window.top]])
        self.axes = np.stack([camera[k] for k in ("right", "up", "forward")], axis=1)
        self.eye, self.o, self.d = camera["eye"], ray["o"], ray["d"]
        self.test = drawn_test(derivation)
        self.steps = {q.key: _value(q) for q in self.test.quantities} if self.test else {}
        self.bends = not derivation.pixel.camera.projection.is_linear

    @property
    def sound(self) -> bool:
        """Whether the camera's axes span space, and its numbers can be drawn."""
        known = np.concatenate((self.axes.ravel(), self.eye, self.o, self.d, self.edges.ravel()))
        return bool(np.isfinite(known).all() and abs(np.linalg.det(self.axes)) > 0)

    @property
    def meets(self) -> bool:
        """Whether the ray meets the surface's plane at a place that can be drawn."""
        if self.test is None:
            return False
        known = np.concatenate((self.steps["t"], self.steps["x"], self.corners.ravel()))
        return bool((np.abs(known) < 1e100).all() and _value_of(self.steps, "n").any())

    @property
    def t(self) -> float:
        """The ray's parameter where it meets the plane."""
        return float(self.steps["t"][0])

    @property
    def corners(self) -> Floats:
        """The triangle's corners in the world, (3, 3); of an infinite plane its point, (1, 3)."""
        assert self.test
        points = self.test.candidate.points
        return points[:1] if self.test.candidate.is_plane else points

    @property
    def names(self) -> tuple[str, ...]:
        """What the corners are called."""
        return ("p",) if len(self.corners) == 1 else CORNERS

    def turned(self, vectors: Floats) -> Floats:
        """Return vectors (n, 3) by their right, up and forward."""
        return np.asarray(np.linalg.solve(self.axes, np.atleast_2d(vectors).T).T)

    def seen(self, points: Floats) -> Floats:
        """Return points (n, 3) from the camera, by their right, up and forward."""
        return self.turned(np.atleast_2d(points) - self.eye)

    def film(self, points: Floats) -> Floats:
        """Return where the corners (n, 3) of a polygon appear on the film, (k, 2)."""
        if self.bends:
            ends = np.roll(points, -1, axis=0)
            shares = np.arange(_PIECES)[None, :, None] / _PIECES
            points = (points[:, None] + (ends - points)[:, None] * shares).reshape(-1, 3)
        xyz = self.seen(points)
        if not self.bends and not self.pixel.camera.projection.shares_direction:
            xyz = kept(xyz, xyz[:, 2] - _NEAR_DEPTH * np.abs(xyz).max())
        x, y, _ = self.pixel.camera.projection.film(xyz.T, self.u)
        return np.stack((x, y), axis=1)[np.isfinite(x) & np.isfinite(y)]


def _value(quantity: Quantity) -> Floats:
    return np.array(quantity.values[Arithmetic.FLOAT64], np.float64)


def _value_of(steps: dict[str, Floats], key: str) -> Floats:
    return np.nan_to_num(steps[key])


def drawn_test(derivation: Derivation) -> Test | None:
    """Return the test that is drawn: what is seen, else what comes nearest to it."""
    first = derivation.tests[0] if derivation.tests else None
    return derivation.seen_test or first
