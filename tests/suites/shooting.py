"""All crossings of rays with triangles, by the certified method or by a plain one.

Pairs that cannot meet are left out beforehand, so that counts of the size of the originals can be
run. That cull is conservative by many orders more than anything that it rounds; `all_pairs` goes
without.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from reference_tracer.certified.any_rays import decide
from reference_tracer.methods import Method
from reference_tracer.tracer.camera import Rays
from reference_tracer.tracer.triangle import TESTS

from ..oracle import intersect_pairs

AT_ONCE = 1 << 20  # pairs looked at by the cull, some tens of MiB
DECIDED = 1 << 17  # pairs decided together


@dataclass(frozen=True, eq=False)
class Crossings:
    """Where n rays meet m triangles: hits `ray`, `triangle`, and whether on an `edge`, (c,)."""

    origins: NDArray[np.float64]
    directions: NDArray[np.float64]
    corners: NDArray[np.float64]
    ray: NDArray[np.intp]
    triangle: NDArray[np.intp]
    edge: NDArray[np.bool_]

    @property
    def counts(self) -> NDArray[np.intp]:
        """Hits of each ray, (n,)."""
        return np.bincount(self.ray, minlength=self.directions.shape[1])

    def winding(self) -> NDArray[np.intp]:
        """Signed crossings of each ray, (n,): a hit from behind, on the way out, counts +1.

        Of a mesh whose triangles are counter-clockwise from outside it is 1 inside, 0 outside.
        The sign is that of det in integers: the side from which the ray as stored comes.
        """
        result = intersect_pairs(
            self.origins[:, self.ray],
            self.directions[:, self.ray],
            self.corners[..., self.triangle],
        )
        signs = np.where(result.denominator < 0, 1, -1)  # det = -d . (e1 x e2)
        total = np.zeros(self.directions.shape[1], np.intp)
        np.add.at(total, self.ray, signs)
        return total

    def nearest(self) -> NDArray[np.intp]:
        """The nearest triangle of each ray, (n,), -1 for none: by the exact t, then the index."""
        result = intersect_pairs(
            self.origins[:, self.ray],
            self.directions[:, self.ray],
            self.corners[..., self.triangle],
        )
        best = [(np.inf, -1)] * self.directions.shape[1]
        for k, (ray, triangle) in enumerate(zip(self.ray, self.triangle, strict=True)):
            best[ray] = min(best[ray], (result.t(k), int(triangle)))
        return np.array([triangle for _, triangle in best])


def crossings(
    origins: NDArray,
    directions: NDArray,
    corners: NDArray,
    method: Method = Method.CERTIFIED,
    all_pairs: bool = False,
) -> Crossings:
    """Shoot n rays, (3, n) each or origins (3, 1), at m triangles (3 corners, 3, m), all at all."""
    origins = np.broadcast_to(origins, directions.shape)
    found = []
    for some_rays, some in _pairs(origins, directions, corners, all_pairs):
        for at in range(0, len(some), DECIDED):
            ray, triangle = some_rays[at : at + DECIDED], some[at : at + DECIDED]
            rays = Rays(origins[:, ray], directions[:, ray])
            hit, edge = decided(rays, corners[:, :, triangle], method)
            found.append((ray[hit], triangle[hit], edge[hit]))
    ray, triangle, edge = (np.concatenate(part) for part in zip(*found, strict=True))
    return Crossings(origins, directions, corners, ray, triangle, edge)


def decided(rays: Rays, corners: NDArray, method: Method) -> tuple[NDArray, NDArray]:
    """Return which pairs meet at t > 0, and on an edge (which an unproven method does not say)."""
    if method.is_proven:
        decision = decide(rays, corners)
        return decision.crossed, decision.edge
    hit, t, _ = TESTS[method](rays, *corners)
    with np.errstate(invalid="ignore"):
        return hit & (t > 0), np.zeros(len(hit), bool)


def _pairs(o, d, corners, all_pairs: bool) -> Iterator[tuple[NDArray, NDArray]]:
    """Yield rays and triangles whose line and bounding sphere may meet.

    Distances are measured from where a line is nearest to the middle of all triangles. Moving
    its origin there rounds by some 2^-53 of how far it was; the squares below by as much of the
    mesh's size. The spheres grow by a multiple of both.
    """
    count = corners.shape[2]
    middle = corners.mean(axis=(0, 2))[:, None]
    centres = corners.mean(axis=0) - middle
    radius = np.sqrt(((corners - middle - centres) ** 2).sum(axis=1)).max(axis=0)
    size = np.sqrt((centres**2).sum(axis=0)).max() + radius.max()
    step = max(1, AT_ONCE // count)
    for at in range(0, d.shape[1], step):
        part = np.arange(at, min(at + step, d.shape[1]))
        if all_pairs:
            yield np.repeat(part, count), np.tile(np.arange(count), len(part))
            continue
        along = d[:, part] / np.sqrt((d[:, part] ** 2).sum(axis=0))
        start = o[:, part] - middle
        distance = np.sqrt((start**2).sum(axis=0))
        start = start - (start * along).sum(axis=0) * along
        reach = radius + 1e-6 * size + 1e-13 * distance[:, None]
        far = np.sqrt((start**2).sum(axis=0)) > size + reach.max()
        apart = (centres**2).sum(axis=0) + ((start**2).sum(axis=0))[:, None]
        apart -= 2 * (start.T @ centres)
        apart -= (along.T @ centres) ** 2
        ray, triangle = np.nonzero((apart <= reach**2) & ~far[:, None])
        yield part[ray], triangle
