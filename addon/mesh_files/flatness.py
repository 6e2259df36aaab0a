"""Says how many faces are not flat, and by how much: such a face has no unique shape."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..arrays import Floats
from ..tracer.vector import dot
from ..wording import count_of
from .scaling import local, normals

# How many roundings of its corners may take a flat face's corners from its plane: the corner's own
# along the normal (below sqrt 3), and what the others' do to the plane, which is their mean.
_ROUNDINGS = 4
_DECIMALS = 4, 5, 6  # programs write so many, or else at least six digits (C's %g) or float32
_FLOAT32 = 2.0**-24
_SEEN = 1e-3  # what is more than this share of a face's size is no rounding, however it came
_SAMPLE = 4096  # vertices whose numbers show how all were rounded


class Bends:
    """How far the corners of faces are from the planes of their faces, beyond rounding."""

    def __init__(self, vertices: Floats) -> None:
        """Take a file's vertices (v, 3), whose numbers show how they were rounded."""
        self.absolute, self.relative = _rounding(vertices[:: len(vertices) // _SAMPLE + 1])
        self.count = 0
        self.metres: float = 0.0
        self.share: float = 0.0

    def add(self, points: Floats) -> None:
        """Measure faces, by their corners (3, k, n)."""
        at = local(points)
        normal = normals(at)
        with np.errstate(all="ignore"):  # a face that has no normal is a line, or crosses itself
            normal /= np.sqrt(dot(normal, normal))
            away = np.abs(dot(at - at.mean(axis=2, keepdims=True), normal[..., None])).max(axis=1)
            spans, own = np.ptp(at, axis=2), np.ptp(points, axis=2)
            share = away / np.sqrt(dot(spans, spans))
            bend = share * np.sqrt(dot(own, own))
            bent = bend > self.rounding(points)
        if bent.any():
            self.count += int(bent.sum())
            self.metres = max(self.metres, float(np.max(bend[bent])))
            self.share = max(self.share, float(np.max(share[bent])))

    def rounding(self, points: Floats) -> Floats:
        """Return how far roundings may move the corners (3, k, n) of faces, (k,) metres."""
        largest, size = np.abs(points).max(axis=(0, 2)), np.ptp(points, axis=2).max(axis=0)
        may = _ROUNDINGS * np.maximum(self.absolute, self.relative * largest)
        return np.minimum(may, _SEEN * size)

    def notes(self) -> Iterator[str]:
        """Say it, if there is something to say."""
        if self.count:
            many = "of more than three corners"
            are = count_of(self.count, f"face {many} is", f"faces {many} are")
            yield (
                f"{are} not flat, by {self.metres:.2g} m or {100 * self.share:.2g} % of their size "
                "at most: a program that cuts faces along other diagonals than Blender shows "
                "another surface"
            )


def _rounding(numbers: Floats) -> tuple[float, float]:
    """Return how far a file's numbers are rounded: in metres, and as a share of each."""
    numbers = numbers[np.isfinite(numbers) & (numbers != 0)]
    own = numbers.astype(np.float64)
    with np.errstate(all="ignore"):
        rounded = ((10.0**-d, np.rint(own * 10.0**d) / 10.0**d) for d in _DECIMALS)
        absolute = next((step / 2 for step, r in rounded if _are_same(r, own, numbers)), 0.0)
        digits = np.rint(own * (scale := 10.0 ** (5 - np.floor(np.log10(np.abs(own))))))
        six = _are_same(digits / scale, own, numbers) and (digits % 10 != 0).sum() > len(own) / 2
    return absolute, 5e-6 if six else 0.0 if absolute else _FLOAT32


def _are_same(rounded: Floats, own: Floats, stored: Floats) -> bool:
    """Return whether all numbers are rounded ones, as far as they are stored."""
    apart = np.abs(rounded - own)
    return bool((apart <= np.finfo(stored.dtype).eps * np.abs(own)).all())
