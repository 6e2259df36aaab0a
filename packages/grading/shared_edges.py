"""Whether rays slip through between two triangles that share an edge.

Float64 may say of a ray through an edge that it meets either triangle, or both: that is never held
against anyone. But where both say that it misses, a closed surface has a hole. Nothing is rounded
here, so that a function which leaks does so by its inequalities. It does not count in the score.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from reference_tracer.arrays import Floats

from .known import Ask
from .subjects.triangle_cases import EACH, whole

SEED = 20261125
EDGES = EACH
AHEAD = 4  # how many steps of a ray's direction its point is away


@dataclass(frozen=True)
class SharedEdges:
    """Counts of a function's answers to rays through edges whose two triangles it sees."""

    edges: int
    leaking: int  # neither triangle is hit
    hit_twice: int  # both are, which is no fault

    @property
    def sentence(self) -> str:
        """A sentence on them; empty where none leaks."""
        if not self.leaking:
            return ""
        return (
            f"{self.leaking:,} of {self.edges:,} edges leak: a ray through the edge that two "
            "triangles share misses both, though nothing is rounded. Closed surfaces have holes "
            "there: ask for s >= 0, not s > 0. It does not count in the score"
        )


def try_edges(ask: Ask) -> SharedEdges:
    """Return what a function makes of shared edges."""
    origins, directions, triangles = make_edges()
    t, _ = ask(origins.reshape(-1, 3), directions.reshape(-1, 3), triangles.reshape(-1, 3, 3))
    inside, on_edge = np.isfinite(t).reshape(EDGES, 2, 2).transpose(2, 0, 1)
    seen = inside.all(axis=1)
    return SharedEdges(
        int(seen.sum()),
        int((seen & ~on_edge.any(axis=1)).sum()),
        int((seen & on_edge.all(axis=1)).sum()),
    )


def make_edges() -> tuple[Floats, Floats, Floats]:
    """Return rays and triangles, (EDGES, 2, 2, ...): edge, triangle of it, inside or on the edge.

    The triangles are the halves of a rectangle whose sides are powers of two, and are wound alike,
    as in a closed surface. Float64 has every digit of every point, product and quotient.
    """
    rng = np.random.default_rng(SEED)
    _, step, p = whole(rng)
    other = np.stack((p[:, 1] + p[:, 2] - p[:, 0], p[:, 2], p[:, 1]), axis=1)
    triangles = np.stack((p, other), axis=1)  # (EDGES, 2, 3, 3)
    along = rng.integers(1, 8, (EDGES, 1)) / 8
    on_edge = p[:, 1] + along * (p[:, 2] - p[:, 1])
    inside = triangles[:, :, 0] / 2 + triangles[:, :, 1] / 4 + triangles[:, :, 2] / 4
    points = np.stack((inside, np.repeat(on_edge[:, None], 2, axis=1)), axis=2)
    first = rng.integers(0, 3, (EDGES, 2, 1))  # which corner of a triangle comes first
    turned = np.take_along_axis(triangles, ((np.arange(3) + first) % 3)[..., None], axis=2)
    directions = np.broadcast_to(step[:, None, None], points.shape)
    corners = np.broadcast_to(turned[:, :, None], (*points.shape, 3))
    return points - AHEAD * directions, directions, corners
