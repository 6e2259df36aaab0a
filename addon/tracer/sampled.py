"""Keeps the candidates of a tile for its next samples."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from .candidates import BYTES_PER_PAIR, Plan, candidates
from .world import Pairs

if TYPE_CHECKING:
    from ..scene import Region

SAMPLED = 1 << 18  # pairs of a tile that are kept for its next samples: 20 MB with the triangles


class Sampled:
    """The candidates of a plan's tiles, kept from sample to sample where there are few."""

    def __init__(self, plan: Plan) -> None:
        self._plan = plan
        self._tile: Region | None = None
        self._found: list[tuple[float, Pairs | None]] = []

    def of(self, tile: Region) -> Iterator[tuple[float, Pairs | None]]:
        """Yield what :func:`candidates` does of a tile."""
        if tile == self._tile:
            yield from map(_anew, self._found)
            return
        self._tile, self._found = None, []
        found = []
        left = min(SAMPLED, self._plan.memory // BYTES_PER_PAIR)
        for share, some in candidates(self._plan, tile):
            left -= len(some.pixel) if some else 0
            if left >= 0:
                found.append((share, some))
            yield _anew((share, some))
        if left >= 0:
            self._tile, self._found = tile, found


def _anew(found: tuple[float, Pairs | None]) -> tuple[float, Pairs | None]:
    """Return pairs that do not keep what is gathered of them."""
    share, some = found
    return share, some and replace(some)
