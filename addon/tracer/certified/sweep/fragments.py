"""Fragments: pairs of a pixel and a surface that may be its nearest, and the clip range."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ....scene import Camera
from ..bounds import U

ROUNDING = 4 * U  # relative, of a nearness that was computed from t
Index = NDArray[np.integer]


@dataclass(frozen=True, eq=False)
class Fragments:
    """c pairs of a pixel and a surface that may be its nearest, (c,) each.

    `surface` counts the triangles of all chunks; `nearest` is the most that its nearness can be;
    `sure` whether it is hit for sure.
    """

    pixel: Index
    surface: Index
    nearest: NDArray[np.float64]
    sure: NDArray[np.bool_]

    def take(self, index: Index) -> Fragments:
        """Return those at `index`."""
        return Fragments(*(v.take(index) for v in vars(self).values()))

    @staticmethod
    def joined(parts: Sequence[Fragments]) -> Fragments:
        """Return them all as one."""
        return Fragments(
            *(np.concatenate(f) for f in zip(*(vars(p).values() for p in parts), strict=True))
        )

    @staticmethod
    def together(parts: Sequence[Fragments], count: int) -> Iterator[Fragments]:
        """Yield them all, small parts joined, at least `count` at a time but at the end."""
        some: list[Fragments] = []
        for part in parts:
            some.append(part)
            if sum(len(p.pixel) for p in some) >= count:
                yield Fragments.joined(some)
                some = []
        if some:
            yield Fragments.joined(some)


class ClipRange:
    """The camera's clip range as nearness, with room for its own rounding."""

    def __init__(self, camera: Camera) -> None:
        ends, nearness = (camera.clip_start, camera.clip_end), camera.projection.nearness
        self._outer, self._inner = nearness(*ends, ROUNDING), nearness(*ends, -ROUNDING)

    def inside(self, least: NDArray, most: NDArray) -> NDArray[np.bool_]:
        """Return which surely are in the range, of nearnesses between these."""
        return (least > self._inner[0]) & (most < self._inner[1])

    def outside(self, least: NDArray, most: NDArray) -> NDArray[np.bool_]:
        """Return which surely are not."""
        return (most < self._outer[0]) | (least > self._outer[1])
