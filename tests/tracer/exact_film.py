"""A camera's film in fractions: where stored rays truly pass it, and see a vertex.

The camera's axes and window, its stored rays and the world vertices are taken as they are, and
nothing is rounded from there on.
"""

from __future__ import annotations

from fractions import Fraction

import numpy as np
from numpy.typing import NDArray
from reference_tracer.scene import Camera
from reference_tracer.tracer.camera import camera_rays

from .rational import Exact, det, functions, rational


class ExactFilm:
    """The film for rays through (dx, dy) beside their pixels' centres."""

    def __init__(self, camera: Camera, dx: float = 0.0, dy: float = 0.0) -> None:
        self.camera, self.beside = camera, (dx, dy)
        axes = rational(np.stack((camera.right, camera.up, camera.forward)))
        dual = [np.cross(axes[(k + 1) % 3], axes[(k + 2) % 3]) for k in range(3)]
        volume = det(*axes)
        self.dual = [d / volume for d in dual]  # of world space, what is right, up, ahead
        w = camera.window
        self.start = Fraction(w.left), Fraction(w.bottom)
        self.size = (
            (Fraction(w.right) - Fraction(w.left)) / camera.width,
            (Fraction(w.top) - Fraction(w.bottom)) / camera.height,
        )
        self.factor = 1 / (volume * self.size[0] * self.size[1])  # of volumes, on the film

    def rays(self, x: NDArray, y: NDArray) -> tuple[NDArray, NDArray]:
        """Return stored origins and directions of pixels, (3, n) each."""
        rays = camera_rays(self.camera, x + 0.5 + self.beside[0], y + 0.5 + self.beside[1])
        return tuple(np.broadcast_to(v, (3, len(x))) for v in (rays.origins, rays.directions))

    def of(self, v: Exact) -> list[Exact]:
        """Return right, up, ahead of world-space vectors (3, n)."""
        return [d[0] * v[0] + d[1] * v[1] + d[2] * v[2] for d in self.dual]

    def seen_by(self, x: NDArray, y: NDArray, points: NDArray) -> tuple[Exact, ...]:
        """Return p, q, w and t of points (3, n), each as the ray of pixel (x, y) sees it.

        That is as if the ray passed the film where its pixel says, and had a depth of 1 there.
        """
        o, d = map(rational, self.rays(x, y))
        right, up, ahead = self.of(rational(points) - o)
        if self.camera.projection.shares_direction:  # the ray begins at its own place
            p, q = (
                v / size + ([Fraction(int(k)) for k in pixel] + np.array(Fraction(1, 2)))
                for v, size, pixel in ((right, self.size[0], x), (up, self.size[1], y))
            )
            return p, q, ahead * 0 + 1, ahead
        a, b, c = self.of(d)
        # The film position of the ray goes to that of the pixel, and the point along with it.
        p, q = (
            (v - ahead * own / c) / size
            + ahead * ([int(k) for k in pixel] + np.array(Fraction(1, 2)))
            for v, own, size, pixel in ((right, a, self.size[0], x), (up, b, self.size[1], y))
        )
        return p, q, ahead, ahead / c

    def functions(self, x: NDArray, y: NDArray, corners: NDArray) -> tuple[Exact, Exact, Exact]:
        """Return e_bc, e_ca, e_ab (3, n), T (n,) and t of pixels and triangles, pair by pair.

        As `edge_functions.py` defines the e and T; t = inf where there is none.
        """
        o, d = self.rays(x, y)
        edges, depth, towards = functions(o, d, corners)
        t = np.array([a / b if b else np.inf for a, b in zip(depth, towards, strict=True)])
        edges = edges[[1, 2, 0]] * self.factor
        if self.camera.projection.shares_direction:
            return edges, towards * self.factor, t
        _, _, ahead = self.of(rational(d))
        return edges / ahead, depth * self.factor, t
